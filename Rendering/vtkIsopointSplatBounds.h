// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointSplatBounds_h
#define vtkIsopointSplatBounds_h

#include "vtkBoundingBox.h"
#include "vtkType.h"

#include <map>
#include <utility>

class vtkCompositeDataDisplayAttributes;
class vtkDataObject;
class vtkPoints;

/**
 * Bounds of the points with finite coordinates, the only ones that are drawn: one point that is not
 * finite would make the bounds, and a camera reset to them, infinite.
 */
class vtkIsopointSplatBounds
{
public:
  /// Bounds of points; not valid if none is finite. O(points).
  static vtkBoundingBox OfFinite(vtkPoints* points);

  /// Bounds of all visible polydata in a data object. O(points) for those that changed since the
  /// last call.
  vtkBoundingBox Of(vtkDataObject* input, vtkCompositeDataDisplayAttributes* attributes);

private:
  std::map<std::pair<vtkPoints*, vtkMTimeType>, vtkBoundingBox> Kept;
};

#endif
// VTK-HeaderTest-Exclude: vtkIsopointSplatBounds.h
