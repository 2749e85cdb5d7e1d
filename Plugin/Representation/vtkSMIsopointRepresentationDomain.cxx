// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkSMIsopointRepresentationDomain.h"

#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMStringVectorProperty.h"

#include <algorithm>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkSMIsopointRepresentationDomain);

namespace
{

bool hasPointArray(vtkPVDataInformation* data, const char* name, int components)
{
  vtkPVArrayInformation* const array = data->GetArrayInformation(name, vtkDataObject::POINT);
  return array && array->GetNumberOfComponents() == components;
}

bool hasSplats(vtkPVDataInformation* data)
{
  return data && hasPointArray(data, "Normals", 3) && hasPointArray(data, "Radius", 1);
}

const char* const splats = "Isopoint Splats";

} // namespace

bool vtkSMIsopointRepresentationDomain::AreIsopoints(vtkPVDataInformation* data)
{
  if (!hasSplats(data))
  {
    return false;
  }
  const auto cells = data->GetNumberOfCells();
  return cells == 0 || cells == data->GetNumberOfPoints();
}

void vtkSMIsopointRepresentationDomain::Update(vtkSMProperty* requestingProperty)
{
  this->Superclass::Update(requestingProperty);
  if (!this->Types)
  {
    vtkSMProxy* const part = this->GetProperty()->GetParent();
    vtkSMProxy* const whole = part ? part->GetTrueParentProxy() : nullptr;
    this->Types = vtkSMStringVectorProperty::SafeDownCast(
      whole ? whole->GetProperty("RepresentationTypesInfo") : nullptr);
    if (this->Types)
    {
      this->Types->AddObserver(
        vtkCommand::ModifiedEvent, this, &vtkSMIsopointRepresentationDomain::OfferSplats);
    }
  }
  this->OfferSplats();
}

void vtkSMIsopointRepresentationDomain::OfferSplats()
{
  if (!this->Types || this->Types->GetNumberOfElements() == 0)
  {
    return; // the types are not listed yet
  }
  std::vector<std::string> types = this->Types->GetElements();
  types.erase(std::remove(types.begin(), types.end(), splats), types.end());
  if (hasSplats(this->GetInputDataInformation("Input")))
  {
    types.insert(std::lower_bound(types.begin(), types.end(), splats), splats);
  }
  this->Types->SetElements(types);
}

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
  helper.Set(splats);
  return 1;
}
