// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/TriangleGeometry.h"

#include "Core/Base/Lists.h"
#include "Core/Base/Sorting.h"
#include "Core/Triangles/SurfaceMesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace isopoint
{
namespace
{

/// The normal of a triangle, scaled to avoid overflow and underflow: only its direction matters.
Vector scaledNormal(const Vector& a, const Vector& b, const Vector& c)
{
  const Vector u = b - a;
  const Vector v = c - a;
  double largest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    largest = std::max({ largest, std::abs(u[axis]), std::abs(v[axis]) });
  }
  const int exponent = largest > 0.0 ? std::ilogb(largest) : 0;
  const auto toUnit = [exponent](const Vector& w) -> Vector
  {
    return { std::ldexp(w[0], -exponent), std::ldexp(w[1], -exponent),
      std::ldexp(w[2], -exponent) };
  };
  return cross(toUnit(u), toUnit(v));
}

/// Reverts moves longer than twice the longest edge of the vertex's triangles.
void takeBackFarMoves(const Execution& execution, const std::vector<Vector>& unmoved,
  const std::vector<SurfaceTriangle>& triangles, const OutgoingHalfEdges& outgoing,
  std::vector<LocalFit>& fits)
{
  constexpr double maxReach = 2.0; // in longest edges
  const std::vector<double> longest = tabulated<double>(execution, triangles.size(),
    [&](std::size_t i)
    {
      const auto& [a, b, c] = triangles[i];
      return std::max({ 0.0, lengthOf(unmoved[b] - unmoved[a]), lengthOf(unmoved[c] - unmoved[b]),
        lengthOf(unmoved[a] - unmoved[c]) });
    });
  forEachIndex(execution, fits.size(),
    [&](std::size_t vertex)
    {
      LocalFit& fit = fits[vertex];
      if (!fit.order || fit.order == FitOrder::Crease)
      {
        return;
      }
      const double move = lengthOf(fit.position - unmoved[vertex]);
      double reach = 0.0;
      outgoing.forEachAt(
        vertex, [&](HalfEdge side) { reach = std::max(reach, maxReach * longest[side / 3]); });
      if (move > reach)
      {
        fit.order.reset();
        fit.position = unmoved[vertex];
      }
    });
}

} // namespace

void keepTrianglesUpright(const Execution& execution, const std::vector<Vector>& unmoved,
  const std::vector<SurfaceTriangle>& triangles, std::vector<LocalFit>& fits)
{
  const OutgoingHalfEdges outgoing(execution, triangles, fits.size());
  takeBackFarMoves(execution, unmoved, triangles, outgoing, fits);
  const auto isMoved = [&fits](std::size_t vertex) { return fits[vertex].order.has_value(); };
  const auto fallingAt = [&fits](std::size_t vertex)
  {
    const Vector& gradient = fits[vertex].gradient;
    return lengthOf(gradient) > 0.0 ? -directionOf(gradient) : Vector{}; // none at samples
  };
  const auto isInverted = [&](const SurfaceTriangle& triangle)
  {
    const auto& [a, b, c] = triangle;
    const bool isAtCrease = std::any_of(triangle.begin(), triangle.end(),
      [&fits](std::size_t vertex) { return fits[vertex].order == FitOrder::Crease; });
    if (isAtCrease || (!isMoved(a) && !isMoved(b) && !isMoved(c)))
    {
      return false;
    }
    const auto movedOf = [&](std::size_t vertex)
    { return isMoved(vertex) ? fits[vertex].position : unmoved[vertex]; };
    const Vector before = scaledNormal(unmoved[a], unmoved[b], unmoved[c]);
    const Vector after = scaledNormal(movedOf(a), movedOf(b), movedOf(c));
    const Vector falling = fallingAt(a) + fallingAt(b) + fallingAt(c);
    return dot(before, falling) > 0.0 && !(dot(after, falling) > 0.0);
  };
  // All triangles at first, then the changed ones.
  std::vector<std::size_t> suspects = iota(triangles.size());
  while (!suspects.empty())
  {
    const std::vector<std::size_t> inverted = chosenThat(
      execution, suspects, [&](std::size_t triangle) { return isInverted(triangles[triangle]); });
    execution.progress(1.0);
    suspects.clear();
    forEachInOrder(execution, inverted.size(),
      [&](std::size_t i)
      {
        for (const std::size_t vertex : triangles[inverted[i]])
        {
          if (isMoved(vertex))
          {
            outgoing.forEachAt(vertex, [&](HalfEdge side) { suspects.push_back(side / 3); });
          }
          fits[vertex].order.reset();
          fits[vertex].position = unmoved[vertex];
        }
      });
    suspects = sortedUnique(execution, suspects, triangles.size());
  }
}

} // namespace isopoint
