// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointTracedFrame_h
#define vtkIsopointTracedFrame_h

#include "Tracer/Vector.h"

#include <array>

/// The coordinates of the scene: world coordinates, shifted and scaled.
struct vtkIsopointTracedFrame
{
  std::array<double, 3> Center = { 0.0, 0.0, 0.0 };
  double Length = 1.0;

  std::array<double, 3> ToScene(const double* world) const
  {
    return { (world[0] - this->Center[0]) / this->Length,
      (world[1] - this->Center[1]) / this->Length, (world[2] - this->Center[2]) / this->Length };
  }
};

inline raytracing::Vector vtkToTracedVector(const double* vector)
{
  return { static_cast<float>(vector[0]), static_cast<float>(vector[1]),
    static_cast<float>(vector[2]) };
}

#endif
