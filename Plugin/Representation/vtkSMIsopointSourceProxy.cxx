// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkSMIsopointSourceProxy.h"

#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"
#include "vtkPVPluginTracker.h"
#include "vtkPythonInterpreter.h"
#include "vtkSMTrace.h"

#include <cstring>
#include <iomanip>
#include <sstream>
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

void vtkSMIsopointSourceProxy::LoadInTrace()
{
  const std::string file = vtkSMTrace::GetActiveTracer() ? findPluginFile() : "";
  if (file.empty())
  {
    return;
  }
  std::ostringstream script;
  script << R"python(
def trace_loading(file):
    from paraview import smtrace
    lines = smtrace.Trace.Output.raw_data()
    load = ["# load the plugin of Scattered Isopoints, unless it is loaded",
            "if 'ScatteredIsopoints' not in globals():", f"    LoadPlugin({file!r}, ns=globals())"]
    if load[0] not in lines:
        begin = "from paraview.simple import *"
        # later parts of a trace, after a reset of its output, lack this line
        start = lines.index(begin) + 1 if begin in lines else 0
        lines[start:start] = load

trace_loading()python"
         << std::quoted(file) << ")\ndel trace_loading\n";
  vtkPythonInterpreter::RunSimpleString(script.str().c_str());
}

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
  if (!this->ObjectsCreated)
  {
    vtkSMIsopointSourceProxy::LoadInTrace();
  }
  this->Superclass::CreateVTKObjects();
}

void vtkSMIsopointSourceProxy::PostUpdateData(bool usesCache)
{
  this->Superclass::PostUpdateData(usesCache);
  this->UpdatePropertyInformation();
}
