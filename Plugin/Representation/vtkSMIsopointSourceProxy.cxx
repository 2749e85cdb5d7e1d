// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkSMIsopointSourceProxy.h"

#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"
#include "vtkPVPluginTracker.h"
#include "vtkSMTrace.h"

#include <cstring>
#include <string>

vtkStandardNewMacro(vtkSMIsopointSourceProxy);

namespace
{

/// The file that this plugin was loaded from; empty if it is linked into the program.
std::string findPluginFile()
{
  vtkPVPluginTracker* const tracker = vtkPVPluginTracker::GetInstance();
  for (unsigned int i = 0; i < tracker->GetNumberOfPlugins(); ++i)
  {
    const char* const file = tracker->GetPluginFileName(i);
    if (file && tracker->GetPluginLoaded(i) &&
        std::strcmp(tracker->GetPluginName(i), "ScatteredIsopoints") == 0)
    {
      return file;
    }
  }
  return {};
}

} // namespace

void vtkSMIsopointSourceProxy::AddConsumer(vtkSMProperty* property, vtkSMProxy* consumer)
{
  this->Superclass::AddConsumer(property, consumer);
  const std::string writer = consumer && consumer->GetXMLName() ? consumer->GetXMLName() : "";
  if (writer == "PSTLWriter" && std::strcmp(this->GetXMLName(), "ScatteredIsopoints") == 0)
  {
    vtkOutputWindowDisplayWarningText(
      "STL files hold triangles, and isopoints have none: the file will be empty. Save Scattered"
      " Isosurface or Isopoint Splat Polygons instead.\n");
  }
}

void vtkSMIsopointSourceProxy::CreateVTKObjects()
{
  if (!this->ObjectsCreated && vtkSMTrace::GetActiveTracer())
  {
    const std::string file = findPluginFile();
    if (!file.empty())
    {
      const std::string text = std::string("if '") + this->GetXMLName() +
                               "' not in globals():\n    LoadPlugin('" + file + "', ns=globals())";
      SM_SCOPED_TRACE(TraceText)
        .arg(text.c_str())
        .arg("comment", "load the plugin of the filter, unless it is loaded");
    }
  }
  this->Superclass::CreateVTKObjects();
}

void vtkSMIsopointSourceProxy::PostUpdateData(bool usesCache)
{
  this->Superclass::PostUpdateData(usesCache);
  this->UpdatePropertyInformation();
}
