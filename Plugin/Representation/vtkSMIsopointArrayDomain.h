// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkSMIsopointArrayDomain
 * @brief   a list of arrays whose default has isosurfaces
 *
 * The default is that of vtkSMArrayListDomain, unless that array is constant (as the numbers of
 * blocks often are): then it is the first one in the list that is not.
 */
#ifndef vtkSMIsopointArrayDomain_h
#define vtkSMIsopointArrayDomain_h

#include "vtkSMArrayListDomain.h"
#include "vtkScatteredIsopointRepresentationsModule.h" // for the export macro

class vtkPVDataInformation;

class VTKSCATTEREDISOPOINTREPRESENTATIONS_EXPORT vtkSMIsopointArrayDomain
  : public vtkSMArrayListDomain
{
public:
  static vtkSMIsopointArrayDomain* New();
  vtkTypeMacro(vtkSMIsopointArrayDomain, vtkSMArrayListDomain);

  /**
   * Sets the property. @returns whether it did
   */
  int SetDefaultValues(vtkSMProperty* property, bool usesUncheckedValues) override;

protected:
  vtkSMIsopointArrayDomain() = default;
  ~vtkSMIsopointArrayDomain() override = default;

private:
  vtkSMIsopointArrayDomain(const vtkSMIsopointArrayDomain&) = delete;
  void operator=(const vtkSMIsopointArrayDomain&) = delete;
};

#endif
