// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/SplatMesh/SplatFan.h"

#include <algorithm>
#include <cmath>

namespace isopoint
{

void makeTriangles(SplatFan& fan, bool isClosed)
{
  const std::size_t others = fan.vertexCount - 1;
  fan.triangleCount = isClosed ? others : others - 1;
  for (std::size_t i = 0; i < fan.triangleCount; ++i)
  {
    fan.triangles[i] = { 0, 1 + i, 1 + (i + 1) % others };
  }
}

Vector unitNormal(const Vector& normal)
{
  const double length = std::sqrt(dot(normal, normal));
  return length == 0.0 ? normal : 1.0 / length * normal;
}

SplatFan fanOf(const Vector& position, const Vector& normal, const Vector& axis,
  const SplatNumbers& numbers, double scale, double positionError)
{
  const Vector across = cross(normal, axis);
  const double radius = std::sqrt(dot(axis, axis));
  if (!(radius > 0.0) || !std::isfinite(radius))
  {
    return {};
  }
  double steepest = 0.0;
  SplatFan fan;
  fan.positions[0] = { 0.0, 0.0, 0.0 }; // offsets at first
  fan.normals[0] = normal;
  fan.vertexCount = 1;
  for (std::size_t i = 0; i < maxCorners; ++i)
  {
    const double* const corner = numbers.data() + numbersOfCorner * i; // see SplatCorner
    const std::size_t next = fan.vertexCount;
    const Vector offset = corner[0] * scale * axis + corner[1] * scale * across +
                          corner[2] * scale * scale * radius * normal;
    if (!isFinite(offset))
    {
      return {};
    }
    if (next > 1 && offset == fan.positions[next - 1])
    {
      continue; // unused corners repeat the last one
    }
    const double slope = std::sqrt(corner[3] * corner[3] + corner[4] * corner[4]);
    steepest = std::max({ steepest, slope, std::abs(corner[2]) });
    fan.positions[next] = offset;
    fan.normals[next] =
      unitNormal(normal + scale * corner[3] / radius * axis + scale * corner[4] / radius * across);
    ++fan.vertexCount;
  }
  if (fan.vertexCount < 4)
  {
    return {};
  }
  // The surface around the point is flat to a hundredth of the splat's size. Without a center
  // vertex it looks the same, with a third fewer triangles.
  constexpr double slightSlope = 0.03;
  const bool isFlat = scale * steepest < slightSlope;
  if (isFlat)
  {
    std::copy(fan.positions.begin() + 1, fan.positions.end(), fan.positions.begin());
    std::copy(fan.normals.begin() + 1, fan.normals.end(), fan.normals.begin());
    --fan.vertexCount;
  }
  makeTriangles(fan, !isFlat);
  for (std::size_t i = 0; i < fan.vertexCount; ++i)
  {
    fan.positions[i] = position + fan.positions[i];
  }
  // Corners are sums of a few float numbers.
  fan.tolerance = static_cast<float>(16.0 * std::numeric_limits<float>::epsilon() * radius);
  const double largest =
    std::max({ std::abs(position[0]), std::abs(position[1]), std::abs(position[2]) });
  fan.tolerance += static_cast<float>(positionError * largest);
  return fan;
}

} // namespace isopoint
