// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "AnalyticSurface.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

/// Fields over the cube [-1, 1]^3 whose isosurfaces are known exactly.
namespace analytic
{

constexpr double pi = 3.14159265358979323846;

/// The distance to the center.
inline Surface sphere()
{
  Surface surface{ "sphere", 0.7 };
  surface.value = [](const Vector& p) { return length(p); };
  surface.gradient = [](const Vector& p) { return 1.0 / length(p) * p; };
  surface.footOf = [](const Vector& p)
  {
    const Vector outwards = directionOf(p);
    return footAt(p, 0.7 * outwards, -outwards);
  };
  return surface;
}

/// The distance to a circle around the z axis.
inline Surface torus()
{
  constexpr double circle = 0.6;
  const auto nearestOnCircle = [](const Vector& p) {
    return circle * directionOf({ p[0], p[1], 0.0 });
  };
  Surface surface{ "torus", 0.25 };
  surface.value = [=](const Vector& p) { return length(p - nearestOnCircle(p)); };
  surface.gradient = [=](const Vector& p) { return directionOf(p - nearestOnCircle(p)); };
  surface.footOf = [=](const Vector& p)
  {
    const Vector center = nearestOnCircle(p);
    const Vector outwards = directionOf(p - center);
    return footAt(p, center + 0.25 * outwards, -outwards);
  };
  return surface;
}

/// One period of the gyroid, saddle-shaped everywhere; it leaves the cube.
inline Surface gyroid()
{
  Surface surface{ "gyroid", 0.0 };
  surface.value = [](const Vector& p)
  {
    return std::sin(pi * p[0]) * std::cos(pi * p[1]) + std::sin(pi * p[1]) * std::cos(pi * p[2]) +
           std::sin(pi * p[2]) * std::cos(pi * p[0]);
  };
  surface.gradient = [](const Vector& p)
  {
    Vector gradient;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double own = pi * p[axis];
      gradient[axis] = pi * (std::cos(own) * std::cos(pi * p[(axis + 1) % 3]) -
                              std::sin(own) * std::sin(pi * p[(axis + 2) % 3]));
    }
    return gradient;
  };
  findFeetByNewton(surface, 1.5);
  return surface;
}

/// The test signal of Marschner and Lobb, "An evaluation of reconstruction filters for volume
/// rendering" (Visualization 1994): ripples around the z axis, up to 9.4 waves a unit; it leaves
/// the cube. The isosurface at 0.5 is the graph of a function of the distance to the axis.
inline Surface marschnerLobb()
{
  constexpr double amplitude = 0.25;
  constexpr double frequency = 6.0;
  const auto ripple = [](double r)
  { return std::cos(2.0 * pi * frequency * std::cos(0.5 * pi * r)); };
  const auto rippleSlope = [](double r)
  {
    return std::sin(2.0 * pi * frequency * std::cos(0.5 * pi * r)) * pi * pi * frequency *
           std::sin(0.5 * pi * r);
  };
  Surface surface{ "Marschner-Lobb", 0.5, 0.04 };
  surface.value = [=](const Vector& p)
  {
    return (1.0 - std::sin(0.5 * pi * p[2]) + amplitude * (1.0 + ripple(std::hypot(p[0], p[1])))) /
           (2.0 * (1.0 + amplitude));
  };
  surface.gradient = [=](const Vector& p)
  {
    const double r = std::hypot(p[0], p[1]);
    const double radial = r > 0.0 ? amplitude * rippleSlope(r) / r : 0.0;
    return 0.5 / (1.0 + amplitude) *
           Vector{ radial * p[0], radial * p[1], -0.5 * pi * std::cos(0.5 * pi * p[2]) };
  };
  const auto height = [=](double r) { return 2.0 / pi * std::asin(amplitude * ripple(r)); };
  surface.footOf = [=](const Vector& p)
  {
    const double own = std::hypot(p[0], p[1]);
    const Vector axis = directionOf({ p[0], p[1], 0.0 });
    const double r = nearestOnGraph(height, own, p[2], 0.002);
    Vector foot = r * axis;
    foot[2] = height(r);
    return footAt(p, foot, -directionOf(surface.gradient(foot)));
  };
  return surface;
}

/// Overlapping Gaussian bells of several widths.
inline Surface gaussianMixture()
{
  struct Bell
  {
    Vector center;
    double width;
    double weight;
  };
  const std::vector<Bell> bells{ { { 0.0, 0.1, 0.0 }, 0.35, 1.0 }, { { 0.4, 0.3, 0.1 }, 0.2, 0.8 },
    { { -0.4, 0.2, 0.3 }, 0.22, 0.9 }, { { 0.1, -0.5, -0.2 }, 0.25, 0.7 },
    { { -0.2, 0.0, -0.45 }, 0.18, 0.9 }, { { 0.35, -0.2, 0.4 }, 0.2, 0.8 } };
  const auto valueOf = [](const Bell& bell, const Vector& d)
  { return bell.weight * std::exp(-0.5 * dot(d, d) / (bell.width * bell.width)); };
  Surface surface{ "Gaussian mixture", 0.5 };
  surface.value = [=](const Vector& p)
  {
    return std::accumulate(bells.begin(), bells.end(), 0.0,
      [&](double total, const Bell& bell) { return total + valueOf(bell, p - bell.center); });
  };
  surface.gradient = [=](const Vector& p)
  {
    return std::accumulate(bells.begin(), bells.end(), Vector{},
      [&](const Vector& total, const Bell& bell)
      {
        const Vector d = p - bell.center;
        return total - valueOf(bell, d) / (bell.width * bell.width) * d;
      });
  };
  findFeetByNewton(surface, 1.0);
  return surface;
}

/// The largest magnitude among three coordinates along rotated axes: a cube that is aligned with no
/// grid. The gradient is discontinuous at its edges.
inline Surface cube()
{
  constexpr double half = 0.5;
  // A rotation by Cayley's formula from the quaternion (6, 1, 2, 3) / sqrt(50).
  static constexpr Vector axes[3] = { { 24.0 / 50.0, -32.0 / 50.0, 30.0 / 50.0 },
    { 40.0 / 50.0, 30.0 / 50.0, 0.0 }, { -18.0 / 50.0, 24.0 / 50.0, 40.0 / 50.0 } };
  const auto along = [](const Vector& p) {
    return Vector{ dot(axes[0], p), dot(axes[1], p), dot(axes[2], p) };
  };
  const auto greatest = [](const Vector& q)
  {
    return static_cast<std::size_t>(
      std::max_element(
        q.begin(), q.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) -
      q.begin());
  };
  Surface surface{ "cube", half };
  surface.value = [=](const Vector& p)
  {
    const Vector q = along(p);
    return std::abs(q[greatest(q)]);
  };
  surface.gradient = [=](const Vector& p)
  {
    const std::size_t i = greatest(along(p));
    return (dot(axes[i], p) < 0.0 ? -1.0 : 1.0) * axes[i];
  };
  surface.footOf = [=](const Vector& p)
  {
    const Vector q = along(p);
    Foot foot{ {}, 0.0, {} };
    for (std::size_t i = 0; i < 3; ++i)
    {
      const double own =
        i == greatest(q) ? std::copysign(half, q[i]) : std::clamp(q[i], -half, half);
      foot.point += own * axes[i];
      if (std::abs(own) == half)
      {
        foot.normals.push_back((own < 0.0 ? 1.0 : -1.0) * axes[i]);
      }
    }
    foot.distance = length(p - foot.point);
    return foot;
  };
  return surface;
}

/// Two concentric spheres, `separation` apart, with a crease of the field between them: the
/// distance to a sphere.
/// @param separation above 0, below 0.6
inline Surface twoSheets(double separation)
{
  constexpr double middle = 0.65;
  const double half = 0.5 * separation;
  Surface surface{ "two sheets", half, separation };
  surface.value = [](const Vector& p) { return std::abs(length(p) - middle); };
  surface.gradient = [](const Vector& p)
  { return (length(p) < middle ? -1.0 : 1.0) * directionOf(p); };
  surface.footOf = [=](const Vector& p)
  {
    const double side = length(p) < middle ? -1.0 : 1.0;
    const Vector outwards = directionOf(p);
    return footAt(p, (middle + side * half) * outwards, -side * outwards);
  };
  return surface;
}

} // namespace analytic
