// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef AccuracySamples_h
#define AccuracySamples_h

#include "AnalyticSurface.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

/// Samples of analytic fields over the cube [-1, 1]^3, on which accuracy is measured. Their values
/// are in the array "value", in double.
namespace accuracy
{

/// The ways to place samples, in the order of a report.
inline const std::array<std::string, 4> samplings{ "uniform", "clustered", "jittered", "lines" };

/// The mean spacing of a number of samples in the cube: the cube root of the volume per sample.
double meanSpacing(std::size_t count);

/// About `count` positions.
/// - uniform: random, of constant density;
/// - clustered: 30 % uniform, the others around twelve random centers, with normally distributed
///   offsets of standard deviation 0.15 on each axis;
/// - jittered: one sample in each cell of a lattice, within 0.4 cells of its center on each axis;
/// - lines: random lines parallel to the z axis, four times farther apart than samples on a line.
/// @throws std::invalid_argument for another name
std::vector<analytic::Vector> positionsOf(const std::string& sampling, std::size_t count);

/// The standard deviation of the field over the cube, in units of which noise is given.
double deviationOf(const analytic::Surface& surface);

/// The field's values at positions, plus normally distributed noise of a standard deviation.
vtkSmartPointer<vtkPolyData> sampled(const analytic::Surface& surface,
  const std::vector<analytic::Vector>& positions, double noiseDeviation);

/// The positions of a grid of about `count` nodes over the cube, x fastest.
std::vector<analytic::Vector> gridPositions(std::size_t count);

} // namespace accuracy

#endif
