// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkIsopointRayTracingExporter
 * @brief   writes what a view shows as a ray-traced PNG picture
 *
 * The picture of vtkIsopointRayTracer, as large as the view or a multiple of it, with everything
 * else in the view, such as color legends and axes. The properties are the ray tracer's.
 */
#ifndef vtkIsopointRayTracingExporter_h
#define vtkIsopointRayTracingExporter_h

#include "vtkExporter.h"
#include "vtkIsopointRayTracer.h" // for the properties
#include "vtkNew.h"
#include "vtkScatteredIsopointExportersModule.h" // for the export macro

#include <functional> // for the monitor

class vtkRenderer;

class VTKSCATTEREDISOPOINTEXPORTERS_EXPORT vtkIsopointRayTracingExporter : public vtkExporter
{
public:
  static vtkIsopointRayTracingExporter* New();
  vtkTypeMacro(vtkIsopointRayTracingExporter, vtkExporter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Name of the PNG file. Default: none.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * Factor on the width and height of the view. Range: 1 to 16. Default: 1.
   */
  vtkSetClampMacro(Magnification, int, 1, 16);
  vtkGetMacro(Magnification, int);
  ///@}

  ///@{
  /**
   * Properties of the ray tracer, see vtkIsopointRayTracer.
   */
  void SetSamplesPerPixel(int samples) { this->Tracer->SetSamplesPerPixel(samples); }
  void SetShadows(bool shadows) { this->Tracer->SetShadows(shadows); }
  void SetLightAngle(double angle) { this->Tracer->SetLightAngle(angle); }
  void SetAmbientLight(double light) { this->Tracer->SetAmbientLight(light); }
  void SetAmbientDistance(double distance) { this->Tracer->SetAmbientDistance(distance); }
  void SetMaximumNumberOfBounces(int bounces) { this->Tracer->SetMaximumNumberOfBounces(bounces); }
  void SetAbsorptionDistance(double distance) { this->Tracer->SetAbsorptionDistance(distance); }
  ///@}

  /**
   * Called several times a second with the share done, 0 to 1, on the exporting thread, while no
   * OpenGL context is in use. If it returns false, the export ends and writes nothing.
   */
  using Monitor = std::function<bool(double share)>;

  /**
   * Sets a monitor of all exports of this process, which shows their progress. Default: none.
   */
  static void SetMonitor(Monitor monitor);

protected:
  vtkIsopointRayTracingExporter();
  ~vtkIsopointRayTracingExporter() override;

  void WriteData() override;

  /// @returns whether the picture is complete
  bool Trace(vtkRenderer* renderer);

  /// Writes the window with the traced picture in it.
  void WriteWindow(vtkRenderer* renderer);

  char* FileName = nullptr;
  int Magnification = 1;

private:
  vtkIsopointRayTracingExporter(const vtkIsopointRayTracingExporter&) = delete;
  void operator=(const vtkIsopointRayTracingExporter&) = delete;

  vtkNew<vtkIsopointRayTracer> Tracer;
};

#endif
