// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"

#include <array>
#include <cstdint>
#include <random>

// Vector is an alias of std::array, so lookup by its namespace does not find its operators.
using isopoint::operator+;
using isopoint::operator-;
using isopoint::operator*;
using isopoint::operator+=;

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

  /// A position in the unit cube.
  std::array<double, 3> place() { return { (*this)(), (*this)(), (*this)() }; }

  /// A position in a cube around the origin.
  std::array<double, 3> inCube(double side)
  {
    return { side * ((*this)() - 0.5), side * ((*this)() - 0.5), side * ((*this)() - 0.5) };
  }

private:
  std::mt19937_64 Generator;
};

} // namespace clouds
