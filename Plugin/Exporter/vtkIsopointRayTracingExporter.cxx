// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointRayTracingExporter.h"

#include "vtkCallbackCommand.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkPNGWriter.h"
#include "vtkRenderPass.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"
#include "vtkSmartPointer.h"
#include "vtkWindowToImageFilter.h"

#include <vtksys/SystemTools.hxx>

#include <string>
#include <utility>

vtkStandardNewMacro(vtkIsopointRayTracingExporter);

namespace
{

vtkIsopointRayTracingExporter::Monitor& theMonitor()
{
  static vtkIsopointRayTracingExporter::Monitor monitor;
  return monitor;
}

} // namespace

void vtkIsopointRayTracingExporter::SetMonitor(Monitor monitor)
{
  theMonitor() = std::move(monitor);
}

vtkIsopointRayTracingExporter::vtkIsopointRayTracingExporter() = default;

vtkIsopointRayTracingExporter::~vtkIsopointRayTracingExporter()
{
  this->SetFileName(nullptr);
}

void vtkIsopointRayTracingExporter::WriteData()
{
  if (!this->FileName || !this->FileName[0])
  {
    vtkErrorMacro("There is no file name: set one.");
    return;
  }
  vtkRenderer* const renderer = this->ActiveRenderer
                                  ? this->ActiveRenderer
                                  : this->RenderWindow->GetRenderers()->GetFirstRenderer();
  if (!renderer)
  {
    vtkErrorMacro("The window shows nothing: it has no renderer.");
    return;
  }
  const std::string folder =
    vtksys::SystemTools::GetFilenamePath(vtksys::SystemTools::CollapseFullPath(this->FileName));
  if (!vtksys::SystemTools::FileIsDirectory(folder))
  {
    vtkErrorMacro("The picture " << this->FileName << " cannot be written: there is no folder "
                                 << folder << ". Choose one that can be written to.");
    return;
  }
  if (this->Trace(renderer))
  {
    this->WriteWindow(renderer);
  }
  if (theMonitor())
  {
    theMonitor()(1.0);
  }
}

bool vtkIsopointRayTracingExporter::Trace(vtkRenderer* renderer)
{
  int size[2];
  int origin[2];
  renderer->GetTiledSizeAndOrigin(&size[0], &size[1], &origin[0], &origin[1]);
  vtkNew<vtkCallbackCommand> progress;
  progress->SetCallback(
    [](vtkObject* tracer, unsigned long, void*, void* share)
    {
      if (theMonitor() && !theMonitor()(*static_cast<double*>(share)))
      {
        vtkIsopointRayTracer::SafeDownCast(tracer)->AbortExecuteOn();
      }
    });
  const unsigned long observer = this->Tracer->AddObserver(vtkCommand::ProgressEvent, progress);
  if (theMonitor())
  {
    theMonitor()(0.0); // preparing the scene comes first
  }
  vtkNew<vtkImageData> image;
  const bool isComplete = this->Tracer->RenderToImage(
    renderer, this->Magnification * size[0], this->Magnification * size[1], image);
  this->Tracer->RemoveObserver(observer);
  return isComplete; // otherwise the tracer reported an error, or was stopped
}

void vtkIsopointRayTracingExporter::WriteWindow(vtkRenderer* renderer)
{
  const vtkSmartPointer<vtkRenderPass> pass = renderer->GetPass();
  renderer->SetPass(this->Tracer);
  vtkNew<vtkWindowToImageFilter> window;
  window->SetInput(this->RenderWindow);
  window->SetScale(this->Magnification);
  window->ReadFrontBufferOff();
  window->Update();
  renderer->SetPass(pass);
  this->Tracer->ReleaseGraphicsResources(this->RenderWindow);

  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(this->FileName);
  writer->SetInputData(window->GetOutput());
  writer->Write();
  this->RenderWindow->Render(); // without the traced picture
  if (writer->GetErrorCode() != vtkErrorCode::NoError)
  {
    vtkErrorMacro("The picture " << this->FileName
                                 << " cannot be written. Choose a folder with room, and that can be"
                                    " written to.");
  }
}

void vtkIsopointRayTracingExporter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << '\n'
     << indent << "Magnification: " << this->Magnification << '\n'
     << indent << "Tracer:\n";
  this->Tracer->PrintSelf(os, indent.GetNextIndent());
}
