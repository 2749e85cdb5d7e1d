// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointTracedPlacement_h
#define vtkIsopointTracedPlacement_h

#include "Tracer/Vector.h"

#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"

#include <array>
#include <cmath>

/// The scene's coordinates: the world's, with a point of it at the origin and a length of it as
/// unit.
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

inline raytracing::Vector vtkIsopointTracedVector(const double* vector)
{
  return { static_cast<float>(vector[0]), static_cast<float>(vector[1]),
    static_cast<float>(vector[2]) };
}

/// From an actor's coordinates to those of the scene.
class vtkIsopointTracedPlacement
{
public:
  vtkIsopointTracedPlacement(vtkMatrix4x4* modelToWorld, const vtkIsopointTracedFrame& frame)
  {
    this->Matrix->DeepCopy(modelToWorld);
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 4; ++column)
      {
        const double shift = column == 3 ? frame.Center[row] : 0.0;
        this->Matrix->SetElement(
          row, column, (modelToWorld->GetElement(row, column) - shift) / frame.Length);
      }
    }
    vtkNew<vtkMatrix3x3> linear;
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 3; ++column)
      {
        linear->SetElement(row, column, this->Matrix->GetElement(row, column));
      }
    }
    this->Scale = std::cbrt(std::abs(linear->Determinant()));
    this->IsSingular = !(this->Scale > 0.0);
    if (!this->IsSingular)
    {
      linear->Invert();
      linear->Transpose();
      this->NormalMatrix->DeepCopy(linear);
    }
  }

  /// Whether the actor is flattened to nothing, and cannot be placed.
  bool GetIsSingular() const { return this->IsSingular; }

  /// The mean factor on lengths.
  double GetScale() const { return this->Scale; }

  std::array<double, 3> Point(const double* point) const
  {
    std::array<double, 3> result = this->Offset(point);
    for (int row = 0; row < 3; ++row)
    {
      result[row] += this->Matrix->GetElement(row, 3);
    }
    return result;
  }

  std::array<double, 3> Offset(const double* offset) const
  {
    std::array<double, 3> result;
    for (int row = 0; row < 3; ++row)
    {
      const double* const elements = this->Matrix->Element[row];
      result[row] = elements[0] * offset[0] + elements[1] * offset[1] + elements[2] * offset[2];
    }
    return result;
  }

  /// A normal, neither scaled to unit length.
  std::array<double, 3> Normal(const double* normal) const
  {
    std::array<double, 3> result;
    this->NormalMatrix->MultiplyPoint(normal, result.data());
    return result;
  }

private:
  vtkNew<vtkMatrix4x4> Matrix;
  vtkNew<vtkMatrix3x3> NormalMatrix; // the transposed inverse
  double Scale = 0.0;
  bool IsSingular = false;
};

#endif
// VTK-HeaderTest-Exclude: vtkIsopointTracedPlacement.h
