// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointTracedScene_h
#define vtkIsopointTracedScene_h

#include "Tracer/Scene.h"
#include "vtkIsopointTracedFrame.h"

#include <memory>
#include <string>
#include <vector>

class vtkActor;
class vtkProp;

/// Whether a prop is visible and can be traced: an actor with triangles that are drawn as a
/// surface.
bool vtkIsopointIsTraced(vtkProp* prop);

/// The traced surfaces of a renderer's actors, kept as long as these stay the same.
class vtkIsopointTracedScene
{
public:
  /// Brings the surfaces up to date.
  /// @returns whether they changed
  /// @throws std::bad_alloc, std::runtime_error
  bool Update(const std::vector<vtkActor*>& actors, double absorptionDistance);

  /// Forgets the surfaces.
  void Clear();

  const raytracing::Scene& Get() const { return *this->Scene; }
  const vtkIsopointTracedFrame& GetFrame() const { return this->Frame; }

private:
  std::unique_ptr<raytracing::Scene> Scene;
  vtkIsopointTracedFrame Frame;
  std::string State; // identifies the actors that the scene is made of
};

#endif
