// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Base/Vector.h"
#include "Core/Fit/LocalFit.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace isopoint
{

/// The points of one surface. Each array has one entry per point.
struct SurfacePoints
{
  const std::vector<Vector>& positions;
  const std::vector<Vector>& decreasingEdges; // see Isosurface
  const std::vector<LocalFit>& fits;          // or empty

  /// Canonical numbers of points, or empty for their indices. They break ties: between points at
  /// the same distance, and between points with the same position and edge.
  std::vector<std::size_t> numbers = {};

  double isovalue = 0.0;

  std::size_t numberOf(std::size_t point) const
  {
    return this->numbers.empty() ? point : this->numbers[point];
  }
};

/// The unit of length at a point: the samples' spacing or, if unknown, half the edge's length.
inline double unitAt(const SurfacePoints& points, std::size_t point)
{
  const double spacing = points.fits.empty() ? 0.0 : points.fits[point].spacing;
  return spacing > 0.0 && std::isfinite(spacing) ? spacing
                                                 : 0.5 * lengthOf(points.decreasingEdges[point]);
}

/// Whether a point has a smooth fit.
inline bool isSmoothAt(const SurfacePoints& points, std::size_t point)
{
  return !points.fits.empty() && points.fits[point].isSmooth;
}

/// The direction opposite to the gradient of a point's fit, if it has a fit.
inline std::optional<Vector> fieldNormal(const SurfacePoints& points, std::size_t point)
{
  if (points.fits.empty() || !points.fits[point].isGradientFitted)
  {
    return std::nullopt;
  }
  const Vector& gradient = points.fits[point].gradient;
  return std::isnormal(lengthOf(gradient)) // denormal gradients have no direction
           ? std::optional(-directionOf(gradient))
           : std::nullopt;
}

/// Sets the normals of points with fits to fieldNormal(), if `areOfField`.
/// @param set(point, normal) called from any thread
/// @returns the points without a normal, ascending
/// @throws std::bad_alloc, Aborted
template <class Set>
std::vector<std::size_t> setFieldNormals(
  const Execution& execution, const SurfacePoints& points, bool areOfField, const Set& set)
{
  std::vector<char> areLeft(points.positions.size(), 1);
  if (areOfField)
  {
    forEachIndex(execution, areLeft.size(),
      [&](std::size_t i)
      {
        if (const std::optional<Vector> normal = fieldNormal(points, i))
        {
          set(i, *normal);
          areLeft[i] = 0;
        }
      });
  }
  return markedOf(execution, areLeft);
}

} // namespace isopoint
