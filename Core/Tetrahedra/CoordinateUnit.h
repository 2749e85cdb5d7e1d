// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_CoordinateUnit_h
#define isopoint_CoordinateUnit_h

#include "Core/Base/Vector.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace isopoint
{

/// The largest power of two that all coordinates of some positions are multiples of, unless it is
/// too small to be of use. Differences of such coordinates are integers of few bits, as in
/// lattices and grids of cells: polynomials of these are exact in double.
class CoordinateUnit
{
public:
  /// @param least units below that are of no use, nor are those below 2^-100; NaN: these alone
  explicit CoordinateUnit(double least = 0.0)
    : Least(std::max(smallest, least)) // in this order, which ignores a NaN
  {
  }

  /// O(1)
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

  /// The unit, or 0 if it is of no use. Without positions other than 0 it is the largest of use.
  double value() const { return this->Unit; }

private:
  // Fifth powers of differences neither overflow nor underflow.
  static constexpr double smallest = 0x1p-100;
  static constexpr double largest = 0x1p100;

  bool divides(double coordinate) const
  {
    constexpr double mostUnits = 0x1p62;          // in 64 bits
    const double units = coordinate / this->Unit; // may underflow to 0
    return coordinate == 0.0 || (std::abs(units) >= 1.0 && std::abs(units) < mostUnits &&
                                  static_cast<double>(static_cast<std::int64_t>(units)) == units);
  }

  /// Of a number other than 0; 0 of one that is not finite.
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

#endif
