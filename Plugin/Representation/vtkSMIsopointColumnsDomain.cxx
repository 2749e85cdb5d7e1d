// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkSMIsopointColumnsDomain.h"

#include "vtkObjectFactory.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <string>
#include <vector>

vtkStandardNewMacro(vtkSMIsopointColumnsDomain);

int vtkSMIsopointColumnsDomain::SetDefaultValues(vtkSMProperty* property, bool usesUncheckedValues)
{
  vtkSMProxy* const spreadsheet = property->GetParent();
  if (!spreadsheet)
  {
    return 0; // the proxy is deleted
  }
  vtkSMPropertyHelper hidden(spreadsheet, "HiddenColumnLabels");
  hidden.SetUseUnchecked(usesUncheckedValues);
  std::vector<std::string> labels;
  for (unsigned int i = 0; i < hidden.GetNumberOfElements(); ++i)
  {
    labels.emplace_back(hidden.GetAsString(i));
  }
  for (const char* const label :
    { "SplatAxis", "SplatAxis_Magnitude", "SplatPolygon", "SplatPolygon_Magnitude" })
  {
    labels.emplace_back(label);
  }
  hidden.SetNumberOfElements(static_cast<unsigned int>(labels.size()));
  for (unsigned int i = 0; i < labels.size(); ++i)
  {
    hidden.Set(i, labels[i].c_str());
  }
  return 1;
}
