// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Places/PlaceKind.h"

#include "Core/Fit/PrincipalAxes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

namespace isopoint
{
namespace
{

/// The nearest positions, relative to a place.
struct Offsets
{
  std::array<Vector, countForKinds> all{};
  std::size_t count = 0;

  const Vector* begin() const { return this->all.data(); }
  const Vector* end() const { return this->all.data() + this->count; }
};

constexpr double flat = 1e-4; // share of variances

/// The axes of flat samples.
std::optional<PrincipalAxes> flatAxes(const Offsets& offsets)
{
  constexpr double beyond = 1.21; // the farthest sample counts, too
  const Vector& last = offsets.all[offsets.count - 1];
  const double perReach = dot(last, last) > 0.0 ? 1.0 / (beyond * dot(last, last)) : 0.0;
  const auto weightOf = [perReach](const Vector& offset)
  {
    const double taper = 1.0 - perReach * dot(offset, offset);
    return taper * taper;
  };
  Vector mean{};
  double total = 0.0;
  for (const Vector& offset : offsets)
  {
    mean += weightOf(offset) * offset;
    total += weightOf(offset);
  }
  mean = 1.0 / total * mean;
  std::array<Vector, 3> covariance{};
  for (const Vector& offset : offsets)
  {
    const Vector difference = offset - mean;
    for (std::size_t row = 0; row < 3; ++row)
    {
      covariance[row] += weightOf(offset) * difference[row] * difference;
    }
  }
  return thinAxes(covariance, flat);
}

/// The distance of the eighth nearest sample from the nearest one, squared.
double squaredSpacing(const Offsets& offsets)
{
  constexpr std::size_t neighbor = 8;
  std::array<double, countForKinds> squared{};
  std::transform(offsets.begin(), offsets.end(), squared.begin(),
    [&](const Vector& offset)
    {
      const Vector apart = offset - offsets.all[0];
      return dot(apart, apart);
    });
  double* const wanted = squared.data() + std::min(neighbor, offsets.count - 1);
  std::nth_element(squared.data(), wanted, squared.data() + offsets.count);
  return *wanted;
}

/// Whether all offsets are on one side of a plane through the place. Searches the point of least
/// length in the convex hull of their directions (Frank and Wolfe), until such a plane is found.
bool areOnOneSide(Offsets offsets)
{
  constexpr int steps = 12;
  constexpr double closest = 1e-6;
  Vector point{};
  for (std::size_t i = 0; i < offsets.count; ++i)
  {
    offsets.all[i] = directionOf(offsets.all[i]);
    point += offsets.all[i];
  }
  point = 1.0 / static_cast<double>(offsets.count) * point;
  for (int step = 0; step < steps; ++step)
  {
    const Vector* least = nullptr;
    double product = std::numeric_limits<double>::infinity();
    for (const Vector& direction : offsets)
    {
      if (dot(point, direction) < product)
      {
        product = dot(point, direction);
        least = &direction;
      }
    }
    if (dot(point, point) <= closest * closest)
    {
      return false;
    }
    if (product > 0.0)
    {
      return true;
    }
    const Vector towards = *least - point;
    const double share = -dot(point, towards) / dot(towards, towards);
    point += std::min(1.0, std::max(0.0, share)) * towards;
  }
  return false;
}

} // namespace

std::uint8_t placeKinds(const std::vector<Vector>& offsets)
{
  constexpr double farthest = 0.9; // spacings
  constexpr double atSample = 1e-3;
  Offsets nearest;
  nearest.count = std::min(offsets.size(), countForKinds);
  const double unit = lengthOf(offsets[nearest.count - 1]);
  std::transform(offsets.data(), offsets.data() + nearest.count, nearest.all.data(),
    [unit](const Vector& offset) { return unit > 0.0 ? 1.0 / unit * offset : offset; });
  const std::optional<PrincipalAxes> axes = flatAxes(nearest);
  const std::uint8_t kind = axes ? PlaceFlat : 0;
  const double squared = dot(nearest.all[0], nearest.all[0]);
  const double spacing = squaredSpacing(nearest);
  if (squared <= atSample * atSample * spacing)
  {
    return kind;
  }
  if (squared > farthest * farthest * spacing)
  {
    return kind | PlaceOutside;
  }
  if (axes) // sides are those within the plane or line
  {
    for (Vector& offset : nearest.all)
    {
      Vector along{};
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        if (axes->shares[axis] > flat)
        {
          along += dot(offset, axes->axes[axis]) * axes->axes[axis];
        }
      }
      offset = along;
    }
    if (!(dot(nearest.all[0], nearest.all[0]) > atSample * atSample * spacing))
    {
      return kind;
    }
  }
  return kind | (areOnOneSide(nearest) ? PlaceOutside : 0);
}

} // namespace isopoint
