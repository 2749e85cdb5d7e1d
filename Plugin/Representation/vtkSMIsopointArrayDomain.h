// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkSMIsopointArrayDomain
 * @brief   a list of arrays that have isosurfaces
 *
 * The arrays of vtkSMArrayListDomain, without ghost marks and arrays without finite values (such as
 * strings). The default is that of vtkSMArrayListDomain or, if that array is constant (as block
 * numbers often are), or holds ids or numbers of points or cells, or the normals or radii of
 * isopoints, the first array that does none of these.
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
   * Sets the default when the input gets its first array. Sets it again when another input replaces
   * the former one, if the new input has no such array or, while the filter is being created, if
   * the array is still the former default: scripts first connect the active source, then the input
   * that they name.
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
