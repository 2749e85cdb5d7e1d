// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Fit/FitFrame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace isopoint
{
namespace
{

/// The power of two next below a number.
double unitOf(double size)
{
  return std::ldexp(1.0, std::ilogb(size));
}

/// Whether units can be divided by.
bool isNormal(double unit)
{
  return std::isnormal(unit) && std::isnormal(1.0 / unit);
}

} // namespace

void FitFrame::enter(const FitEdge& edge, double isovalue, const std::vector<FitSample>& samples)
{
  this->Origin = edge.position;
  this->Isovalue = isovalue;
  const double length = lengthOf(edge.increasing);
  this->IsUsable = std::isfinite(length) && length > 0.0 && std::isfinite(edge.increase);
  if (!this->IsUsable)
  {
    return;
  }
  this->Length = unitOf(length);
  this->Value = unitOf(edge.increase);
  this->IsUsable = isNormal(this->Length) && isNormal(this->Value);
  if (!this->IsUsable)
  {
    return;
  }
  this->Increasing = scaled(1.0 / this->Length, edge.increasing);
  this->Samples.clear();
  if (samples.size() <= FrameSamples::most)
  {
    for (const FitSample& sample : samples)
    {
      this->Samples.add(this->placeOf(sample.position), this->valueOf(sample.value));
    }
  }
  else
  {
    this->addNearest(samples);
  }
  this->MeanDistance =
    this->Samples.sum([this](std::size_t i) { return Lanes(this->Samples.squaredDistance[i].sqrt()); }) /
    static_cast<double>(this->Samples.count());
}

/// Ties are decided by the samples' order.
void FitFrame::addNearest(const std::vector<FitSample>& samples)
{
  const auto squaredDistanceOf = [this](const FitSample& sample)
  {
    const Vector place = this->placeOf(sample.position);
    return dot(place, place);
  };
  this->Distances.clear();
  for (const FitSample& sample : samples)
  {
    this->Distances.push_back(squaredDistanceOf(sample));
  }
  const auto last = this->Distances.begin() + FrameSamples::most - 1;
  std::nth_element(this->Distances.begin(), last, this->Distances.end());
  const double limit = *last;
  std::size_t equal = FrameSamples::most - static_cast<std::size_t>(std::count_if(
    this->Distances.begin(), last, [&](double d) { return d < limit; }));
  for (const FitSample& sample : samples)
  {
    const double distance = squaredDistanceOf(sample);
    if (distance < limit || (distance == limit && equal > 0))
    {
      equal -= distance == limit ? 1 : 0;
      this->Samples.add(this->placeOf(sample.position), this->valueOf(sample.value));
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
