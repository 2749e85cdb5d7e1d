// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/AlwaysInline.h"

#include <array>
#include <cstddef>
#include <cstring>

namespace isopoint
{

/// Two numbers, for compilers without vector types.
struct PlainPair
{
  double first;
  double second;

  double operator[](std::size_t i) const { return i == 0 ? this->first : this->second; }

  PlainPair& operator+=(const PlainPair& other)
  {
    this->first += other.first;
    this->second += other.second;
    return *this;
  }
  PlainPair& operator-=(const PlainPair& other)
  {
    this->first -= other.first;
    this->second -= other.second;
    return *this;
  }
  PlainPair& operator*=(const PlainPair& other)
  {
    this->first *= other.first;
    this->second *= other.second;
    return *this;
  }
  PlainPair& operator/=(const PlainPair& other)
  {
    this->first /= other.first;
    this->second /= other.second;
    return *this;
  }
};

#ifdef __GNUC__
using RegisterPair = double __attribute__((vector_size(16)));
#else
using RegisterPair = PlainPair;
#endif

/// Numbers in registers of two, which all processors have, so that results do not depend on wider
/// ones. Arithmetic is element-wise.
/// @tparam Count even
template <std::size_t Count, class Pair = RegisterPair>
class Pack
{
public:
  Pack() = default;

  /// Implicit: a number stands for `Count` copies.
  ISOPOINT_ALWAYS_INLINE Pack(double number)
  {
    for (Pair& pair : this->Pairs)
    {
      pair = Pair{ number, number };
    }
  }

  ISOPOINT_ALWAYS_INLINE static Pack load(const double* numbers)
  {
    Pack pack;
    for (std::size_t i = 0; i < Count / 2; ++i)
    {
      std::memcpy(&pack.Pairs[i], numbers + 2 * i, sizeof(Pair));
    }
    return pack;
  }

  ISOPOINT_ALWAYS_INLINE void store(double* numbers) const
  {
    for (std::size_t i = 0; i < Count / 2; ++i)
    {
      std::memcpy(numbers + 2 * i, &this->Pairs[i], sizeof(Pair));
    }
  }

  ISOPOINT_ALWAYS_INLINE double operator[](std::size_t i) const
  {
    return this->Pairs[i / 2][i % 2];
  }

  ISOPOINT_ALWAYS_INLINE Pack& operator+=(const Pack& other)
  {
    for (std::size_t i = 0; i < Count / 2; ++i)
    {
      this->Pairs[i] += other.Pairs[i];
    }
    return *this;
  }
  ISOPOINT_ALWAYS_INLINE Pack& operator-=(const Pack& other)
  {
    for (std::size_t i = 0; i < Count / 2; ++i)
    {
      this->Pairs[i] -= other.Pairs[i];
    }
    return *this;
  }
  ISOPOINT_ALWAYS_INLINE Pack& operator*=(const Pack& other)
  {
    for (std::size_t i = 0; i < Count / 2; ++i)
    {
      this->Pairs[i] *= other.Pairs[i];
    }
    return *this;
  }
  ISOPOINT_ALWAYS_INLINE Pack& operator/=(const Pack& other)
  {
    for (std::size_t i = 0; i < Count / 2; ++i)
    {
      this->Pairs[i] /= other.Pairs[i];
    }
    return *this;
  }

  ISOPOINT_ALWAYS_INLINE friend Pack operator+(Pack a, const Pack& b) { return a += b; }
  ISOPOINT_ALWAYS_INLINE friend Pack operator-(Pack a, const Pack& b) { return a -= b; }
  ISOPOINT_ALWAYS_INLINE friend Pack operator*(Pack a, const Pack& b) { return a *= b; }
  ISOPOINT_ALWAYS_INLINE friend Pack operator/(Pack a, const Pack& b) { return a /= b; }

private:
  std::array<Pair, Count / 2> Pairs;
};

/// Numbers of four samples. A sum over samples adds up in each lane, then by sumOf().
constexpr std::size_t laneCount = 4;
using Lanes = Pack<laneCount>;

template <class Pair>
double sumOf(const Pack<laneCount, Pair>& lanes)
{
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

/// Adds squares in the order of sums over samples.
template <std::size_t Count, class Pair>
ISOPOINT_ALWAYS_INLINE inline double sumOfSquares(const Pack<Count, Pair>& numbers)
{
  using Group = Pack<laneCount, Pair>;
  std::array<double, Count> all;
  numbers.store(all.data());
  Group total = 0.0;
  for (std::size_t i = 0; i < Count; i += laneCount)
  {
    const Group group = Group::load(all.data() + i);
    total += group * group;
  }
  return sumOf(total);
}

} // namespace isopoint
