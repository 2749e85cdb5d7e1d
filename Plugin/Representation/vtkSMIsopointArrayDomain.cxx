// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkSMIsopointArrayDomain.h"

#include "vtkDataSetAttributes.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkSMIsopointRepresentationDomain.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMUncheckedPropertyHelper.h"

#include <set>
#include <string>

vtkStandardNewMacro(vtkSMIsopointArrayDomain);

namespace
{

/// Whether an array has an id attribute, or a name that readers of finite elements give to ids.
/// Composites may lose the attribute.
bool isMarkedAsIds(vtkPVDataInformation* data, const std::string& name, int association)
{
  static const std::set<std::string> names{ "vtkOriginalPointIds", "vtkOriginalCellIds",
    "GlobalNodeId", "GlobalElementId", "GlobalPointIds", "GlobalCellIds", "PedigreeNodeId",
    "PedigreeElementId" };
  const auto isAttribute = [&](int type)
  {
    vtkPVDataSetAttributesInformation* const attributes =
      data->GetAttributeInformation(association);
    vtkPVArrayInformation* const array =
      attributes ? attributes->GetAttributeInformation(type) : nullptr;
    return array && array->GetName() && name == array->GetName();
  };
  return names.count(name) > 0 || isAttribute(vtkDataSetAttributes::GLOBALIDS) ||
         isAttribute(vtkDataSetAttributes::PEDIGREEIDS);
}

/// Whether the values of an array can be a numbering of its elements, from 0 or 1.
bool canBeNumbers(vtkPVArrayInformation* array, const double range[2])
{
  const auto count = static_cast<double>(array->GetNumberOfTuples());
  return (range[0] == 0.0 || range[0] == 1.0) && range[1] - range[0] == count - 1.0;
}

/// Whether an array describes the shape of isopoints.
bool isOfSplats(vtkPVDataInformation* data, const std::string& name)
{
  return (name == "Normals" || name == "Radius") &&
         vtkSMIsopointRepresentationDomain::AreIsopoints(data);
}

/// Whether an array is worth contouring.
bool isField(vtkPVDataInformation* data, const char* name, int association)
{
  vtkPVArrayInformation* const array = data->GetArrayInformation(name, association);
  if (!array || isMarkedAsIds(data, name, association) || isOfSplats(data, name))
  {
    return false;
  }
  double range[2];
  array->GetComponentFiniteRange(0, range);
  return range[0] < range[1] && !canBeNumbers(array, range);
}

bool isNothingChosen(vtkSMProperty* property)
{
  const char* const chosen = vtkSMPropertyHelper(property).GetInputArrayNameToProcess();
  return !chosen || !chosen[0];
}

} // namespace

int vtkSMIsopointArrayDomain::SetDefaultValues(vtkSMProperty* property, bool usesUncheckedValues)
{
  int result = this->Superclass::SetDefaultValues(property, usesUncheckedValues);
  vtkPVDataInformation* const data = this->GetInputDataInformation("Input");
  vtkSMPropertyHelper helper(property);
  helper.SetUseUnchecked(usesUncheckedValues);
  const char* const chosen = helper.GetInputArrayNameToProcess();
  bool isSet = !data || (chosen && isField(data, chosen, helper.GetInputArrayAssociation()));
  for (unsigned int i = 0; !isSet && i < this->GetNumberOfStrings(); ++i)
  {
    const int association = this->GetFieldAssociation(i);
    isSet = isField(data, this->GetString(i), association);
    if (isSet)
    {
      helper.SetInputArrayToProcess(association, this->GetString(i));
      result = 1;
    }
  }
  this->DefaultTime = property->GetMTime();
  return result;
}

void vtkSMIsopointArrayDomain::Update(vtkSMProperty* requestingProperty)
{
  this->Superclass::Update(requestingProperty);
  vtkSMProperty* const inputs = this->GetRequiredProperty("Input");
  if (!inputs)
  {
    return;
  }
  const vtkSMUncheckedPropertyHelper helper(inputs);
  vtkSMProxy* const input = helper.GetNumberOfElements() > 0 ? helper.GetAsProxy(0) : nullptr;
  if (!input)
  {
    return; // the former input is removed before another one is connected
  }
  const bool isReplaced = this->Input && this->Input.GetPointer() != input;
  this->Input = input;
  vtkSMProperty* const property = this->GetProperty();
  if (property && this->GetNumberOfStrings() > 0 &&
      (isReplaced ? this->IsReplaceable(property) : isNothingChosen(property)))
  {
    this->SetDefaultValues(property, false);
  }
}

bool vtkSMIsopointArrayDomain::IsFilteredArray(
  vtkPVDataInformation* data, int association, const char* name)
{
  if (std::string(name) == vtkDataSetAttributes::GhostArrayName())
  {
    return true;
  }
  vtkPVArrayInformation* const array = data->GetArrayInformation(name, association);
  double range[2] = { 0.0, 0.0 };
  if (array)
  {
    array->GetComponentFiniteRange(0, range);
  }
  return range[0] > range[1] && array->GetNumberOfTuples() > 0;
}

bool vtkSMIsopointArrayDomain::IsReplaceable(vtkSMProperty* property)
{
  const char* const chosen = vtkSMPropertyHelper(property).GetInputArrayNameToProcess();
  unsigned int index = 0;
  if (isNothingChosen(property) || !this->IsInDomain(chosen, index))
  {
    return true;
  }
  vtkSMProxy* const filter = property->GetParent();
  const bool isBeingCreated =
    filter && !filter->GetSessionProxyManager()->GetProxyName("sources", filter);
  return isBeingCreated && property->GetMTime() == this->DefaultTime;
}
