// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkSMIsopointArrayDomain.h"

#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"

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
  const int result = this->Superclass::SetDefaultValues(property, usesUncheckedValues);
  vtkPVDataInformation* const data = this->GetInputDataInformation("Input");
  vtkSMPropertyHelper helper(property);
  helper.SetUseUnchecked(usesUncheckedValues);
  const char* const chosen = helper.GetInputArrayNameToProcess();
  if (!data || !chosen || isVarying(data, chosen, helper.GetInputArrayAssociation()))
  {
    return result;
  }
  for (unsigned int i = 0; i < this->GetNumberOfStrings(); ++i)
  {
    const int association = this->GetFieldAssociation(i);
    if (isVarying(data, this->GetString(i), association))
    {
      helper.SetInputArrayToProcess(association, this->GetString(i));
      return 1;
    }
  }
  return result;
}
