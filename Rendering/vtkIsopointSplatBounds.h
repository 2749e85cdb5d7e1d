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
 * Bounds of the points with finite coordinates, the only ones that are drawn: a single one that is
 * not finite must not send the camera to infinity.
 */
class vtkIsopointSplatBounds
{
public:
  /// Of some points; not valid where none is finite. O(points).
  static vtkBoundingBox OfFinite(vtkPoints* points);

  /// Of all visible polydata in a data object, kept from the last call where points are the same.
  vtkBoundingBox Of(vtkDataObject* input, vtkCompositeDataDisplayAttributes* attributes);

private:
  std::map<std::pair<vtkPoints*, vtkMTimeType>, vtkBoundingBox> Kept;
};

#endif
// VTK-HeaderTest-Exclude: vtkIsopointSplatBounds.h
