// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Random.h"

#include "Core/Base/Vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace analytic
{

using isopoint::cross;
using isopoint::directionOf;
using isopoint::dot;
using isopoint::Vector;

inline double length(const Vector& a)
{
  return isopoint::lengthOf(a);
}

/// Where a surface is closest to a position.
struct Foot
{
  Vector point;
  double distance;
  std::vector<Vector> normals; // of length 1, to decreasing values; several at an edge or corner
};

inline Foot footAt(const Vector& position, const Vector& foot, const Vector& normal)
{
  return { foot, length(position - foot), { normal } };
}

/// A field over the cube [-1, 1]^3 and its isosurface.
struct Surface
{
  std::string name;
  double isovalue = 0.0;
  double thickness = 0.2; // of the thinnest sheet or ripple: searches take shorter steps
  std::function<double(const Vector&)> value{};
  std::function<Vector(const Vector&)> gradient{};
  std::function<Foot(const Vector&)> footOf{}; // may be called from any thread
};

/// Random points of an isosurface within a cube around the origin, uniform by area: where random
/// lines, uniform among those that meet the ball around the cube, cross it (Cauchy and Crofton).
/// Two crossings of a line that are closer than an eighth of the thickness may be missed.
/// @param halfSide of the cube
inline std::vector<Vector> randomSurfacePoints(
  const Surface& surface, std::size_t count, double halfSide, std::uint64_t seed)
{
  clouds::Random random(seed);
  const auto inBall = [&random]()
  {
    Vector p = random.inCube(2.0);
    while (!(dot(p, p) <= 1.0 && dot(p, p) > 1e-4))
    {
      p = random.inCube(2.0);
    }
    return p;
  };
  const double radius = halfSide * std::sqrt(3.0);
  const double step = surface.thickness / 8.0;
  const auto inCube = [halfSide](const Vector& p) {
    return std::max({ std::abs(p[0]), std::abs(p[1]), std::abs(p[2]) }) <= halfSide;
  };
  std::vector<Vector> points;
  while (points.size() < count)
  {
    const Vector direction = directionOf(inBall());
    // The foot of the line: uniform in the disk across it.
    Vector side = inBall();
    side = directionOf(side - dot(side, direction) * direction);
    const Vector foot = radius * std::sqrt(random()) * side;
    const auto at = [&](double t) { return foot + t * direction; };
    const auto isBelow = [&](double t) { return surface.value(at(t)) < surface.isovalue; };
    const double half = std::sqrt(std::max(0.0, radius * radius - dot(foot, foot)));
    bool before = isBelow(-half);
    for (double t = -half; t < half && points.size() < count; t += step)
    {
      const bool after = isBelow(t + step);
      if (before != after)
      {
        double lower = t;
        double upper = t + step;
        for (int halving = 0; halving < 60; ++halving)
        {
          const double middle = 0.5 * (lower + upper);
          (isBelow(middle) == before ? lower : upper) = middle;
        }
        if (inCube(at(lower)))
        {
          points.push_back(at(lower));
        }
      }
      before = after;
    }
  }
  return points;
}

/// The nearest point of the graph z = height(s), s being the distance to an axis, to a position at
/// the distance `r` from the axis and the height `z`.
/// @returns s there, 0 or more
/// @param resolution step of the first search, well below the shortest wavelength
template <class Height>
double nearestOnGraph(const Height& height, double r, double z, double resolution)
{
  const auto distance = [&](double s) { return std::hypot(s - r, height(s) - z); };
  // The foot is no farther than the graph at the position's own r.
  const double reach = distance(r) + resolution;
  double best = r;
  for (double s = std::max(0.0, r - reach); s <= r + reach; s += resolution)
  {
    best = distance(s) < distance(best) ? s : best;
  }
  constexpr double golden = 0.6180339887498949;
  double lower = std::max(0.0, best - resolution);
  double upper = best + resolution;
  while (upper - lower > 1e-9)
  {
    const double a = upper - golden * (upper - lower);
    const double b = lower + golden * (upper - lower);
    (distance(a) < distance(b) ? upper : lower) = distance(a) < distance(b) ? b : a;
  }
  return 0.5 * (lower + upper);
}

/// The point of the surface to which Newton's method converges from a start, in short steps.
inline Vector nearSurface(const Surface& surface, Vector p)
{
  constexpr double longest = 0.1;
  for (int step = 0; step < 50; ++step)
  {
    const Vector gradient = surface.gradient(p);
    const double difference = surface.isovalue - surface.value(p);
    const Vector move = difference / std::max(dot(gradient, gradient), 1e-12) * gradient;
    const double size = length(move);
    p = p + (size > longest ? longest / size * move : move);
    if (size < 1e-14)
    {
      break;
    }
  }
  return p;
}

/// Gradient descent of the distance to the position along the surface, from where Newton's method
/// meets the surface, with the step lengths of Barzilai and Borwein.
inline Foot descendToFoot(const Surface& surface, const Vector& position, const Vector& start)
{
  const auto alongSurface = [&](const Vector& foot)
  {
    const Vector normal = directionOf(surface.gradient(foot));
    const Vector towards = position - foot;
    return towards - dot(towards, normal) * normal;
  };
  constexpr double longest = 0.1;
  Vector foot = nearSurface(surface, start);
  Vector along = alongSurface(foot);
  Vector best = foot;
  double stride = 0.5;
  for (int step = 0; step < 200 && length(along) > 1e-13; ++step)
  {
    const Vector before = foot;
    const Vector alongBefore = along;
    const double size = stride * length(along);
    foot = nearSurface(surface, foot + (size > longest ? stride * longest / size : stride) * along);
    along = alongSurface(foot);
    if (length(position - foot) < length(position - best))
    {
      best = foot;
    }
    const Vector moved = foot - before;
    const double bend = dot(moved, alongBefore - along);
    stride = bend > 0.0 ? std::clamp(dot(moved, moved) / bend, 1e-3, 16.0) : 1.0;
  }
  return footAt(position, best, -directionOf(surface.gradient(best)));
}

/// Sets footOf of a smooth surface to the nearest foot that descents find: one from the position
/// itself and, where that ends far away, others from the nearest of random surface points.
/// @param halfSide of the cube within which the random points lie
inline void findFeetByNewton(Surface& surface, double halfSide)
{
  constexpr double near = 0.05;
  constexpr std::size_t startCount = 6000;
  constexpr std::size_t descents = 4;
  const Surface plain = surface;
  const auto starts = std::make_shared<const std::vector<Vector>>(
    randomSurfacePoints(plain, startCount, halfSide, 7));
  surface.footOf = [plain, starts](const Vector& p)
  {
    Foot best = descendToFoot(plain, p, p);
    if (best.distance <= near)
    {
      return best;
    }
    std::vector<std::pair<double, std::size_t>> byDistance;
    for (std::size_t i = 0; i < starts->size(); ++i)
    {
      byDistance.emplace_back(length(p - (*starts)[i]), i);
    }
    std::partial_sort(byDistance.begin(), byDistance.begin() + descents, byDistance.end());
    for (std::size_t i = 0; i < descents; ++i)
    {
      const Foot other = descendToFoot(plain, p, (*starts)[byDistance[i].second]);
      best = other.distance < best.distance ? other : best;
    }
    return best;
  };
}

} // namespace analytic
