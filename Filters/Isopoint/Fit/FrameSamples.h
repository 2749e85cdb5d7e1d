// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_FrameSamples_h
#define isopoint_FrameSamples_h

#include "Isopoint/Base/Vector.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>

namespace isopoint
{

/// Numbers of four samples side by side. A sum over samples is that of each lane and then sumOf():
/// it does not depend on how wide the processor's vectors are.
constexpr std::size_t laneCount = 4;
using Lanes = Eigen::Array<double, laneCount, 1>;

inline double sumOf(const Lanes& lanes)
{
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

/// Samples in the frame of a fit: offsets from an origin and values of a size near 1. The nearest
/// ones come first. Behind the last sample, its group of four is filled with zeros of weight 0, and
/// so are the groups of the nearest ones if there are fewer.
class FrameSamples
{
public:
  static constexpr std::size_t most = 256;
  static constexpr std::size_t nearest = 16;           // that come first
  using Numbers = std::array<Lanes, most / laneCount>; // the first groupCount() are set

  Numbers x;
  Numbers y;
  Numbers z;
  Numbers value;
  Numbers squaredDistance; // from the origin

  double valueError = 0.0; // standard error that each value has at least

  std::size_t count() const { return this->Count; }
  std::size_t groupCount() const
  {
    return (std::max(this->Count, nearest) + laneCount - 1) / laneCount;
  }

  FrameSamples() { this->clear(); }

  void clear()
  {
    this->Count = 0;
    for (std::size_t group = 0; group < nearest / laneCount; ++group)
    {
      this->clearGroup(group);
    }
  }

  /// Up to `most` samples can be added.
  void add(const Vector& offset, double sampleValue)
  {
    if (this->Count % laneCount == 0)
    {
      this->clearGroup(this->Count / laneCount);
    }
    at(this->x, this->Count) = offset[0];
    at(this->y, this->Count) = offset[1];
    at(this->z, this->Count) = offset[2];
    at(this->value, this->Count) = sampleValue;
    at(this->squaredDistance, this->Count) = dot(offset, offset);
    ++this->Count;
  }

  static double& at(Numbers& numbers, std::size_t sample)
  {
    return numbers[sample / laneCount][static_cast<Eigen::Index>(sample % laneCount)];
  }
  static double at(const Numbers& numbers, std::size_t sample)
  {
    return numbers[sample / laneCount][static_cast<Eigen::Index>(sample % laneCount)];
  }

  /// Calls use(group) for each group of four samples.
  template <class Use>
  void forEachGroup(const Use& use) const
  {
    const std::size_t groups = this->groupCount();
    for (std::size_t group = 0; group < groups; ++group)
    {
      use(group);
    }
  }

  /// The sum of term(group) over all samples.
  template <class Term>
  double sum(const Term& term) const
  {
    Lanes total = Lanes::Zero();
    this->forEachGroup([&](std::size_t group) { total += term(group); });
    return sumOf(total);
  }

private:
  void clearGroup(std::size_t group)
  {
    for (Numbers* const numbers :
      { &this->x, &this->y, &this->z, &this->value, &this->squaredDistance })
    {
      (*numbers)[group] = Lanes::Zero();
    }
  }

  std::size_t Count = 0;
};

/// One weight for each sample.
using FrameWeights = FrameSamples::Numbers;

/// The numbers of the nearest samples side by side.
using NearestNumbers = Eigen::Array<double, FrameSamples::nearest, 1>;

inline NearestNumbers nearestOf(const FrameSamples::Numbers& numbers)
{
  NearestNumbers result;
  for (std::size_t i = 0; i < FrameSamples::nearest / laneCount; ++i)
  {
    result.segment<laneCount>(static_cast<Eigen::Index>(laneCount * i)) = numbers[i];
  }
  return result;
}

inline double sumOfSquares(const NearestNumbers& numbers)
{
  Lanes total = Lanes::Zero();
  for (std::size_t i = 0; i < FrameSamples::nearest / laneCount; ++i)
  {
    total += numbers.segment<laneCount>(static_cast<Eigen::Index>(laneCount * i)).square();
  }
  return sumOf(total);
}

/// Sets the weights of the places behind the last sample to 0.
inline void endWeights(const FrameSamples& samples, FrameWeights& weights)
{
  for (std::size_t i = samples.count(); i < laneCount * samples.groupCount(); ++i)
  {
    FrameSamples::at(weights, i) = 0.0;
  }
}

/// Weights (offset + (d / s)^2)^-power, d being a sample's distance from the origin, s the mean of
/// these.
template <int Power>
void weigh(const FrameSamples& samples, double meanDistance, double offset, FrameWeights& weights)
{
  const double scale = 1.0 / (meanDistance * meanDistance);
  samples.forEachGroup(
    [&](std::size_t group)
    {
      const Lanes base = offset + scale * samples.squaredDistance[group];
      weights[group] = 1.0 / (Power == 1 ? base : Lanes(base * base * base));
    });
  endWeights(samples, weights);
}

} // namespace isopoint

#endif
