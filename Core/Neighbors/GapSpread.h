// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_GapSpread_h
#define isopoint_GapSpread_h

#include "Core/Base/Execution.h"
#include "Core/Base/SortUnique.h"
#include "Core/Neighbors/GapCriterion.h"
#include "Core/Tree/SampleBounds.h"
#include "Core/Tree/SampleTree.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace isopoint
{

/// Drops what is marked.
template <class T>
void dropMarked(const std::vector<char>& marks, std::vector<T>& all)
{
  std::size_t kept = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (!marks[i])
    {
      all[kept++] = all[i];
    }
  }
  all.resize(kept);
}

/// Finds which parts of a surface, its edges or tetrahedra, lie in gaps of the cloud: those over
/// the weak gap criterion that are connected with a seed through others over it. Where several
/// ranks share the tree, all functions are collective.
/// @tparam TRanks SingleRank, or SharedRanks
/// @tparam TParts has
/// - size();
/// - anyEdge(part, test), whether test(leaf, otherLeaf) is true of any edge of a part;
/// - isCounted(part), whether this rank is to look at it;
/// - unite(ranks, parts), which adds those that other ranks found, and orders them;
/// - forEachNeighbor(part, visit), the parts that are connected with it
template <class TSample, class TRanks, class TParts>
class GapSpread
{
public:
  GapSpread(
    const Execution& execution, const SampleTree<TSample>& tree, TRanks& ranks, TParts& parts)
    : Run(execution)
    , Tree(tree)
    , Bounds(tree)
    , Ranks(ranks)
    , Parts(parts)
  {
  }

  /// Those of some parts that have an edge over a criterion, and those that other ranks found.
  /// @throws std::bad_alloc, Aborted, FailedElsewhere; so do the other functions
  template <class TCriterion>
  std::vector<std::size_t> over(
    const TCriterion& criterion, const std::vector<std::size_t>& candidates)
  {
    constexpr std::size_t grain = 256;
    std::vector<char> marks(candidates.size(), 0);
    this->Ranks.forEach(
      this->Run, { candidates.size(), 8 * grain, grain }, []() { return 0; },
      [&](int, std::size_t i)
      {
        const std::size_t part = candidates[i];
        marks[i] = this->Parts.isCounted(part) && this->isOver(criterion, part) ? 1 : 0;
      });
    std::vector<std::size_t> found;
    for (const std::size_t i : markedOf(marks))
    {
      found.push_back(candidates[i]);
    }
    this->Parts.unite(this->Ranks, found);
    return found;
  }

  /// Marks what is in gaps.
  /// @param weak the weak criterion
  /// @param front the seeds, each once
  template <class TCriterion>
  void spread(const TCriterion& weak, std::vector<std::size_t> front)
  {
    this->IsReached.resize(this->Parts.size(), 0);
    this->IsInGap.resize(this->Parts.size(), 0);
    for (const std::size_t part : front)
    {
      this->IsReached[part] = 1;
    }
    while (this->Ranks.isAny(!front.empty()))
    {
      front = this->next(this->over(weak, front));
    }
  }

  /// Of each part, whether it is in a gap.
  const std::vector<char>& isInGap() const { return this->IsInGap; }

  /// The same, which is empty from then on.
  std::vector<char> takeInGap() { return std::move(this->IsInGap); }

  /// Of each part, whether it is a seed or is connected with a part in a gap.
  const std::vector<char>& isReached() const { return this->IsReached; }

private:
  template <class TCriterion>
  bool isOver(const TCriterion& criterion, std::size_t part)
  {
    return this->Parts.anyEdge(part,
      [&](std::size_t leaf, std::size_t other)
      {
        return criterion.drops(
          this->Tree, this->Bounds, this->Tree.sampleOf(leaf), this->Tree.sampleOf(other));
      });
  }

  /// Puts parts into the gap. @returns their neighbors that were not reached before
  std::vector<std::size_t> next(const std::vector<std::size_t>& parts)
  {
    throwIfAborted(this->Run);
    std::vector<std::size_t> found;
    for (const std::size_t part : parts)
    {
      if (this->IsInGap[part])
      {
        continue;
      }
      this->IsInGap[part] = 1;
      this->IsReached[part] = 1;
      this->Parts.forEachNeighbor(part,
        [&](std::size_t neighbor)
        {
          if (!this->IsReached[neighbor])
          {
            this->IsReached[neighbor] = 1;
            found.push_back(neighbor);
          }
        });
    }
    std::sort(found.begin(), found.end()); // neighbors stand in another order on each rank
    return found;
  }

  const Execution& Run;
  const SampleTree<TSample>& Tree;
  SampleBounds<TSample> Bounds;
  TRanks& Ranks;
  TParts& Parts;
  std::vector<char> IsReached;
  std::vector<char> IsInGap;
};

} // namespace isopoint

#endif
