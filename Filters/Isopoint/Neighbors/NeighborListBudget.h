// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_NeighborListBudget_h
#define isopoint_NeighborListBudget_h

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace isopoint
{

/// A budget of listed neighbors, shared by all threads. To list a neighborhood is quicker than to
/// search it where it is small, and for a few large ones; but the neighborhoods of n samples can
/// add up to n^2 neighbors. With this budget, those of large neighborhoods that are listed add up
/// to O(n); when it is spent, neighborhoods are to be searched (see ImplicitNeighborhood). No
/// result depends on it.
class NeighborListBudget
{
public:
  explicit NeighborListBudget(std::size_t sampleCount)
    : Remaining(static_cast<std::int64_t>(sampleCount))
  {
  }

  bool isSpent() const { return this->Remaining.load(std::memory_order_relaxed) <= 0; }

  /// Accounts for a neighborhood that was listed; small ones are free.
  void spend(std::size_t neighborCount)
  {
    constexpr std::size_t few = 64;
    if (neighborCount > few)
    {
      this->Remaining.fetch_sub(
        static_cast<std::int64_t>(neighborCount), std::memory_order_relaxed);
    }
  }

private:
  std::atomic<std::int64_t> Remaining;
};

} // namespace isopoint

#endif
