// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkSMIsopointArrayDomain
 * @brief   a list of arrays that have isosurfaces
 *
 * The arrays are those of vtkSMArrayListDomain, without ghost marks and arrays that have no finite
 * value (such as arrays of strings). The default is that of vtkSMArrayListDomain, unless that array
 * is constant (as the numbers of blocks often are) or holds the ids of points or cells: then it is
 * the first one in the list that does neither.
 */
#ifndef vtkSMIsopointArrayDomain_h
#define vtkSMIsopointArrayDomain_h

#include "vtkSMArrayListDomain.h"
#include "vtkScatteredIsopointRepresentationsModule.h" // for the export macro
#include "vtkWeakPointer.h"

class vtkSMProxy;

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

  /**
   * Sets the default once more where another input takes the place of a former one, and that has no
   * such array or, while the filter is being created, the array is still the former one's default:
   * scripts first connect the active source, then the input that they name.
   */
  void Update(vtkSMProperty* requestingProperty) override;

protected:
  vtkSMIsopointArrayDomain() = default;
  ~vtkSMIsopointArrayDomain() override = default;

  bool IsFilteredArray(vtkPVDataInformation* data, int association, const char* name) override;

private:
  bool IsReplaceable(vtkSMProperty* property);

  vtkWeakPointer<vtkSMProxy> Input;
  vtkMTimeType DefaultTime = 0; // of the property, when its default was set

  vtkSMIsopointArrayDomain(const vtkSMIsopointArrayDomain&) = delete;
  void operator=(const vtkSMIsopointArrayDomain&) = delete;
};

#endif
