// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes compilers inline Eigen's assignments in large functions, too.
#if defined(__GNUC__) && !defined(EIGEN_STRONG_INLINE)
#define EIGEN_STRONG_INLINE __attribute__((always_inline)) inline
#endif
#include <Eigen/Core>

#include <cstddef>

namespace isopoint
{

/// Numbers side by side. Arithmetic is element-wise, so results do not depend on the width of
/// registers.
template <std::size_t Count>
using Pack = Eigen::Array<double, static_cast<int>(Count), 1>;

/// Numbers of four samples. A sum over samples adds up in each lane, then by sumOf().
constexpr std::size_t laneCount = 4;
using Lanes = Pack<laneCount>;

inline double sumOf(const Lanes& lanes)
{
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

/// Adds squares in the order of sums over samples.
template <int Count>
double sumOfSquares(const Eigen::Array<double, Count, 1>& numbers)
{
  constexpr int lanes = static_cast<int>(laneCount);
  Lanes total = Lanes::Zero();
  for (int i = 0; i < Count; i += lanes)
  {
    total += numbers.template segment<lanes>(i).square();
  }
  return sumOf(total);
}

} // namespace isopoint
