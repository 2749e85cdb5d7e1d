// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_LockGrid_h
#define isopoint_LockGrid_h

#include "Isopoint/Base/Region.h"
#include "Isopoint/Base/Vector.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isopoint
{

/// Locks of the cells of a regular grid, of which threads hold several at a time. Nobody waits: who
/// does not get a lock gives all of theirs back and tries again later. No function but the
/// constructors allocates or throws.
class LockGrid
{
public:
  /// The most holders of one grid.
  static constexpr std::size_t mostHolders = 255;

  /// The locks of a piece of work, which runs on one thread at a time.
  class Holder
  {
  public:
    /// @param number from 0, below mostHolders; another one for each holder of a grid
    explicit Holder(std::size_t number)
      : Name(static_cast<std::uint8_t>(number + 1))
    {
      this->Cells.reserve(mostCells);
    }

  private:
    friend class LockGrid;
    static constexpr std::size_t mostCells = 4096;

    std::uint8_t Name;
    std::vector<std::uint32_t> Cells; // that are held
  };

  /// @param region where most positions are; those elsewhere belong to the cells at its border
  explicit LockGrid(const Region& region)
    : Lower(region.lower)
    , Names(side * side * side)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double extent = region.upper[axis] - region.lower[axis];
      this->Scale[axis] = extent > 0.0 ? static_cast<double>(side) / extent : 0.0;
    }
  }

  /// Locks the cell of a position, unless the holder has it already.
  /// @returns whether the holder has it now; not if another one has it, or if it holds too many
  bool tryLock(const Vector& position, Holder& holder)
  {
    const std::size_t cell = this->cellOf(position);
    std::atomic<std::uint8_t>& name = this->Names[cell];
    std::uint8_t present = name.load(std::memory_order_relaxed);
    if (present == holder.Name)
    {
      return true;
    }
    if (present != free || holder.Cells.size() == Holder::mostCells ||
        !name.compare_exchange_strong(present, holder.Name, std::memory_order_acquire))
    {
      return false;
    }
    holder.Cells.push_back(static_cast<std::uint32_t>(cell));
    return true;
  }

  bool isLocked(const Vector& position, const Holder& holder) const
  {
    return this->Names[this->cellOf(position)].load(std::memory_order_relaxed) == holder.Name;
  }

  void unlockAll(Holder& holder)
  {
    for (const std::uint32_t cell : holder.Cells)
    {
      this->Names[cell].store(free, std::memory_order_release);
    }
    holder.Cells.clear();
  }

private:
  static constexpr std::size_t side = 64;
  static constexpr std::uint8_t free = 0;

  std::size_t cellOf(const Vector& position) const
  {
    const auto place = [&](std::size_t axis)
    {
      const double inside = (position[axis] - this->Lower[axis]) * this->Scale[axis];
      // 0 also where that is not a number, since extents overflow.
      return static_cast<std::size_t>(
        std::min(std::max(0.0, inside), static_cast<double>(side - 1)));
    };
    return (place(2) * side + place(1)) * side + place(0);
  }

  Vector Lower;
  Vector Scale;                                 // cells by unit of length
  std::vector<std::atomic<std::uint8_t>> Names; // of the holders
};

} // namespace isopoint

#endif
