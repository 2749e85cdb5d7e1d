// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef BenchmarkClouds_h
#define BenchmarkClouds_h

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <string>

/// The clouds that are timed. The array "value" of all but those of files has the distance to the
/// center of a cube of side 200 around the origin, as for the sphere of [RL06], section 9.
namespace clouds
{

constexpr double side = 200.0;

/// Random positions of constant density.
vtkSmartPointer<vtkPolyData> uniform(std::size_t count);

/// Random positions whose density varies ten-thousandfold, highest at a point of the sphere.
vtkSmartPointer<vtkPolyData> clustered(std::size_t count);

/// Random positions in a slab twenty times thinner than wide, through the center.
vtkSmartPointer<vtkPolyData> slab(std::size_t count);

/// A regular lattice of about `count` samples, in the order of an image's points.
vtkSmartPointer<vtkPolyData> lattice(std::size_t count);

/// Random positions in the bounds of a VTK XML image file, with its first point array interpolated,
/// as [RL06] does with a volume. @throws std::runtime_error if the file is no such image
vtkSmartPointer<vtkPolyData> resampled(const std::string& file, std::size_t count);

} // namespace clouds

#endif
