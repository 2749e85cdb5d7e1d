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

/// A method that computes points of an isosurface from samples.
struct Contestant
{
  std::string name;

  /// @param samples a cloud with the scalars "value"; for gridContestant() the nodes of the grid, x
  /// fastest
  /// @returns points with active normals; if they are splats, with the arrays of these
  std::function<vtkSmartPointer<vtkPolyData>(vtkPolyData* samples, double isovalue)> extract;
};

/// The methods for scattered samples: this project's filter in each mode, then the alternatives.
std::vector<Contestant> scatteredContestants();

/// Marching cubes, which takes the nodes of a grid over the cube [-1, 1]^3.
Contestant gridContestant();

} // namespace accuracy

#endif
