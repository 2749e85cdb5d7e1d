// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace isopoint
{

/// The largest power of two that divides all coordinates of some positions, unless it is too small
/// to be useful. Differences of such coordinates are integers with few bits, as in lattices and
/// grids of cells, and polynomials in them are exact in double.
class CoordinateUnit
{
public:
  /// @param least smaller units are useless, or NaN for no limit; units below 2^-100 always are
  explicit CoordinateUnit(double least = 0.0)
    : Least(std::max(smallest, least)) // in this order, which ignores a NaN
  {
  }

  void add(const Vector& position)
  {
    for (const double coordinate : position)
    {
      if (this->Unit > 0.0 && !this->divides(coordinate))
      {
        this->Unit = std::min(this->Unit, lowestBitOf(coordinate));
        this->Unit = this->Unit < this->Least ? 0.0 : this->Unit;
      }
    }
  }

  void add(const CoordinateUnit& other) { this->Unit = std::min(this->Unit, other.Unit); }

  /// The unit, or 0 if it is useless. The largest useful unit if all coordinates are 0.
  double value() const { return this->Unit; }

private:
  // Fifth powers of differences neither overflow nor underflow.
  static constexpr double smallest = 0x1p-100;
  static constexpr double largest = 0x1p100;

  bool divides(double coordinate) const
  {
    constexpr double maxUnits = 0x1p62;           // in 64 bits
    const double units = coordinate / this->Unit; // may underflow to 0
    return coordinate == 0.0 || (std::abs(units) >= 1.0 && std::abs(units) < maxUnits &&
                                  static_cast<double>(static_cast<std::int64_t>(units)) == units);
  }

  /// The value of the lowest set bit; 0 if the number is not finite. The number must not be 0.
  static double lowestBitOf(double number)
  {
    if (!std::isfinite(number))
    {
      return 0.0;
    }
    constexpr int digits = std::numeric_limits<double>::digits;
    int exponent = 0;
    const auto mantissa =
      static_cast<std::int64_t>(std::ldexp(std::frexp(number, &exponent), digits));
    return std::ldexp(static_cast<double>(mantissa & -mantissa), exponent - digits);
  }

  double Least;
  double Unit = largest;
};

} // namespace isopoint
