// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatFan_h
#define isopoint_SplatFan_h

#include "Core/Base/SplatNumbers.h"
#include "Core/Base/Vector.h"

#include <array>
#include <cstddef>
#include <limits>

namespace isopoint
{

/// The triangles of one splat.
struct SplatFan
{
  static constexpr std::size_t mostVertices = 1 + mostCorners;

  std::size_t vertexCount = 0; // 0: nothing is drawn
  std::size_t triangleCount = 0;
  float tolerance = 0.0f; // how far corners that are shared with other splats may be apart; 0: none
  std::array<Vector, mostVertices> positions;
  std::array<Vector, mostVertices> normals;                      // of length 1
  std::array<std::array<std::size_t, 3>, mostCorners> triangles; // vertices of each
};

/// Makes triangles between the first vertex and each two consecutive others.
/// @param isClosed whether the last other vertex and the first one are consecutive, too
void makeTriangles(SplatFan& fan, bool isClosed);

/// The normal at length 1; one without a length as it is.
Vector unitNormal(const Vector& normal);

/// The relative error of coordinates in float or double, with one rounding to spare.
constexpr double positionErrorOf(bool areFloat)
{
  return 2.0 * (areFloat ? std::numeric_limits<float>::epsilon()
                         : std::numeric_limits<double>::epsilon());
}

/// The fan of a splat. Its vertices are the point and the corners, or, if the splat is nearly flat,
/// the corners alone.
/// @param position finite
/// @param normal as unitNormal() returns it
/// @param axis see Splat
/// @param numbers see numbersOf()
/// @param scale factor on the size
/// @param positionError see positionErrorOf()
/// @returns a fan without vertices if the splat has no area or is not finite
SplatFan fanOf(const Vector& position, const Vector& normal, const Vector& axis,
  const SplatNumbers& numbers, double scale, double positionError);

} // namespace isopoint

#endif
