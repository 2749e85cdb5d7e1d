// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/SplatNumbers.h"
#include "Core/Base/Vector.h"

#include <array>
#include <cstddef>
#include <limits>

namespace isopoint
{

/// The triangles of one splat polygon.
struct SplatFan
{
  static constexpr std::size_t maxVertices = 1 + maxCorners;

  std::size_t vertexCount = 0; // 0: not drawn
  std::size_t triangleCount = 0;
  float tolerance = 0.0f; // how far shared corners of splats may be apart; 0: none are shared
  std::array<Vector, maxVertices> positions;
  std::array<Vector, maxVertices> normals;                      // of length 1
  std::array<std::array<std::size_t, 3>, maxCorners> triangles; // indices of vertices
};

/// Makes triangles between the first vertex and each two consecutive other vertices.
/// @param isClosed whether to add the triangle of the last and the first other vertex
void makeTriangles(SplatFan& fan, bool isClosed);

/// The normal scaled to length 1; unchanged if its length is 0.
Vector unitNormal(const Vector& normal);

/// The relative error of float or double coordinates, with a margin of one rounding.
constexpr double positionErrorOf(bool areFloat)
{
  return 2.0 * (areFloat ? std::numeric_limits<float>::epsilon()
                         : std::numeric_limits<double>::epsilon());
}

/// The triangles of a splat. Nearly flat splats have no center vertex.
/// @param position finite
/// @param normal from unitNormal()
/// @param axis see Splat
/// @param numbers see numbersOf()
/// @param scale factor on the size
/// @param positionError see positionErrorOf()
/// @returns no vertices if the splat has no area or is not finite
SplatFan fanOf(const Vector& position, const Vector& normal, const Vector& axis,
  const SplatNumbers& numbers, double scale, double positionError);

} // namespace isopoint
