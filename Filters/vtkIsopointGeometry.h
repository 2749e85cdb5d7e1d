// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointGeometry_h
#define vtkIsopointGeometry_h

#include "Isopoint/Splat/SplatGeometry.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <string>
#include <vector>

class vtkDataArray;
class vtkPointData;
class vtkPoints;

/**
 * The arrays that are computed for the isopoints of all surfaces, one surface after the other.
 */
class vtkIsopointGeometry
{
public:
  struct Arrays
  {
    bool Normals = false;
    bool Radius = false;
    bool SplatAxes = false;
    bool SplatClip = false;
    bool Gradients = false;
    bool ProjectionOrder = false;
    bool IsProjected = false; // whether fits moved the points

    /// Whether any array is of splats, and whether one is of more than their normals.
    bool NeedsSplats() const { return this->Normals || this->NeedsShapes(); }
    bool NeedsShapes() const { return this->Radius || this->SplatAxes || this->SplatClip; }
  };

  vtkIsopointGeometry(const Arrays& wanted, vtkIdType count);

  /**
   * Writes the next surface's positions to the points, and its arrays. Splats may be empty where
   * none are needed.
   */
  void Append(const isopoint::SurfacePoints& surface, const std::vector<isopoint::Splat>& splats,
    vtkPoints* points);

  /**
   * Points so far around which no fit held.
   */
  vtkIdType GetNumberWithoutFit() const { return this->WithoutFit; }

  /**
   * Adds the arrays that are wanted, the normals as the active ones. Returns the names of those
   * that took another one's place.
   */
  std::vector<std::string> AddTo(vtkPointData* pointData) const;

private:
  Arrays Wanted;
  vtkIdType Next = 0;
  vtkIdType WithoutFit = 0;
  vtkSmartPointer<vtkDataArray> Normals;
  vtkSmartPointer<vtkDataArray> Radius;
  vtkSmartPointer<vtkDataArray> SplatAxis1;
  vtkSmartPointer<vtkDataArray> SplatAxis2;
  vtkSmartPointer<vtkDataArray> SplatClip;
  vtkSmartPointer<vtkDataArray> Gradients;
  vtkSmartPointer<vtkDataArray> ProjectionOrder;
};

#endif
