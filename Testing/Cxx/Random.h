// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef Random_h
#define Random_h

#include <cstdint>
#include <random>

namespace clouds
{

/// Uniform numbers in [0, 1), the same on every platform.
class Random
{
public:
  explicit Random(std::uint64_t seed)
    : Generator(seed)
  {
  }

  double operator()() { return static_cast<double>(this->Generator() >> 11) * 0x1p-53; }

private:
  std::mt19937_64 Generator;
};

} // namespace clouds

#endif
