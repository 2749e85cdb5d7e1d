// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Fit/FitFrame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace isopoint
{
namespace
{

/// The power of two next below a number.
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

/// Whether units can be divided by.
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
    this->Increasing = scaled(1.0 / this->Length, edge.increasing);
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
    this->Distances.clear();
    for (const FitSample* sample = first; sample != last; ++sample)
    {
      const Vector place = this->placeOf(sample->position);
      this->Distances.push_back(dot(place, place));
    }
    this->addNearest(first, nearest);
    this->addNearest(first, added - nearest);
  }
  this->MeanDistance = this->Samples.sum([this](std::size_t group)
                         { return Lanes(this->Samples.squaredDistance[group].sqrt()); }) /
                       static_cast<double>(this->Samples.count());
}

/// Adds the nearest ones of the samples that are left, and marks these as taken.
void FitFrame::addNearest(const FitSample* samples, std::size_t count)
{
  constexpr double taken = std::numeric_limits<double>::infinity();
  double limit = taken;
  std::size_t equal = 0; // how many at that distance are to be added
  if (count < this->Distances.size() && count > 0)
  {
    this->Sorted = this->Distances;
    const auto last = this->Sorted.begin() + static_cast<std::ptrdiff_t>(count) - 1;
    std::nth_element(this->Sorted.begin(), last, this->Sorted.end());
    limit = *last;
    equal = count - static_cast<std::size_t>(std::count_if(
                      this->Sorted.begin(), last, [&](double d) { return d < limit; }));
  }
  for (std::size_t i = 0; i < this->Distances.size() && count > 0; ++i)
  {
    double& distance = this->Distances[i];
    if (distance < limit || (distance == limit && distance < taken && equal > 0))
    {
      equal -= distance == limit ? 1 : 0;
      this->add(samples[i]);
      distance = taken;
      --count;
    }
  }
}

Vector FitFrame::positionAt(const Vector& place) const
{
  return sum(this->Origin, this->Length, place);
}

Vector FitFrame::gradientOf(const Vector& gradient) const
{
  return scaled(this->Value / this->Length, gradient);
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
