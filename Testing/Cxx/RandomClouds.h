// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Clouds.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace clouds
{

/// Random whole numbers below a limit.
class Dice
{
public:
  explicit Dice(std::uint64_t seed)
    : Uniform(seed)
  {
  }

  std::size_t operator()(std::size_t limit)
  {
    return std::min(
      limit - 1, static_cast<std::size_t>(this->Uniform() * static_cast<double>(limit)));
  }
  double real() { return this->Uniform(); }

private:
  Random Uniform;
};

/// Of any kind, with up to some thousands of samples.
inline Cloud randomCloud(Dice& dice, std::uint64_t seed)
{
  const std::size_t count = std::size_t{ 1 } << dice(12);
  const std::size_t some = count + dice(count + 1);
  switch (dice(12))
  {
    case 0:
      return clustered(some, seed);
    case 1:
      return lattice(2 + static_cast<int>(dice(11)), 1 + static_cast<int>(dice(11)),
        1 + static_cast<int>(dice(11)));
    case 2:
      return coarse(some, 2 + static_cast<int>(dice(9)), seed);
    case 3:
      return coincident(uniform(some, seed), dice.real());
    case 4:
      return lines(some / 2 + 1, 1 + dice(8), static_cast<int>(dice(50)), seed);
    case 5:
      return combs(some / 2 + 1, 1 + static_cast<int>(dice(12)), seed);
    case 6:
      return curves(some / 2 + 1, seed);
    case 7:
      return flattened(uniform(some, seed), static_cast<int>(dice(3)));
    case 8:
      return nestedCoincident(some / 4 + 10);
    case 9:
      return layerBeforeOne(some / 4 + 10, seed);
    default:
      return uniform(some, seed);
  }
}

/// A number from the environment, which makes a test run longer than usual.
inline std::uint64_t numberFrom(const char* name, std::uint64_t usual)
{
  const char* const text = std::getenv(name);
  return text ? std::strtoull(text, nullptr, 10) : usual;
}

} // namespace clouds
