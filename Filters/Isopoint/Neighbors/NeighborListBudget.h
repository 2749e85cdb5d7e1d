// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_NeighborListBudget_h
#define isopoint_NeighborListBudget_h

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace isopoint
{

/// Tells when neighbourhoods are better searched than listed. Listing is quicker for small ones,
/// and for a few large ones as well; but those of n samples can add up to n^2 neighbours. Those of
/// large ones that are listed before the limit is reached add up to O(n). Shared by all threads; no
/// result depends on it.
class NeighborListBudget
{
public:
  explicit NeighborListBudget(std::size_t sampleCount)
    : Room(static_cast<std::int64_t>(sampleCount))
  {
  }

  bool isReached() const { return this->Room.load(std::memory_order_relaxed) <= 0; }

  /// Takes a neighbourhood into account that was listed.
  void listed(std::size_t neighborCount)
  {
    constexpr std::size_t few = 64;
    if (neighborCount > few)
    {
      this->Room.fetch_sub(static_cast<std::int64_t>(neighborCount), std::memory_order_relaxed);
    }
  }

private:
  std::atomic<std::int64_t> Room;
};

} // namespace isopoint

#endif
