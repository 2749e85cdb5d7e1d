// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef AccuracyContestants_h
#define AccuracyContestants_h

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <vector>

namespace accuracy
{

/// A way from samples to points of an isosurface.
struct Contestant
{
  std::string name;

  /// @param samples a cloud with the scalars "value"; for those on a grid its nodes, x fastest
  /// @returns points with active normals; those of splats also with "Radius", and with
  /// "SplatAxis1" and "SplatAxis2" where they are elliptical
  std::function<vtkSmartPointer<vtkPolyData>(vtkPolyData* samples, double isovalue)> extract;
};

/// Those that take scattered samples: ours in each mode, then the peers.
std::vector<Contestant> scatteredContestants();

/// Marching cubes, which takes the nodes of a grid over the cube [-1, 1]^3.
Contestant gridContestant();

} // namespace accuracy

#endif
