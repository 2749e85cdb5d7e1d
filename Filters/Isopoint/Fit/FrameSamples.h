// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_FrameSamples_h
#define isopoint_FrameSamples_h

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace isopoint
{

/// Numbers of four samples side by side. Operations are by element, and sums over samples are those
/// of each element and then sumOf(): results do not depend on how wide the processor's vectors are.
using Lanes = Eigen::Array<double, 4, 1>;
constexpr std::size_t laneCount = 4;

inline double sumOf(const Lanes& lanes)
{
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

/// The largest number of samples that a fit takes: the nearest ones.
constexpr std::size_t mostFitSamples = 96;

/// Samples in the frame of a fit: offsets from the isopoint on its edge, and differences of their
/// values from the isovalue, of a size near 1.
struct FrameSamples
{
  static constexpr std::size_t mostGroups = mostFitSamples / laneCount;
  using Numbers = std::array<Lanes, mostGroups>;

  std::size_t count = 0;
  Numbers x; // only the first groupCount() are set
  Numbers y;
  Numbers z;
  Numbers value;
  Numbers squaredDistance;

  /// Behind the last sample the last group is filled with zeros, whose weights have to be 0.
  std::size_t groupCount() const { return (this->count + laneCount - 1) / laneCount; }

  static double& at(Numbers& numbers, std::size_t sample)
  {
    return numbers[sample / laneCount][static_cast<Eigen::Index>(sample % laneCount)];
  }
  static double at(const Numbers& numbers, std::size_t sample)
  {
    return numbers[sample / laneCount][static_cast<Eigen::Index>(sample % laneCount)];
  }
};

/// One weight for each sample.
using FrameWeights = FrameSamples::Numbers;

} // namespace isopoint

#endif
