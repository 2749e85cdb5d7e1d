// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Lanes_h
#define isopoint_Lanes_h

#include <array>
#include <cstddef>
#include <cstring>

namespace isopoint
{

/// Numbers side by side, in registers of two: every processor that this runs on has these, and no
/// result depends on wider ones. Arithmetic is that of each number alone. The functions are inlined
/// by force: compilers give up on that in large functions, where they matter most.
/// @tparam Count even
template <std::size_t Count>
class Pack
{
public:
  Pack() = default;

  /// Implicit: a number stands for as many of it.
  [[gnu::always_inline]] Pack(double number)
  {
    for (Pair& pair : this->Pairs)
    {
      pair = Pair{ number, number };
    }
  }

  /// The next numbers in memory.
  [[gnu::always_inline]] static Pack load(const double* numbers)
  {
    Pack pack;
    for (std::size_t i = 0; i < Count / 2; ++i)
    {
      std::memcpy(&pack.Pairs[i], numbers + 2 * i, sizeof(Pair));
    }
    return pack;
  }

  [[gnu::always_inline]] void store(double* numbers) const
  {
    for (std::size_t i = 0; i < Count / 2; ++i)
    {
      std::memcpy(numbers + 2 * i, &this->Pairs[i], sizeof(Pair));
    }
  }

  [[gnu::always_inline]] double operator[](std::size_t i) const
  {
    return this->Pairs[i / 2][i % 2];
  }

  [[gnu::always_inline]] Pack& operator+=(const Pack& other)
  {
    for (std::size_t i = 0; i < Count / 2; ++i)
    {
      this->Pairs[i] += other.Pairs[i];
    }
    return *this;
  }
  [[gnu::always_inline]] Pack& operator-=(const Pack& other)
  {
    for (std::size_t i = 0; i < Count / 2; ++i)
    {
      this->Pairs[i] -= other.Pairs[i];
    }
    return *this;
  }
  [[gnu::always_inline]] Pack& operator*=(const Pack& other)
  {
    for (std::size_t i = 0; i < Count / 2; ++i)
    {
      this->Pairs[i] *= other.Pairs[i];
    }
    return *this;
  }
  [[gnu::always_inline]] Pack& operator/=(const Pack& other)
  {
    for (std::size_t i = 0; i < Count / 2; ++i)
    {
      this->Pairs[i] /= other.Pairs[i];
    }
    return *this;
  }

  [[gnu::always_inline]] friend Pack operator+(Pack a, const Pack& b) { return a += b; }
  [[gnu::always_inline]] friend Pack operator-(Pack a, const Pack& b) { return a -= b; }
  [[gnu::always_inline]] friend Pack operator*(Pack a, const Pack& b) { return a *= b; }
  [[gnu::always_inline]] friend Pack operator/(Pack a, const Pack& b) { return a /= b; }

private:
  using Pair = double __attribute__((vector_size(16)));
  std::array<Pair, Count / 2> Pairs;
};

/// Numbers of four samples. A sum over samples is that of each lane and then sumOf().
constexpr std::size_t laneCount = 4;
using Lanes = Pack<laneCount>;

inline double sumOf(const Lanes& lanes)
{
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

/// The squares are added as those of samples are.
template <std::size_t Count>
[[gnu::always_inline]] inline double sumOfSquares(const Pack<Count>& numbers)
{
  std::array<double, Count> all;
  numbers.store(all.data());
  Lanes total = 0.0;
  for (std::size_t i = 0; i < Count; i += laneCount)
  {
    const Lanes group = Lanes::load(all.data() + i);
    total += group * group;
  }
  return sumOf(total);
}

} // namespace isopoint

#endif
