// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Fit/FitFrame.h"

#include "Core/Fit/Selection.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace isopoint
{
namespace
{

/// The largest power of two up to a number.
double unitOf(double size)
{
  return std::ldexp(1.0, std::ilogb(size));
}

/// Whether positions within a distance on each axis are finite.
bool areFiniteWithin(double distance, const Vector& position)
{
  return std::all_of(position.begin(), position.end(),
    [distance](double coordinate) { return std::isfinite(std::abs(coordinate) + distance); });
}

/// Whether divisions by a unit are exact.
bool isNormal(double unit)
{
  return std::isnormal(unit) && std::isnormal(1.0 / unit);
}

} // namespace

void FitFrame::enter(const FitEdge& edge, double isovalue)
{
  this->Samples.clear();
  this->Origin = edge.position;
  this->Isovalue = isovalue;
  const double length = lengthOf(edge.increasing);
  this->IsUsable =
    length > 0.0 && areFiniteWithin(length, edge.position) && std::isfinite(edge.increase);
  if (this->IsUsable)
  {
    this->Length = unitOf(length);
    this->Value = unitOf(edge.increase);
    this->IsUsable = isNormal(this->Length) && isNormal(this->Value);
    this->Samples.valueError = edge.valueError / this->Value;
    this->PerLength = 1.0 / this->Length;
    this->PerValue = 1.0 / this->Value;
    this->Increasing = this->PerLength * edge.increasing;
  }
}

void FitFrame::add(const FitSample* first, const FitSample* last)
{
  const std::size_t former = this->Samples.count();
  const auto count = static_cast<std::size_t>(last - first);
  const std::size_t added = std::min(FrameSamples::most - former, count);
  const std::size_t nearest =
    std::min(FrameSamples::nearest - std::min(FrameSamples::nearest, former), count);
  if (nearest == 0 && added == count)
  {
    std::for_each(first, last, [this](const FitSample& sample) { this->add(sample); });
  }
  else
  {
    this->addNearest(first, count, nearest, added);
  }
}

/// Adds the `nearest` nearest samples in their order, then the next nearest in their order, up to
/// `most` in all. Among equal distances, the first ones count as nearer.
void FitFrame::addNearest(
  const FitSample* samples, std::size_t count, std::size_t nearest, std::size_t most)
{
  this->Distances.resize(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vector place = this->placeOf(samples[i].position);
    this->Distances[i] = dot(place, place);
  }
  NearestChoice isNear = this->choiceOf(nearest);
  NearestChoice isKept = this->choiceOf(most);
  this->Others.clear();
  for (std::size_t i = 0; i < count; ++i)
  {
    const bool isTaken = isKept.takes(this->Distances[i]) && std::isfinite(this->Distances[i]);
    if (isNear.takes(this->Distances[i]))
    {
      if (isTaken)
      {
        this->add(samples[i]);
      }
    }
    else if (isTaken)
    {
      this->Others.push_back(i);
    }
  }
  for (const std::size_t i : this->Others)
  {
    this->add(samples[i]);
  }
}

/// Selects the `count` least distances; the first ones among equals.
FitFrame::NearestChoice FitFrame::choiceOf(std::size_t count)
{
  if (count == 0)
  {
    return { -1.0, 0 };
  }
  if (count == this->Distances.size())
  {
    return { std::numeric_limits<double>::infinity(), count };
  }
  this->Ranked = this->Distances;
  const double limit = selectNth(this->Ranked.data(), this->Ranked.size(), count - 1);
  const auto less = std::count_if(this->Distances.begin(), this->Distances.end(),
    [limit](double distance) { return distance < limit; });
  return { limit, count - static_cast<std::size_t>(less) };
}

Vector FitFrame::positionAt(const Vector& place) const
{
  return this->Origin + this->Length * place;
}

Vector FitFrame::gradientOf(const Vector& gradient) const
{
  return this->Value / this->Length * gradient;
}

Hessian FitFrame::hessianOf(const Hessian& hessian) const
{
  Hessian result = hessian;
  for (double& second : result)
  {
    second *= this->Value / this->Length / this->Length;
  }
  return result;
}

std::vector<CreasePlane> FitFrame::planesOf(std::vector<CreasePlane> planes) const
{
  for (CreasePlane& plane : planes)
  {
    plane.distance *= this->Length;
  }
  return planes;
}

} // namespace isopoint
