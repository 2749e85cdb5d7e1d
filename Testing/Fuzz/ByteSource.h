// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

/// Ends the program if a result is wrong.
inline void require(bool isRight, const char* what)
{
  if (!isRight)
  {
    std::fprintf(stderr, "wrong: %s\n", what);
    std::abort();
  }
}

/// A number as an array of floats or doubles holds it: those beyond the range of the type become
/// infinite, as in readers of files.
template <class T>
double asHeld(double number)
{
  return std::abs(number) > static_cast<double>(std::numeric_limits<T>::max())
           ? std::copysign(std::numeric_limits<double>::infinity(), number)
           : static_cast<double>(static_cast<T>(number));
}

/// Reads decisions and numbers from a fuzzer's bytes; once these are used up, from random ones with
/// these as the seed, so that a few bytes yield a whole cloud.
class ByteSource
{
public:
  ByteSource(const std::uint8_t* data, std::size_t size)
    : Data(data)
    , Remaining(size)
  {
  }

  std::uint8_t byte()
  {
    if (this->Remaining == 0)
    {
      this->State = this->State * 6364136223846793005u + 1442695040888963407u;
      return static_cast<std::uint8_t>(this->State >> 56);
    }
    --this->Remaining;
    this->State = 31 * this->State + *this->Data;
    return *this->Data++;
  }

  /// A whole number from 0 to limit - 1. @param limit at most 256
  int below(int limit) { return this->byte() % limit; }

  bool flag() { return this->below(2) == 1; }

  /// A value of any bits.
  template <class T>
  T raw()
  {
    std::uint8_t bytes[sizeof(T)];
    std::generate_n(bytes, sizeof(T), [this]() { return this->byte(); });
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

  /// A number of one kind, 0 to 3: small and whole (so that many are equal), of 16 bits, special,
  /// or of any bits.
  double number(int kind)
  {
    static const std::array<double, 16> special{ 0.0, -0.0, 1.0, -1.0, 0.5, 1e-3, 1e9, 1e9 + 1e-3,
      std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::min(),
      std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest(), 1e30, 1e-30,
      std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN() };
    switch (kind)
    {
      case 0:
        return this->below(4);
      case 1:
        return this->raw<std::int16_t>() / 1024.0;
      case 2:
        return special[static_cast<std::size_t>(this->below(16))];
      default:
        return this->raw<double>();
    }
  }

private:
  const std::uint8_t* Data;
  std::size_t Remaining;
  std::uint64_t State = 1;
};
