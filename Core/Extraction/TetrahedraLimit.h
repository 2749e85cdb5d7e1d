// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace isopoint
{

constexpr std::size_t fewTetrahedra = 4000000; // permitted in any cloud
constexpr std::size_t tetrahedraForSample = 60;

/// The most tetrahedra of a cloud, which samples on curves exceed: docs/triangles.md. Volumes have
/// 7 for each sample, tilted wells 32, a curve half as many as it has samples.
struct TetrahedraLimit
{
  std::size_t least = fewTetrahedra;
  std::size_t forSample = tetrahedraForSample;

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
