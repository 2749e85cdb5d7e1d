// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef Rows_h
#define Rows_h

#include "Report.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

/// A cloud to contour, and how.
struct Task
{
  std::string cloud;
  vtkSmartPointer<vtkPolyData> samples;
  double isovalue = 70.0;
  int threads = 2;
  bool isSphere = true; // whether the true surface is the sphere of the isovalue's radius
};

/// A lower bound: the seconds of one copy of positions and values on one thread, into memory that
/// is already mapped.
double copySeconds(vtkPolyData* samples);

/// This project's filters: isopoints on their edges, projected, projected with normals and radii;
/// triangles on their edges, projected with normals; isopoints with a kept tree at other isovalues
/// and with new values; on one thread.
std::vector<Row> measureOurs(const Task& task, double copy);

/// Triangles on their edges, and CGAL's parallel tetrahedrization with one pass over its cells,
/// which runs once.
std::vector<Row> measureTriangles(const Task& task, double copy);

/// The alternatives: VTK's resampling to a grid, CGAL's Delaunay triangulation, and vtkDelaunay3D
/// where it takes less than a minute.
std::vector<Row> measurePeers(const Task& task, double copy, const Row& ours);

#endif
