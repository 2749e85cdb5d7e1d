// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointSplatShapes_h
#define vtkIsopointSplatShapes_h

#include "Core/SplatMesh/SplatFan.h"

#include "vtkType.h"

#include <string>

class vtkDataArray;
class vtkDataSet;
class vtkDataSetAttributes;
class vtkIsopointVertexCells;
class vtkUnsignedCharArray;

/// The splat shapes of a data set, from its arrays and those of its vertex cells. Thread-safe.
class vtkIsopointSplatShapes
{
public:
  /// @param cells of the data; kept by reference
  /// @param radius of points without an array of radii; 0: derived from the number of points
  /// @param scale factor on all sizes
  vtkIsopointSplatShapes(vtkDataSet* data, const vtkIsopointVertexCells& cells,
    const char* radiusArrayName, double radius, double scale);

  /// What makes splats other than those of isopoints, for a warning; empty if nothing does.
  std::string Problem() const;

  isopoint::SplatFan Fan(vtkIdType point) const;

private:
  static vtkDataArray* Usable(vtkDataArray* array, int components, vtkIdType tuples);
  bool IsGhost(vtkIdType point) const;
  /// The tuple of the point's polygon; -1 if there is none, or only one for another normal.
  vtkIdType PolygonOf(vtkIdType point, const isopoint::Vector& normal) const;

  vtkDataSet* Data;
  const vtkIsopointVertexCells& Cells;
  vtkDataSetAttributes* Shapes; // with the arrays of splats, if any
  vtkDataArray* Normals;
  vtkDataArray* Radii;
  vtkDataArray* Axes;
  vtkDataArray* Polygons;
  vtkUnsignedCharArray* Ghosts;
  double Radius;
  bool IsRadiusDerived = false; // from the number of points
  double Scale;
  double PositionError;
};

#endif
