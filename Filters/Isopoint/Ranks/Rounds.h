// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Rounds_h
#define isopoint_Rounds_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Ranks/NodeExchange.h"
#include "Isopoint/Tree/SampleTree.h"

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <numeric>
#include <vector>

namespace isopoint
{

/// Works on the items 0 .. count - 1, in parallel. An item that lacks samples of other ranks is put
/// aside; these are fetched, and it is begun anew, until no rank lacks any. Collective.
/// @param makeWorker() what one thread needs to work on some items
/// @param work(worker, item) throws MissingNode where it lacks samples; it must not leave anything
/// behind then
/// @param reportsProgress whether one round takes the execution from no progress to all
/// @throws what the work throws, std::bad_alloc, Aborted, FailedElsewhere
template <class TSample, class MakeWorker, class Work>
void inRounds(const Execution& execution, NodeExchange<TSample>& exchange, std::size_t count,
  const MakeWorker& makeWorker, const Work& work, bool reportsProgress = true)
{
  std::vector<std::size_t> items;
  std::vector<MissingNode> missing;
  exchange.together(
    [&]()
    {
      items.resize(count);
      std::iota(items.begin(), items.end(), std::size_t{ 0 });
    });
  do
  {
    exchange.together(
      [&]()
      {
        std::vector<std::size_t> aside;
        std::mutex mutex;
        constexpr std::size_t batch = 1024;
        constexpr std::size_t grain = 256;
        forBatches(
          execution, items.size(), batch, grain,
          [&](std::size_t begin, std::size_t end)
          {
            auto worker = makeWorker();
            for (std::size_t i = begin; i < end; ++i)
            {
              try
              {
                work(worker, items[i]);
              }
              catch (const MissingNode& node)
              {
                const std::lock_guard<std::mutex> lock(mutex);
                aside.push_back(items[i]);
                missing.push_back(node);
              }
            }
          },
          [&](double share)
          {
            if (reportsProgress)
            {
              execution.progress(share);
            }
          });
        std::sort(aside.begin(), aside.end());
        items.swap(aside);
      });
  } while (exchange.fetch(missing));
}

} // namespace isopoint

#endif
