// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkSMIsopointRepresentationDomain.h"

#include "vtkSMIsopointSourceProxy.h"

#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMStringVectorProperty.h"
#include "vtkSMViewProxy.h"

#include <algorithm>
#include <cstring>
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

/// ParaView lists no arrays of empty data.
bool isEmpty(vtkPVDataInformation* data)
{
  return !data || data->GetNumberOfPoints() == 0;
}

/// Whether a source makes splats as soon as it makes points.
bool makesSplats(vtkSMProxy* source)
{
  const auto isOn = [source](const char* name)
  { return vtkSMPropertyHelper(source, name).GetAsInt() != 0; };
  return source && source->GetXMLName() &&
         std::strcmp(source->GetXMLName(), "ScatteredIsopoints") == 0 && isOn("ComputeNormals") &&
         isOn("ComputeSplats");
}

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
  // A property keeps the domains that depend on it, also after their proxy is deleted.
  vtkSMProperty* const property = this->GetProperty();
  vtkSMProxy* const part = property ? property->GetParent() : nullptr;
  if (!part)
  {
    return;
  }
  if (!this->Types)
  {
    this->Types = vtkSMStringVectorProperty::SafeDownCast(
      part->GetTrueParentProxy()->GetProperty("RepresentationTypesInfo"));
    if (this->Types)
    {
      this->Types->AddObserver(
        vtkCommand::ModifiedEvent, this, &vtkSMIsopointRepresentationDomain::OfferSplats);
    }
  }
  this->OfferSplats();
  this->SetLateDefault(part->GetTrueParentProxy());
}

void vtkSMIsopointRepresentationDomain::OfferSplats()
{
  if (!this->Types || this->Types->GetNumberOfElements() == 0)
  {
    return; // the types are not listed yet
  }
  std::vector<std::string> types = this->Types->GetElements();
  types.erase(std::remove(types.begin(), types.end(), Splats), types.end());
  this->NoticeSplats();
  if (this->HasSplats)
  {
    types.insert(std::lower_bound(types.begin(), types.end(), Splats), Splats);
    vtkSMIsopointSourceProxy::LoadInTrace();
  }
  this->Types->SetElements(types);
}

void vtkSMIsopointRepresentationDomain::NoticeSplats()
{
  vtkSMProperty* const inputs = this->GetRequiredProperty("Input");
  vtkSMProxy* const source = inputs ? vtkSMPropertyHelper(inputs).GetAsProxy() : nullptr;
  vtkPVDataInformation* const data = this->GetInputDataInformation("Input");
  if (!isEmpty(data))
  {
    this->HasSplats = hasSplats(data);
  }
  else if (source != this->Source)
  {
    this->HasSplats = makesSplats(source);
  }
  this->Source = source;
}

void vtkSMIsopointRepresentationDomain::SetLateDefault(vtkSMProxy* representation)
{
  vtkPVDataInformation* const data = this->GetInputDataInformation("Input");
  if (!this->EmptyDefault || isEmpty(data))
  {
    return;
  }
  vtkSMPropertyHelper type(representation, "Representation");
  const bool isUnchanged = type.GetAsString() == *this->EmptyDefault;
  this->EmptyDefault.reset();
  if (!isUnchanged || !AreIsopoints(data))
  {
    return;
  }
  type.Set(Splats);
  representation->UpdateVTKObjects();
  // The points may come in an update of the view, which does not notice this change.
  for (unsigned int i = 0; i < representation->GetNumberOfConsumers(); ++i)
  {
    if (auto* const view = vtkSMViewProxy::SafeDownCast(representation->GetConsumerProxy(i)))
    {
      view->Update();
    }
  }
}

int vtkSMIsopointRepresentationDomain::SetDefaultValues(
  vtkSMProperty* property, bool usesUncheckedValues)
{
  vtkPVDataInformation* const data = this->GetInputDataInformation("Input");
  this->NoticeSplats();
  vtkSMProxy* const part = property->GetParent();
  if (!part)
  {
    return 0;
  }
  vtkSMPropertyHelper helper(part->GetTrueParentProxy(), "Representation");
  helper.SetUseUnchecked(usesUncheckedValues);
  if (isEmpty(data) && !this->HasSplats)
  {
    this->EmptyDefault = helper.GetAsString();
    return 0;
  }
  if (!isEmpty(data) && !AreIsopoints(data))
  {
    return 0;
  }
  helper.Set(Splats);
  return 1;
}
