// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointSplatShapes_h
#define vtkIsopointSplatShapes_h

#include "vtkVector.h"
// Later versions of VTK have the operators in vtkVector.h.
#if __has_include("vtkVectorOperators.h")
#include "vtkVectorOperators.h"
#endif

#include <array>
#include <string>

class vtkDataArray;
class vtkDataSet;
class vtkDataSetAttributes;
class vtkIsopointVertexCells;
class vtkUnsignedCharArray;

/// Where the fan of a splat has its vertices: its corners, and before these, unless the fan is
/// nearly flat, its point.
struct vtkIsopointSplatFan
{
  static constexpr int MaximumVertices = 9;

  int Vertices = 0; // 0: nothing is drawn
  int Triangles = 0;
  float Tolerance = 0.0f; // how far corners that are shared with other splats may be apart; 0: none
  std::array<vtkVector3d, MaximumVertices> Places;
  std::array<vtkVector3d, MaximumVertices> Normals;
};

/// The vertex that is the corner 0, 1 or 2 of one of a fan's triangles.
int vtkIsopointSplatCorner(const vtkIsopointSplatFan& fan, int triangle, int corner);

/// The shapes of the splats of a data set, from its arrays and those of its vertex cells. Reading
/// is thread-safe.
class vtkIsopointSplatShapes
{
public:
  /// @param cells of the data; kept by reference
  /// @param radius of points without an array of radii; 0: suits the number of points
  /// @param scale factor on all sizes
  vtkIsopointSplatShapes(vtkDataSet* data, const vtkIsopointVertexCells& cells,
    const char* radiusArrayName, double radius, double scale);

  /// What is wrong with the arrays of shapes, for a warning; empty if nothing is.
  std::string Problem() const;

  vtkIsopointSplatFan Fan(vtkIdType point) const;

private:
  static vtkDataArray* Usable(vtkDataArray* array, int components, vtkIdType tuples);
  bool IsGhost(vtkIdType point) const;
  /// The tuple of the point's polygon; -1: none, or one for another normal.
  vtkIdType PolygonOf(vtkIdType point, const vtkVector3d& normal) const;
  bool SetPolygon(vtkIdType tuple, const vtkVector3d& normal, vtkIsopointSplatFan& fan) const;
  void SetOctagon(const vtkVector3d& normal, double radius, vtkIsopointSplatFan& fan) const;
  void SetOctahedron(double radius, vtkIsopointSplatFan& fan) const;

  vtkDataSet* Data;
  const vtkIsopointVertexCells& Cells;
  vtkDataSetAttributes* Shapes; // have the arrays of splats, if any do
  vtkDataArray* Normals;
  vtkDataArray* Radii;
  vtkDataArray* Axes;
  vtkDataArray* Polygons;
  vtkUnsignedCharArray* Ghosts;
  double Radius;
  double Scale;
  double PositionError; // relative
};

#endif
