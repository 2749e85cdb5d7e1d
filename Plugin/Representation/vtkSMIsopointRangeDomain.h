// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkSMIsopointRangeDomain
 * @brief   a finite range whose default follows the array
 *
 * The range is that of the array's finite values. The default isovalue is the middle of the array's
 * range, as with vtkSMArrayRangeDomain. If another array is chosen while the isovalue is the
 * default, or an array comes where there was none, it becomes the middle of the new range. Other
 * isovalues, those of a loaded state, and all if only the data change, are kept.
 *
 * The required properties are those of vtkSMArrayRangeDomain: "Input", "ArraySelection".
 */
#ifndef vtkSMIsopointRangeDomain_h
#define vtkSMIsopointRangeDomain_h

#include "vtkSMArrayRangeDomain.h"
#include "vtkScatteredIsopointRepresentationsModule.h" // for the export macro

#include <optional> // for default values
#include <string>   // for the array's name

class VTKSCATTEREDISOPOINTREPRESENTATIONS_EXPORT vtkSMIsopointRangeDomain
  : public vtkSMArrayRangeDomain
{
public:
  static vtkSMIsopointRangeDomain* New();
  vtkTypeMacro(vtkSMIsopointRangeDomain, vtkSMArrayRangeDomain);

  /**
   * Sets the property. @returns whether it did
   */
  int SetDefaultValues(vtkSMProperty* property, bool usesUncheckedValues) override;

  void Update(vtkSMProperty* requestingProperty) override;

protected:
  vtkSMIsopointRangeDomain() = default;
  ~vtkSMIsopointRangeDomain() override = default;

private:
  bool SetFiniteRange(); // whether the input has the array
  bool IsDefault(vtkSMProperty* property) const;

  std::string Array;                  // of the range, with its association
  std::optional<double> Default;      // value that the property was set to
  std::optional<double> ShownDefault; // the same, if not applied yet
  bool WaitsForArray = false;         // there was no range for a default

  vtkSMIsopointRangeDomain(const vtkSMIsopointRangeDomain&) = delete;
  void operator=(const vtkSMIsopointRangeDomain&) = delete;
};

#endif
