// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SingleTeam_h
#define isopoint_SingleTeam_h

#include "Isopoint/Base/Execution.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isopoint
{

/// The ranks that share a tree, as work on its leaves sees them, where there is but one: it has all
/// samples. TeamOfTree has the same functions for several; there all of them are collective.
struct SingleTeam
{
  /// Does this rank's share of some work, and returns once that of all is done; see Team.
  template <class Work>
  void together(const Work& work) const
  {
    work();
  }

  bool isAny(bool mine) const { return mine; }
  std::uint64_t sum(std::uint64_t mine) const { return mine; }

  /// Adds the numbers of things that other ranks found, and orders all.
  void unite(std::vector<std::size_t>& /*found*/) const {}

  /// Works on the items 0 .. count - 1, in parallel.
  /// @param makeWorker() what one thread needs to work on some items
  /// @param work(worker, item) is begun anew where it threw MissingNode: it must not leave anything
  /// behind then
  template <class MakeWorker, class Work>
  void forEach(const Execution& execution, std::size_t count, const MakeWorker& makeWorker,
    const Work& work) const
  {
    constexpr std::size_t grain = 256;
    forBatches(execution, count, 8 * grain, grain,
      [&](std::size_t begin, std::size_t end)
      {
        auto worker = makeWorker();
        for (std::size_t i = begin; i < end; ++i)
        {
          work(worker, i);
        }
      });
  }
};

} // namespace isopoint

#endif
