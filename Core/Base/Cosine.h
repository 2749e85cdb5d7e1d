// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace isopoint
{

/// An unevaluated sum with twice the digits of a double [Dek71].
struct TwoDoubles
{
  double high;
  double low;
};

/// a + b, exact if |a| >= |b|.
inline TwoDoubles exactSum(double a, double b)
{
  const double sum = a + b;
  return { sum, b - (sum - a) };
}

/// a * b, exact if no part overflows or underflows.
inline TwoDoubles exactProduct(double a, double b)
{
  const auto upperHalf = [](double number)
  {
    const double scaled = 134217729.0 * number; // 2^27 + 1
    return scaled - (scaled - number);
  };
  const double product = a * b;
  const double aUpper = upperHalf(a);
  const double bUpper = upperHalf(b);
  const double aLower = a - aUpper;
  const double bLower = b - bUpper;
  return { product,
    ((aUpper * bUpper - product) + aUpper * bLower + aLower * bUpper) + aLower * bLower };
}

inline TwoDoubles product(const TwoDoubles& a, const TwoDoubles& b)
{
  const TwoDoubles ofHigh = exactProduct(a.high, b.high);
  return exactSum(ofHigh.high, ofHigh.low + (a.high * b.low + a.low * b.high));
}

inline TwoDoubles quotient(const TwoDoubles& a, double divisor)
{
  const double high = a.high / divisor;
  const TwoDoubles back = exactProduct(high, divisor);
  return exactSum(high, ((a.high - back.high) - back.low + a.low) / divisor);
}

/// The cosine of an angle in [0, pi], rounded to the nearest double; the error before rounding is
/// below 2^-99. Results depend on its last bit, in which C libraries differ.
inline double cosineOf(double angle)
{
  const TwoDoubles square = exactProduct(angle, angle);
  TwoDoubles sum{ 1.0, 0.0 }; // the Taylor series, summed from its end
  constexpr int terms = 22;
  for (int term = terms; term > 0; --term)
  {
    const double divisor = 2.0 * term * (2.0 * term - 1.0);
    const TwoDoubles rest = quotient(product(square, sum), divisor);
    const TwoDoubles high = rest.high > 1.0 ? exactSum(-rest.high, 1.0) : exactSum(1.0, -rest.high);
    sum = exactSum(high.high, high.low - rest.low);
  }
  return sum.high;
}

} // namespace isopoint
