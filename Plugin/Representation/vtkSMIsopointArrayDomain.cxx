// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkSMIsopointArrayDomain.h"

#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMUncheckedPropertyHelper.h"

vtkStandardNewMacro(vtkSMIsopointArrayDomain);

namespace
{

bool isVarying(vtkPVDataInformation* data, const char* name, int association)
{
  vtkPVArrayInformation* const array = data->GetArrayInformation(name, association);
  if (!array)
  {
    return false;
  }
  double range[2];
  array->GetComponentFiniteRange(0, range);
  return range[0] < range[1];
}

} // namespace

//------------------------------------------------------------------------------
int vtkSMIsopointArrayDomain::SetDefaultValues(vtkSMProperty* property, bool usesUncheckedValues)
{
  int result = this->Superclass::SetDefaultValues(property, usesUncheckedValues);
  vtkPVDataInformation* const data = this->GetInputDataInformation("Input");
  vtkSMPropertyHelper helper(property);
  helper.SetUseUnchecked(usesUncheckedValues);
  const char* const chosen = helper.GetInputArrayNameToProcess();
  bool isSet = !data || !chosen || isVarying(data, chosen, helper.GetInputArrayAssociation());
  for (unsigned int i = 0; !isSet && i < this->GetNumberOfStrings(); ++i)
  {
    const int association = this->GetFieldAssociation(i);
    isSet = isVarying(data, this->GetString(i), association);
    if (isSet)
    {
      helper.SetInputArrayToProcess(association, this->GetString(i));
      result = 1;
    }
  }
  this->DefaultTime = property->GetMTime();
  return result;
}

//------------------------------------------------------------------------------
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
    return; // the former one is taken off before another one is connected
  }
  const bool isReplaced = this->Input && this->Input.GetPointer() != input;
  this->Input = input;
  vtkSMProperty* const property = this->GetProperty();
  if (isReplaced && property && this->GetNumberOfStrings() > 0 && this->IsReplaceable(property))
  {
    this->SetDefaultValues(property, false);
  }
}

//------------------------------------------------------------------------------
bool vtkSMIsopointArrayDomain::IsReplaceable(vtkSMProperty* property)
{
  const char* const chosen = vtkSMPropertyHelper(property).GetInputArrayNameToProcess();
  unsigned int index = 0;
  if (!chosen || !this->IsInDomain(chosen, index))
  {
    return true;
  }
  vtkSMProxy* const filter = property->GetParent();
  const bool isBeingCreated =
    filter && !filter->GetSessionProxyManager()->GetProxyName("sources", filter);
  return isBeingCreated && property->GetMTime() == this->DefaultTime;
}
