// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointComputedArrays_h
#define vtkIsopointComputedArrays_h

#include "Isopoint/IsosurfaceExtractor.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <string>
#include <vector>

class vtkDataArray;
class vtkPointData;

/**
 * The arrays that are computed for the isopoints of all surfaces, one surface after the other.
 */
class vtkIsopointComputedArrays
{
public:
  struct Choice
  {
    bool Normals = false;
    bool Radius = false;
    bool SplatAxes = false;
    bool SplatClip = false;
    bool Gradients = false;
    bool ProjectionOrder = false;
    bool IsProjected = false; // whether fits move the points

    /// Whether any array is of splats, and whether one is of more than their normals.
    bool NeedsSplats() const { return this->Normals || this->NeedsShapes(); }
    bool NeedsShapes() const { return this->Radius || this->SplatAxes || this->SplatClip; }
  };

  /**
   * @param choice the arrays that are wanted
   * @param count of the points of all surfaces
   * @throws std::bad_alloc
   */
  vtkIsopointComputedArrays(const Choice& choice, vtkIdType count);

  /**
   * Writes the arrays of the next surface.
   */
  void Append(const isopoint::ExtractedIsosurface& extracted);

  /**
   * The number of points so far around which no fit held.
   */
  vtkIdType GetNumberWithoutFit() const { return this->WithoutFit; }

  /**
   * Adds the arrays that are wanted, the normals as the active ones. Returns the names of those
   * that took another one's place.
   */
  std::vector<std::string> AddTo(vtkPointData* pointData) const;

private:
  void SetSplat(const isopoint::Splat& splat);
  void SetFit(const isopoint::LocalFit& fit);

  Choice Wanted;
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
