// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointSplatMesh_h
#define vtkIsopointSplatMesh_h

#include "vtkIsopointSplatShapes.h"

#include "vtkType.h"
#include "vtkVector.h"

#include <vector>

/**
 * The triangles of all splats, in the order of the points. Each splat has vertices of its own, but
 * for corners where it meets others with the same normal: these are one vertex. The last corner of
 * each triangle is a vertex that no other splat has, so that OpenGL's provoking vertex names the
 * splat.
 */
struct vtkIsopointSplatMesh
{
  /// O(n log n) in the number of points.
  /// @throws std::bad_alloc
  vtkIsopointSplatMesh(const vtkIsopointSplatShapes& shapes, vtkIdType points);

  vtkIdType NumberOfVertices() const { return static_cast<vtkIdType>(this->Places.size()); }
  vtkIdType NumberOfTriangles() const { return this->FirstTriangles.back(); }

  std::vector<vtkVector3d> Places;  // of the vertices
  std::vector<vtkVector3f> Normals; // of unit length
  std::vector<vtkIdType> Corners;   // three vertices of each triangle

  /// The first triangle of each point, and the number of all.
  std::vector<vtkIdType> FirstTriangles;

  /// The points whose splats have a vertex, in ascending order: MeetingPoints from FirstMeeting of
  /// the vertex up to that of the next one.
  std::vector<vtkIdType> FirstMeeting;
  std::vector<vtkIdType> MeetingPoints;
};

#endif
// VTK-HeaderTest-Exclude: vtkIsopointSplatMesh.h
