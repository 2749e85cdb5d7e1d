// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Neighbors/GapCriterion.h"
#include "Core/Tree/SampleBounds.h"
#include "Core/Tree/SampleTree.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace isopoint
{

/// Smaller pieces of tetrahedra next to a gap are dropped with it.
inline constexpr std::size_t smallestPiece = 8;

/// Finds the parts of a surface, edges or tetrahedra, that lie in gaps of the cloud: parts that the
/// weak gap criterion rejects and that are connected with a seed through other such parts. If ranks
/// share the tree, all functions are collective.
/// @tparam TRanks SingleRank or SharedRanks
/// @tparam TParts has
/// - size();
/// - anyEdge(part, test): whether test(leaf, otherLeaf) is true for any edge of a part;
/// - isCounted(part): whether this rank examines the part;
/// - unite(ranks, parts): adds parts that other ranks found, and sorts;
/// - forEachNeighbor(execution, part, visit): visits the parts connected with a part
template <class TSample, class TRanks, class TParts>
class GapSpread
{
public:
  GapSpread(
    const Execution& execution, const SampleTree<TSample>& tree, TRanks& ranks, TParts& parts)
    : Exec(execution)
    , Tree(tree)
    , Bounds(tree)
    , Ranks(ranks)
    , Parts(parts)
  {
  }

  /// The candidates with an edge that a criterion rejects, on any rank.
  /// @throws std::bad_alloc, Aborted, FailedElsewhere; so do the other functions
  template <class TCriterion>
  std::vector<std::size_t> rejectedAmong(
    const TCriterion& criterion, const std::vector<std::size_t>& candidates)
  {
    constexpr std::size_t grain = 256;
    std::vector<char> marks(candidates.size(), 0);
    this->Ranks.forEach(
      this->Exec, { candidates.size(), 8 * grain, grain }, []() { return 0; },
      [&](int, std::size_t i)
      {
        const std::size_t part = candidates[i];
        marks[i] = this->Parts.isCounted(part) && this->isRejected(criterion, part) ? 1 : 0;
      });
    std::vector<std::size_t> found = markedOf(this->Exec, marks);
    std::transform(
      found.begin(), found.end(), found.begin(), [&](std::size_t i) { return candidates[i]; });
    this->Parts.unite(this->Ranks, found);
    return found;
  }

  /// Marks the parts in gaps.
  /// @param weak the weak criterion
  /// @param front the seeds, each once
  template <class TCriterion>
  void spread(const TCriterion& weak, std::vector<std::size_t> front)
  {
    this->IsReached.resize(this->Parts.size(), 0);
    this->IsInGap.resize(this->Parts.size(), 0);
    forEachIndex(this->Exec, front.size(), [&](std::size_t i) { this->IsReached[front[i]] = 1; });
    while (this->Ranks.isAny(!front.empty()))
    {
      front = this->next(this->rejectedAmong(weak, front));
    }
  }

  /// By part, whether it is in a gap.
  const std::vector<char>& isInGap() const { return this->IsInGap; }

  /// The same, moved out.
  std::vector<char> takeInGap() { return std::move(this->IsInGap); }

  /// By part, whether it is a seed or connected with a part in a gap.
  const std::vector<char>& isReached() const { return this->IsReached; }

private:
  template <class TCriterion>
  bool isRejected(const TCriterion& criterion, std::size_t part)
  {
    return this->Parts.anyEdge(part,
      [&](std::size_t leaf, std::size_t other)
      {
        return criterion.drops(
          this->Tree, this->Bounds, this->Tree.sampleOf(leaf), this->Tree.sampleOf(other));
      });
  }

  /// Marks parts as in a gap. @returns their neighbors that were not reached before
  std::vector<std::size_t> next(const std::vector<std::size_t>& parts)
  {
    std::vector<std::size_t> found;
    forEachInOrder(this->Exec, parts.size(),
      [&](std::size_t i)
      {
        const std::size_t part = parts[i];
        if (this->IsInGap[part])
        {
          return;
        }
        this->IsInGap[part] = 1;
        this->IsReached[part] = 1;
        this->Parts.forEachNeighbor(this->Exec, part,
          [&](std::size_t neighbor)
          {
            if (!this->IsReached[neighbor])
            {
              this->IsReached[neighbor] = 1;
              found.push_back(neighbor);
            }
          });
      });
    // The order of neighbors differs among ranks.
    return sortedUnique(this->Exec, found, this->Parts.size());
  }

  const Execution& Exec;
  const SampleTree<TSample>& Tree;
  SampleBounds<TSample> Bounds;
  TRanks& Ranks;
  TParts& Parts;
  std::vector<char> IsReached;
  std::vector<char> IsInGap;
};

} // namespace isopoint
