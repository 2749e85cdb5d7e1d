// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"
#include "Core/Fit/Lanes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace isopoint
{

/// One number per sample of a fit, in groups of four.
class SampleNumbers
{
public:
  static constexpr std::size_t most = 256;

  double& operator[](std::size_t sample) { return this->Numbers[sample]; }
  double operator[](std::size_t sample) const { return this->Numbers[sample]; }

  Lanes group(std::size_t i) const { return Lanes::Map(this->Numbers.data() + laneCount * i); }
  void setGroup(std::size_t i, const Lanes& lanes)
  {
    Lanes::Map(this->Numbers.data() + laneCount * i) = lanes;
  }

  /// The first `Count` numbers.
  template <std::size_t Count>
  Pack<Count> first() const
  {
    return Pack<Count>::Map(this->Numbers.data());
  }

private:
  // Padding: processors stall a read if its address modulo 4096 equals that of a recent write, so a
  // sample's numbers in two arrays must not be a multiple of 4096 bytes apart.
  static constexpr std::size_t unused = 24;

  alignas(16) std::array<double, most + unused> Numbers;
};

/// Samples in the frame of a fit: offsets from the origin, and values of a size near 1; the nearest
/// ones first. The groups of the nearest and of the last samples are padded with zeros of weight 0.
class FrameSamples
{
public:
  static constexpr std::size_t most = SampleNumbers::most;
  static constexpr std::size_t nearest = 16; // number of samples that come first

  // The first groupCount() groups are valid.
  SampleNumbers x;
  SampleNumbers y;
  SampleNumbers z;
  SampleNumbers value;
  SampleNumbers squaredDistance; // from the origin

  double valueError = 0.0; // least standard error of each value

  std::size_t count() const { return this->Count; }
  std::size_t groupCount() const
  {
    return (std::max(this->count(), nearest) + laneCount - 1) / laneCount;
  }

  /// The mean distance of the samples from the origin.
  double meanDistance() const
  {
    return sumOf(this->DistanceSums) / static_cast<double>(this->Count);
  }

  FrameSamples() { this->clear(); }

  void clear()
  {
    this->Count = 0;
    this->DistanceSums.setZero();
    for (std::size_t group = 0; group < nearest / laneCount; ++group)
    {
      this->clearGroup(group);
    }
  }

  /// Adds a sample; `most` is the limit.
  void add(const Vector& offset, double sampleValue)
  {
    if (this->Count % laneCount == 0)
    {
      this->clearGroup(this->Count / laneCount);
    }
    this->x[this->Count] = offset[0];
    this->y[this->Count] = offset[1];
    this->z[this->Count] = offset[2];
    this->value[this->Count] = sampleValue;
    const double squared = dot(offset, offset);
    this->squaredDistance[this->Count] = squared;
    this->DistanceSums[static_cast<Eigen::Index>(this->Count % laneCount)] += std::sqrt(squared);
    ++this->Count;
  }

private:
  void clearGroup(std::size_t group)
  {
    for (SampleNumbers* const numbers :
      { &this->x, &this->y, &this->z, &this->value, &this->squaredDistance })
    {
      numbers->setGroup(group, Lanes::Zero());
    }
  }

  std::uint32_t Count = 0; // not wider: the compiler knows that groupCount() is in range
  Lanes DistanceSums;      // from the origin
};

using FrameWeights = SampleNumbers;

inline void copyWeights(const FrameSamples& samples, const FrameWeights& from, FrameWeights& to)
{
  const std::size_t groups = samples.groupCount();
  for (std::size_t group = 0; group < groups; ++group)
  {
    to.setGroup(group, from.group(group));
  }
}

/// Sets the weights of the padding to 0.
inline void endWeights(const FrameSamples& samples, FrameWeights& weights)
{
  for (std::size_t i = samples.count(); i < laneCount * samples.groupCount(); ++i)
  {
    weights[i] = 0.0;
  }
}

/// Weights (offset + (d / s)^2)^-Power for a sample's distance d from the origin, of mean s.
template <int Power>
void weigh(const FrameSamples& samples, double offset, FrameWeights& weights)
{
  const double meanDistance = samples.meanDistance();
  const double scale = 1.0 / (meanDistance * meanDistance);
  const std::size_t groups = samples.groupCount();
  for (std::size_t group = 0; group < groups; ++group)
  {
    const Lanes base = offset + scale * samples.squaredDistance.group(group);
    weights.setGroup(group, 1.0 / (Power == 1 ? base : Lanes(base * base * base)));
  }
  endWeights(samples, weights);
}

} // namespace isopoint
