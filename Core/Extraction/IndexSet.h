// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isopoint
{

/// A set of indices that is cleared often. Memory is kept. For one thread.
template <class TId>
class IndexSet
{
public:
  /// O(1), except when the generation counter overflows.
  void clear()
  {
    this->Count = 0;
    if (++this->Generation == 0)
    {
      this->Entries.assign(this->Entries.size(), {});
      this->Generation = 1;
    }
  }

  /// @returns whether it was not in the set. O(1) @throws std::bad_alloc
  [[gnu::always_inline]] bool add(TId index)
  {
    if (2 * this->Count >= this->Entries.size())
    {
      this->grow();
    }
    Entry& entry = this->entryOf(index);
    if (entry.generation == this->Generation)
    {
      return false;
    }
    entry = { index, this->Generation };
    ++this->Count;
    return true;
  }

private:
  struct Entry
  {
    TId index = 0;
    std::uint32_t generation = 0; // in the set if it is the current one
  };

  /// The entry of an index, or where to insert it. Nearby nodes have nearby indices, which linear
  /// probing keeps in the same cache lines.
  Entry& entryOf(TId index)
  {
    const std::size_t mask = this->Entries.size() - 1;
    std::size_t at = static_cast<std::size_t>(index) & mask;
    while (this->Entries[at].generation == this->Generation && this->Entries[at].index != index)
    {
      at = (at + 1) & mask;
    }
    return this->Entries[at];
  }

  void grow()
  {
    constexpr std::size_t firstSize = 1024;
    std::vector<Entry> former(this->Entries.empty() ? firstSize : 2 * this->Entries.size());
    former.swap(this->Entries);
    for (const Entry& entry : former)
    {
      if (entry.generation == this->Generation)
      {
        this->entryOf(entry.index) = entry;
      }
    }
  }

  std::vector<Entry> Entries; // size is a power of two
  std::size_t Count = 0;
  std::uint32_t Generation = 1;
};

/// A set of indices below a limit: twice as fast as IndexSet, but takes two bytes for each index
/// below the limit.
class DenseIndexSet
{
public:
  /// @throws std::bad_alloc
  explicit DenseIndexSet(std::size_t limit)
    : Generations(limit, 0)
  {
  }

  /// O(1), except when the generation counter overflows.
  void clear()
  {
    if (++this->Generation == 0)
    {
      std::fill(this->Generations.begin(), this->Generations.end(), std::uint16_t{ 0 });
      this->Generation = 1;
    }
  }

  /// @returns whether it was not in the set. O(1)
  bool add(std::size_t index)
  {
    const bool isNew = this->Generations[index] != this->Generation;
    this->Generations[index] = this->Generation;
    return isNew;
  }

private:
  std::vector<std::uint16_t> Generations; // in which each index was added last
  std::uint16_t Generation = 1;
};

} // namespace isopoint
