// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointSplatMesh_h
#define vtkIsopointSplatMesh_h

#include "vtkIsopointSplatShapes.h"

#include "vtkType.h"
#include "vtkVector.h"

#include <functional>
#include <vector>

/// A corner of a splat.
struct vtkIsopointCorner
{
  vtkVector3d Place;
  vtkVector3f Normal;
  float Tolerance = 0.0f; // how far others that are the same may be; 0: there are none
};

/// Called on the thread that started the work, with the share of it that is done. Returns whether
/// the work goes on.
using vtkIsopointStep = std::function<bool(double share)>;

/// The triangles of all splats, in the order of the points. Each splat has vertices of its own.
struct vtkIsopointSplatMesh
{
  /// O(n log n) in the number of points.
  /// @returns whether the mesh is complete; if not, `step` has ended the work
  /// @throws std::bad_alloc
  bool Build(const vtkIsopointSplatShapes& shapes, vtkIdType points, const vtkIsopointStep& step);

  vtkIdType NumberOfVertices() const { return this->FirstVertices.back(); }
  vtkIdType NumberOfTriangles() const { return this->FirstTriangles.back(); }

  /// The first vertex and triangle of each point, and the numbers of all.
  std::vector<vtkIdType> FirstVertices;
  std::vector<vtkIdType> FirstTriangles;

  std::vector<vtkIsopointCorner> Vertices;
  std::vector<vtkIdType> Corners; // three vertices of each triangle

  /// The points whose splats have a vertex at the same place: MeetingPoints from FirstMeeting of
  /// the vertex MeetsAt[i] up to that of the next one.
  std::vector<vtkIdType> MeetsAt;
  std::vector<vtkIdType> FirstMeeting;
  std::vector<vtkIdType> MeetingPoints;
};

#endif
