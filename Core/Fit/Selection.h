// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>

namespace isopoint
{

/// Moves the numbers that belong to the front. No branch, as it would be unpredictable. O(n)
/// @returns how many there are
template <class Belongs>
std::size_t moveToFront(double* numbers, std::size_t count, const Belongs& belongs)
{
  std::size_t front = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double number = numbers[i];
    numbers[i] = numbers[front];
    numbers[front] = number;
    front += belongs(number) ? 1 : 0;
  }
  return front;
}

/// The number at a place in sorted order; any number if one is NaN. Reorders the numbers. Faster
/// than std::nth_element() for hundreds. O(n) on average, O(n^2) at worst
/// @param place below count
inline double selectNth(double* numbers, std::size_t count, std::size_t place)
{
  constexpr std::size_t few = 8;
  while (count > few)
  {
    const double first = numbers[0];
    const double middle = numbers[count / 2];
    const double last = numbers[count - 1];
    const double pivot = std::max(std::min(first, middle), std::min(std::max(first, middle), last));
    const std::size_t below =
      moveToFront(numbers, count, [pivot](double number) { return number < pivot; });
    if (place < below)
    {
      count = below;
      continue;
    }
    numbers += below;
    count -= below;
    place -= below;
    if (below == 0)
    {
      const std::size_t equal =
        moveToFront(numbers, count, [pivot](double number) { return number <= pivot; });
      if (place < equal || equal == 0)
      {
        return pivot;
      }
      numbers += equal;
      count -= equal;
      place -= equal;
    }
  }
  std::sort(numbers, numbers + count);
  return numbers[place];
}

} // namespace isopoint
