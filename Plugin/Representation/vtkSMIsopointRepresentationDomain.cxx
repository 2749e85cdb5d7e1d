// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkSMIsopointRepresentationDomain.h"

#include "vtkDataObject.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

vtkStandardNewMacro(vtkSMIsopointRepresentationDomain);

namespace
{

bool hasPointArray(vtkPVDataInformation* data, const char* name, int components)
{
  vtkPVArrayInformation* const array = data->GetArrayInformation(name, vtkDataObject::POINT);
  return array && array->GetNumberOfComponents() == components;
}

bool hasVerticesAlone(vtkPVDataInformation* data)
{
  const auto cells = data->GetNumberOfCells();
  return cells == 0 || cells == data->GetNumberOfPoints();
}

} // namespace

//------------------------------------------------------------------------------
bool vtkSMIsopointRepresentationDomain::AreIsopoints(vtkPVDataInformation* data)
{
  return data && hasVerticesAlone(data) && hasPointArray(data, "Normals", 3) &&
         hasPointArray(data, "Radius", 1);
}

//------------------------------------------------------------------------------
int vtkSMIsopointRepresentationDomain::SetDefaultValues(
  vtkSMProperty* property, bool usesUncheckedValues)
{
  if (!AreIsopoints(this->GetInputDataInformation("Input")))
  {
    return 0;
  }
  vtkSMProxy* const part = property->GetParent();
  vtkSMPropertyHelper helper(part->GetTrueParentProxy(), "Representation");
  helper.SetUseUnchecked(usesUncheckedValues);
  helper.Set("Isopoint Splats");
  return 1;
}
