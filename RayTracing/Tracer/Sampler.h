// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace raytracing
{

inline std::uint32_t hashOf(std::uint32_t value)
{
  value ^= value >> 16;
  value *= 0x7feb352du;
  value ^= value >> 15;
  value *= 0x846ca68bu;
  value ^= value >> 16;
  return value;
}

inline std::uint32_t hashOf(std::uint32_t a, std::uint32_t b)
{
  return hashOf(a ^ hashOf(b + 0x9e3779b9u));
}

/// Two numbers in [0, 1).
struct Pair
{
  float first;
  float second;
};

/// The random numbers of one sample of one pixel. They depend only on pixel, sample and dimension,
/// so pictures do not depend on threads. A dimension stands for one decision along a path. In each,
/// a pixel's samples are a shuffled lattice with a random shift, which covers the unit square
/// evenly.
class Sampler
{
public:
  /// @param count samples per pixel, 1 or more
  Sampler(std::uint32_t pixel, std::uint32_t sample, std::uint32_t count)
    : Pixel(hashOf(pixel))
    , Sample(sample)
    , Count(count)
  {
  }

  Pair pair(std::uint32_t dimension) const
  {
    const std::uint32_t seed = hashOf(this->Pixel, dimension);
    const std::uint32_t place = this->shuffled(seed);
    constexpr std::uint32_t goldenRatio = 2654435769u; // times 2^32
    const auto step = static_cast<std::uint32_t>((std::uint64_t{ 1 } << 32) / this->Count);
    return { unit(place * step + hashOf(seed, 1)), unit(place * goldenRatio + hashOf(seed, 2)) };
  }

private:
  static float unit(std::uint32_t value)
  {
    return static_cast<float>(value >> 8) * (1.0f / 16777216.0f);
  }

  /// The index of this sample in a random permutation: a bijection of the next power of two,
  /// repeated until the result is below the count.
  std::uint32_t shuffled(std::uint32_t seed) const
  {
    std::uint32_t mask = this->Count - 1;
    for (int shift = 1; shift <= 16; shift *= 2)
    {
      mask |= mask >> shift;
    }
    std::uint32_t place = this->Sample % this->Count;
    do
    {
      for (std::uint32_t round = 0; round < 3; ++round)
      {
        place =
          (place + (hashOf(seed, 3 + round) | 1u)) * (2u * hashOf(seed, 6 + round) + 1u) & mask;
        place ^= (place & mask) >> 3;
        place ^= (place & mask) >> 1;
      }
    } while (place >= this->Count);
    return place;
  }

  std::uint32_t Pixel;
  std::uint32_t Sample;
  std::uint32_t Count;
};

} // namespace raytracing
