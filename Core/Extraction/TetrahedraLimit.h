// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace isopoint
{

/// The most tetrahedra of a cloud, which samples on curves exceed: docs/triangles.md. Volumes have
/// 7 for each sample, tilted wells 32, a curve half as many as it has samples.
struct TetrahedraLimit
{
  std::size_t least = 4000000; // of any cloud
  std::size_t forSample = 60;

  std::size_t of(std::size_t sampleCount) const
  {
    return std::max(this->least, this->forSample * sampleCount);
  }
};

/// Thrown on all ranks if samples have more tetrahedra. what() gives the numbers.
struct TooManyTetrahedra : std::runtime_error
{
  TooManyTetrahedra(std::size_t sampleCount, std::size_t most)
    : std::runtime_error(
        "more than " + std::to_string(most) + " for " + std::to_string(sampleCount) + " samples")
  {
  }
};

} // namespace isopoint
