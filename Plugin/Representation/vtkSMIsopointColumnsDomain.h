// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkSMIsopointColumnsDomain
 * @brief   hides the numbers of splats in a new spreadsheet
 *
 * A domain for a property of a spreadsheet's proxy; it adds the cell arrays of splats to the
 * default of that proxy's property "HiddenColumnLabels". Its user can show them.
 */
#ifndef vtkSMIsopointColumnsDomain_h
#define vtkSMIsopointColumnsDomain_h

#include "vtkSMDomain.h"
#include "vtkScatteredIsopointRepresentationsModule.h" // for the export macro

class VTKSCATTEREDISOPOINTREPRESENTATIONS_EXPORT vtkSMIsopointColumnsDomain : public vtkSMDomain
{
public:
  static vtkSMIsopointColumnsDomain* New();
  vtkTypeMacro(vtkSMIsopointColumnsDomain, vtkSMDomain);

  /**
   * Sets "HiddenColumnLabels". @returns whether it did
   */
  int SetDefaultValues(vtkSMProperty* property, bool usesUncheckedValues) override;

protected:
  vtkSMIsopointColumnsDomain() = default;
  ~vtkSMIsopointColumnsDomain() override = default;

private:
  vtkSMIsopointColumnsDomain(const vtkSMIsopointColumnsDomain&) = delete;
  void operator=(const vtkSMIsopointColumnsDomain&) = delete;
};

#endif
