// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointSplatBounds_h
#define vtkIsopointSplatBounds_h

#include "vtkBoundingBox.h"
#include "vtkScatteredIsopointRenderingModule.h" // for the export macro
#include "vtkType.h"

#include <map>
#include <string>
#include <tuple>

class vtkCompositeDataDisplayAttributes;
class vtkDataArray;
class vtkDataObject;
class vtkPoints;

/**
 * Bounds of splats whose points have finite coordinates, the only ones that are drawn: one point
 * that is not finite would make the bounds, and a camera reset to them, infinite.
 */
class VTKSCATTEREDISOPOINTRENDERING_EXPORT vtkIsopointSplatBounds
{
public:
  /// Bounds of points; not valid if none is finite. O(points).
  static vtkBoundingBox OfFinite(vtkPoints* points);

  /// Radius for points spread over a surface whose area is the square of the diagonal of the finite
  /// ones' bounding box. O(points).
  static double AutomaticRadius(vtkPoints* points);

  /// How far splats reach from their points: the value of the array of this name or, without it,
  /// the same for all, times a scale; nothing where that is not positive and finite.
  struct Reach
  {
    std::string ArrayName;
    double Radius;
    double Scale;
  };

  /// Bounds of the splats of all visible polydata in a data object; of points that reach somewhere.
  /// O(points) for those that changed since the last call.
  vtkBoundingBox Of(
    vtkDataObject* input, vtkCompositeDataDisplayAttributes* attributes, const Reach& reach);

private:
  /// Points, radii and scale, and when they were modified.
  using Key = std::tuple<vtkPoints*, vtkMTimeType, vtkDataArray*, vtkMTimeType, double, double>;
  std::map<Key, vtkBoundingBox> Kept;
};

#endif
// VTK-HeaderTest-Exclude: vtkIsopointSplatBounds.h
