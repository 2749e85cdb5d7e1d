// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_OrderedKey_h
#define isopoint_OrderedKey_h

#include <cstdint>
#include <cstring>

namespace isopoint
{

/// A whole number for each finite double, so that the numbers compare as the doubles do; that of -0
/// is that of 0.
inline std::uint64_t orderedKey(double number)
{
  constexpr std::uint64_t sign = std::uint64_t{ 1 } << 63;
  const double normalized = number == 0.0 ? 0.0 : number;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &normalized, sizeof(bits));
  return (bits & sign) != 0 ? ~bits : bits | sign;
}

/// The double of a number.
inline double fromOrderedKey(std::uint64_t key)
{
  constexpr std::uint64_t sign = std::uint64_t{ 1 } << 63;
  const std::uint64_t bits = (key & sign) != 0 ? key & ~sign : ~key;
  double number = 0.0;
  std::memcpy(&number, &bits, sizeof(number));
  return number;
}

} // namespace isopoint

#endif
