// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkSMIsopointRangeDomain.h"

#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

vtkStandardNewMacro(vtkSMIsopointRangeDomain);

namespace
{

/// The chosen array and its association; empty if none is chosen.
std::string chosenArray(vtkSMPropertyHelper& selection)
{
  const char* const name =
    selection.GetNumberOfElements() >= 5 ? selection.GetAsString(4) : nullptr;
  return name ? std::string(selection.GetAsString(3)) + " " + name : std::string();
}

} // namespace

int vtkSMIsopointRangeDomain::SetDefaultValues(vtkSMProperty* property, bool usesUncheckedValues)
{
  const int result = this->Superclass::SetDefaultValues(property, usesUncheckedValues);
  vtkSMPropertyHelper helper(property);
  helper.SetUseUnchecked(usesUncheckedValues);
  std::optional<double>& value = usesUncheckedValues ? this->ShownDefault : this->Default;
  value = result && helper.GetNumberOfElements() == 1 ? std::optional(helper.GetAsDouble())
                                                      : std::nullopt;
  this->WaitsForArray = !result;
  return result;
}

void vtkSMIsopointRangeDomain::Update(vtkSMProperty* requestingProperty)
{
  // The superclass takes infinite values too, but knows arrays of other names that ParaView
  // converts.
  if (!this->SetFiniteRange())
  {
    this->Superclass::Update(requestingProperty);
  }
  vtkSMProperty* const selection = this->GetRequiredProperty("ArraySelection");
  vtkSMProperty* const property = this->GetProperty();
  if (!selection || !property || !property->GetParent())
  {
    return; // the proxy is deleted
  }
  vtkSMUncheckedPropertyHelper shown(selection);
  const std::string array = chosenArray(shown);
  const bool isAnother = (!this->Array.empty() || this->WaitsForArray) && array != this->Array;
  this->Array = array;
  if (isAnother && this->IsDefault(property))
  {
    // A choice that is not applied yet only changes the panel.
    vtkSMPropertyHelper applied(selection);
    const bool waited = this->WaitsForArray;
    this->SetDefaultValues(property, array != chosenArray(applied));
    if (waited)
    {
      property->GetParent()->UpdateVTKObjects(); // nobody applies what the user did not change
    }
  }
}

bool vtkSMIsopointRangeDomain::SetFiniteRange()
{
  vtkPVDataInformation* const data = this->GetInputDataInformation("Input");
  vtkSMProperty* const selection = this->GetRequiredProperty("ArraySelection");
  if (!data || !selection)
  {
    return false;
  }
  vtkSMUncheckedPropertyHelper shown(selection);
  const char* const name = shown.GetNumberOfElements() >= 5 ? shown.GetAsString(4) : nullptr;
  vtkPVArrayInformation* const array =
    name ? data->GetArrayInformation(name, shown.GetAsInt(3)) : nullptr;
  if (!array)
  {
    return false;
  }
  double range[2];
  array->GetComponentFiniteRange(0, range);
  const bool isAny = range[0] <= range[1];
  this->SetEntries({ vtkEntry(range[0], isAny, range[1], isAny) });
  return true;
}

bool vtkSMIsopointRangeDomain::IsDefault(vtkSMProperty* property) const
{
  vtkSMUncheckedPropertyHelper isovalues(property);
  if (this->WaitsForArray)
  {
    return isovalues.GetNumberOfElements() == 0;
  }
  const std::optional<double> isovalue =
    isovalues.GetNumberOfElements() == 1 ? std::optional(isovalues.GetAsDouble()) : std::nullopt;
  return isovalue && (isovalue == this->Default || isovalue == this->ShownDefault);
}
