// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointTracedScene_h
#define vtkIsopointTracedScene_h

#include "Tracer/Scene.h"
#include "vtkIsopointTracedFrame.h"

#include <ios>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

class vtkActor;
class vtkProp;

/// Whether a prop is visible and can be traced: an actor with triangles shown as a surface.
bool vtkIsTraced(vtkProp* prop);

/// A text that differs if any of its values differ.
class vtkIsopointTracedState
{
public:
  vtkIsopointTracedState() { this->Text << std::hexfloat; }

  template <class... Values>
  void Add(const Values&... values)
  {
    ((this->Text << values << ' '), ...);
  }

  std::string Get() const { return this->Text.str(); }

private:
  std::ostringstream Text;
};

/// The traced surfaces of a renderer's actors, rebuilt only when these change.
class vtkIsopointTracedScene
{
public:
  /// @returns whether the surfaces changed
  /// @throws std::bad_alloc, std::runtime_error
  bool Update(const std::vector<vtkActor*>& actors, double absorptionDistance);

  void Clear();

  const raytracing::Scene& Get() const { return *this->Scene; }
  const vtkIsopointTracedFrame& GetFrame() const { return this->Frame; }

private:
  std::unique_ptr<raytracing::Scene> Scene;
  vtkIsopointTracedFrame Frame;
  std::string State; // identifies the actors of the scene
};

#endif
