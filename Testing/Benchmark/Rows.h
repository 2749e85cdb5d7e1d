// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef Rows_h
#define Rows_h

#include "Report.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

/// What is measured of one cloud, and how.
struct Task
{
  std::string cloud;
  vtkSmartPointer<vtkPolyData> samples;
  double isovalue = 70.0;
  int threads = 2;
  bool isSphere = true; // whether the true surface is the sphere of the isovalue's radius
};

/// The floor: seconds for one copy of positions and values in one thread, memory touched before.
double copySeconds(vtkPolyData* samples);

/// Ours: isopoints by linear interpolation, projected, the same with normals and radii, further
/// isovalues, new values, one thread.
std::vector<Row> measureOurs(const Task& task, double copy);

/// CGAL, VTK's resampling route, and vtkDelaunay3D where it is expected to end within a minute.
std::vector<Row> measurePeers(const Task& task, double copy, const Row& ours);

#endif
