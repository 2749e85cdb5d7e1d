// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Base/Sorting.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace isopoint
{

/// Finds the elements of a surface or body, edges or tetrahedra, that lie in gaps of the cloud. If
/// ranks share the tree, all functions are collective.
/// @tparam TRanks SingleRank or SharedRanks
/// @tparam TElements has
/// - size();
/// - connect(execution, elements): makes the neighbors of elements known, which may add elements;
/// - forEachNeighbor(element, visit): visits the elements connected with an element, as far as they
/// are known;
/// - isConnected(element): whether they all are
template <class TRanks, class TElements>
class GapSpread
{
public:
  GapSpread(const Execution& execution, TRanks& ranks, TElements& elements)
    : Run(execution)
    , Ranks(ranks)
    , Elements(elements)
  {
    this->resize();
  }

  /// Marks the weak seeds, and all weak elements that a chain of weak ones connects with a seed.
  /// May be called again with other seeds.
  /// @param front the seeds, each once
  /// @param weakAmong(elements) those of some elements that are weak, on any rank
  /// @throws std::bad_alloc, Aborted, FailedElsewhere; so does dropFragments()
  template <class WeakAmong>
  void spread(std::vector<std::size_t> front, const WeakAmong& weakAmong)
  {
    forEachIndex(this->Run, front.size(), [&](std::size_t i) { this->IsReached[front[i]] = 1; });
    while (this->Ranks.isAny(!front.empty()))
    {
      front = this->next(weakAmong(front));
    }
  }

  /// Marks connected sets of fewer than eight unmarked elements next to marked ones.
  void dropFragments()
  {
    std::vector<std::size_t> fragments;
    // Everything next to a gap was reached.
    std::vector<std::size_t> candidates = itemsThat(this->Run, this->IsReached.size(),
      [this](std::size_t element) {
        return this->IsReached[element] && !this->IsInGap[element] && this->isBesideGap(element);
      });
    while (!candidates.empty())
    {
      throwIfAborted(this->Run);
      std::vector<std::size_t> open; // whose pieces may be larger
      std::vector<std::size_t> ofOpen;
      for (const std::size_t element : candidates)
      {
        const std::vector<std::size_t> piece = this->pieceAround(element);
        if (piece.size() >= smallestPiece)
        {
          continue;
        }
        const bool isWhole = std::all_of(piece.begin(), piece.end(),
          [this](std::size_t other) { return this->Elements.isConnected(other); });
        if (!isWhole)
        {
          open.push_back(element);
        }
        std::vector<std::size_t>& list = isWhole ? fragments : ofOpen;
        list.insert(list.end(), piece.begin(), piece.end());
      }
      this->connect(ofOpen);
      candidates.swap(open);
    }
    forEachInOrder(
      this->Run, fragments.size(), [&](std::size_t i) { this->IsInGap[fragments[i]] = 1; });
  }

  /// Whether an element was a seed or beside a marked one. Unmarked ones are not weak.
  bool isReached(std::size_t element) const { return this->IsReached[element] != 0; }

  /// By element, whether it is marked. Moved out.
  std::vector<char> takeMarks() { return std::move(this->IsInGap); }

private:
  /// Smaller pieces next to a gap are dropped with it.
  static constexpr std::size_t smallestPiece = 8;

  void resize()
  {
    this->IsReached.resize(this->Elements.size(), 0);
    this->IsInGap.resize(this->Elements.size(), 0);
  }

  void connect(const std::vector<std::size_t>& elements)
  {
    this->Elements.connect(this->Run, elements);
    this->resize();
  }

  /// Marks elements as in a gap. @returns their neighbors that were not reached before
  std::vector<std::size_t> next(const std::vector<std::size_t>& elements)
  {
    this->connect(elements);
    std::vector<std::size_t> found;
    forEachInOrder(this->Run, elements.size(),
      [&](std::size_t i)
      {
        const std::size_t element = elements[i];
        if (this->IsInGap[element])
        {
          return;
        }
        this->IsInGap[element] = 1;
        this->IsReached[element] = 1;
        this->Elements.forEachNeighbor(element,
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
    return sortedUnique(this->Run, found, this->Elements.size());
  }

  bool isBesideGap(std::size_t element) const
  {
    bool isBeside = false;
    this->Elements.forEachNeighbor(
      element, [&](std::size_t neighbor) { isBeside = isBeside || this->IsInGap[neighbor] != 0; });
    return isBeside;
  }

  /// The unmarked elements connected with one; not all if there are at least `smallestPiece`.
  std::vector<std::size_t> pieceAround(std::size_t element) const
  {
    std::vector<std::size_t> piece{ element };
    for (std::size_t i = 0; i < piece.size() && piece.size() < smallestPiece; ++i)
    {
      this->Elements.forEachNeighbor(piece[i],
        [&](std::size_t neighbor)
        {
          if (!this->IsInGap[neighbor] &&
              std::find(piece.begin(), piece.end(), neighbor) == piece.end())
          {
            piece.push_back(neighbor);
          }
        });
    }
    return piece;
  }

  const Execution& Run;
  TRanks& Ranks;
  TElements& Elements;
  std::vector<char> IsReached; // by element, whether it is a seed or connected with one in a gap
  std::vector<char> IsInGap;   // by element
};

} // namespace isopoint
