// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SplatTesting_h
#define SplatTesting_h

#include "Clouds.h"

#include "Core/Splat/SplatGeometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

/// Shared by the tests of splats.
namespace splattesting
{

using isopoint::cross;
using isopoint::difference;
using isopoint::dot;
using isopoint::lengthOf;
using isopoint::Splat;
using isopoint::Vector;

/// Samples that end at the plane x = 0.
struct HalfSpace
{
  double at(const isopoint::ExtentQuery& query) const
  {
    const double along = query.direction[0];
    return along > 0.1 ? std::min(query.enough, -query.place[0] / along) : query.enough;
  }
  const isopoint::WideSample* nearest(const isopoint::ExtentQuery&) const { return nullptr; }
  const isopoint::WideSample* nearestTo(const Vector&, double) const { return nullptr; }
};

/// The isopoints of a surface, one entry each.
struct Points
{
  std::vector<Vector> positions;
  std::vector<Vector> decreasingEdges;
  std::vector<isopoint::LocalFit> fits;
};

/// The corners of a splat, each once: those that repeat the last one are left out.
inline std::vector<isopoint::SplatCorner> cornersOf(const Splat& splat)
{
  const auto areSame = [](const isopoint::SplatCorner& a, const isopoint::SplatCorner& b)
  { return a.along == b.along && a.across == b.across && a.height == b.height; };
  std::size_t count = splat.corners.size();
  while (count > 1 && areSame(splat.corners[count - 1], splat.corners[count - 2]))
  {
    --count;
  }
  return { splat.corners.begin(), splat.corners.begin() + static_cast<std::ptrdiff_t>(count) };
}

/// The offset of a corner from its splat's point.
inline Vector offsetOf(const Splat& splat, const isopoint::SplatCorner& corner)
{
  const Vector across = cross(splat.normal, splat.axis);
  const Vector inPlane =
    isopoint::sum(isopoint::scaled(corner.along, splat.axis), corner.across, across);
  return isopoint::sum(inPlane, corner.height * splat.radius, splat.normal);
}

/// The surface's normal at a corner, of length 1.
inline Vector normalAt(const Splat& splat, const isopoint::SplatCorner& corner)
{
  const Vector along = isopoint::scaled(1.0 / splat.radius, splat.axis);
  const Vector tilted = isopoint::sum(splat.normal, corner.slopeAlong, along);
  return isopoint::directionOf(
    isopoint::sum(tilted, corner.slopeAcross, cross(splat.normal, along)));
}

/// The area of a splat's triangles.
inline double areaOf(const Splat& splat)
{
  const std::vector<isopoint::SplatCorner> corners = cornersOf(splat);
  double area = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    area += 0.5 * lengthOf(cross(offsetOf(splat, corners[i]),
                    offsetOf(splat, corners[(i + 1) % corners.size()])));
  }
  return area;
}

/// Whether a place lies within a splat, seen along its normal.
inline bool isWithin(const Splat& splat, const Vector& offset, double tolerance = 1e-6)
{
  const std::vector<isopoint::SplatCorner> corners = cornersOf(splat);
  const double x = dot(offset, splat.axis) / (splat.radius * splat.radius);
  const double y = dot(offset, cross(splat.normal, splat.axis)) / (splat.radius * splat.radius);
  bool isInside = false; // a triangle of the fan
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const isopoint::SplatCorner& a = corners[i];
    const isopoint::SplatCorner& b = corners[(i + 1) % corners.size()];
    isInside =
      isInside ||
      (a.along * y - a.across * x >= -tolerance && x * b.across - y * b.along >= -tolerance &&
        (b.along - a.along) * (y - a.across) - (b.across - a.across) * (x - a.along) >= -tolerance);
  }
  return isInside;
}

/// Lists the points at the 48 nearest positions or, in two rings, at the 192 nearest.
class NearestAround
{
public:
  explicit NearestAround(const std::vector<Vector>& positions)
    : Positions(positions)
  {
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      this->At[positions[i]].push_back(i);
    }
  }

  bool isAcrossGap(std::size_t, const isopoint::WideSample&, double) const { return false; }

  class Finder
  {
  public:
    explicit Finder(const NearestAround& around)
      : Around(around)
    {
    }

    const std::vector<std::size_t>& find(std::size_t point, int rings)
    {
      std::vector<std::pair<double, const std::vector<std::size_t>*>> near;
      for (const auto& [position, points] : this->Around.At)
      {
        near.emplace_back(lengthOf(difference(position, this->Around.Positions[point])), &points);
      }
      const std::size_t count = std::min<std::size_t>(near.size(), rings > 1 ? 193 : 49);
      std::nth_element(
        near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count) - 1, near.end());
      this->Found.clear();
      for (std::size_t i = 0; i < count; ++i)
      {
        this->Found.insert(this->Found.end(), near[i].second->begin(), near[i].second->end());
      }
      return this->Found;
    }

  private:
    const NearestAround& Around;
    std::vector<std::size_t> Found;
  };

private:
  const std::vector<Vector>& Positions;
  std::map<Vector, std::vector<std::size_t>> At;
};

/// The splats of points, one for each.
template <class TExtents = HalfSpace>
std::vector<Splat> splatsOf(const Points& points, const TExtents* extents = nullptr)
{
  isopoint::AllPoints all(points.positions.size());
  const std::vector<Splat> splats = isopoint::computeSplats(clouds::executionOn(2),
    { points.positions, points.decreasingEdges, points.fits }, NearestAround(points.positions),
    extents, isopoint::SplatOptions(), all);
  EXPECT_EQ(splats.size(), points.positions.size());
  return splats;
}

inline std::vector<Splat> splatsOf(
  const std::vector<Vector>& positions, const std::vector<Vector>& edges)
{
  Points points;
  points.positions = positions;
  points.decreasingEdges = edges;
  return splatsOf(points);
}

/// Random points of the unit sphere, scaled and moved, with oblique edges that decrease outwards.
struct Sphere
{
  std::vector<Vector> positions;
  std::vector<Vector> outwards;
  std::vector<Vector> edges;

  Sphere(std::size_t count, double scale, double offset)
  {
    clouds::Random random(3);
    while (this->positions.size() < count)
    {
      const Vector v{ 2.0 * random() - 1.0, 2.0 * random() - 1.0, 2.0 * random() - 1.0 };
      const double length = std::sqrt(dot(v, v));
      if (length > 0.1 && length < 1.0)
      {
        const Vector n{ v[0] / length, v[1] / length, v[2] / length };
        this->outwards.push_back(n);
        this->positions.push_back(
          { offset + scale * n[0], offset + scale * n[1], offset + scale * n[2] });
        const double oblique = 1.2 * (random() - 0.5);
        this->edges.push_back(
          { scale * 0.1 * (n[0] + oblique), scale * 0.1 * n[1], scale * 0.1 * (n[2] - oblique) });
      }
    }
  }
};

/// A fit with a gradient, among samples of a spacing.
inline isopoint::LocalFit fitAmong(
  double spacing, std::optional<isopoint::FitOrder> order, const Vector& gradient)
{
  isopoint::LocalFit fit{};
  fit.order = order;
  fit.isGradientFitted = true;
  fit.isSmooth = order >= isopoint::FitOrder::Quadratic;
  fit.gradient = gradient;
  fit.spacing = spacing;
  return fit;
}

/// Adds a point with a fit among samples of spacing 1.
inline void addFitted(Points& points, const Vector& position,
  std::optional<isopoint::FitOrder> order, const Vector& gradient)
{
  points.positions.push_back(position);
  points.decreasingEdges.push_back(isopoint::scaled(-1.0, gradient));
  points.fits.push_back(fitAmong(1.0, order, gradient));
}

/// Adds a point on one of two planes that meet at the y axis at a right angle. A fit with a crease
/// has the other one.
/// @param along coordinate along the axis
/// @param off coordinate across it, at most 0
/// @param tilt added to the fit's gradient
inline void addOnWedge(
  Points& points, bool top, double along, double off, isopoint::FitOrder order, const Vector& tilt)
{
  addFitted(points, top ? Vector{ off, along, 0.0 } : Vector{ 0.0, along, off }, order,
    isopoint::sum(top ? Vector{ 0.0, 0.0, -1.0 } : Vector{ -1.0, 0.0, 0.0 }, 1.0, tilt));
  if (order == isopoint::FitOrder::Crease)
  {
    points.fits.back().creases = { { top ? Vector{ -1.0, 0.0, 0.0 } : Vector{ 0.0, 0.0, -1.0 },
      -off, -1.0 } };
  }
}

/// Negates the field.
inline void negate(Points& points)
{
  for (std::size_t i = 0; i < points.positions.size(); ++i)
  {
    points.fits[i].gradient = isopoint::scaled(-1.0, points.fits[i].gradient);
    points.decreasingEdges[i] = isopoint::scaled(-1.0, points.decreasingEdges[i]);
    for (isopoint::CreasePlane& crease : points.fits[i].creases)
    {
      crease.turn = -crease.turn;
    }
  }
}

} // namespace splattesting

#endif
