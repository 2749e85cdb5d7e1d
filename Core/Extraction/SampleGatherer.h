// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Extraction/ExtractionContext.h"
#include "Core/Extraction/IndexSet.h"
#include "Core/Extraction/LeafRings.h"
#include "Core/Fit/LocalFit.h"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace isopoint
{

/// Gathers the samples around edges, one edge at a time: those of the cells that touch either end.
/// widen() adds the neighbors of these cells across the isovalue. Memory is kept. For one thread.
template <class TSample>
class SampleGatherer
{
public:
  using Id = typename TSample::Id;

  explicit SampleGatherer(ExtractionContext<TSample>& context)
    : Tree(context.tree)
    , AllRings(context)
  {
  }

  /// Gathers the samples of both ends and their neighbors. If one end has very many neighbors, like
  /// a cell that fills a void, its neighbors are left out; if both have, a subset that covers all
  /// directions and distances is taken.
  void gather(Id firstLeaf, Id secondLeaf)
  {
    this->Known.clear();
    this->Samples.clear();
    this->IsWide = false;
    this->AllRings.makeRoom();
    if (this->treeIndexOf(secondLeaf) < this->treeIndexOf(firstLeaf))
    {
      std::swap(firstLeaf, secondLeaf);
    }
    this->Ends = { &this->AllRings.at(firstLeaf), &this->AllRings.at(secondLeaf) };
    this->AreMany = this->Ends[0]->hasTooMany && this->Ends[1]->hasTooMany;
    for (EndRings* const end : this->Ends)
    {
      this->add(end->leaf);
      if (this->AreMany)
      {
        this->AllRings.represent(*end);
      }
      if (this->isTaken(*end))
      {
        this->addAll(end->first);
      }
    }
  }

  /// Adds the second ring across the isovalue, unless there are enough samples, as on lines.
  void widen()
  {
    constexpr std::size_t enoughSamples = 128;
    if (this->IsWide || this->Samples.size() > enoughSamples)
    {
      return;
    }
    this->IsWide = true;
    for (EndRings* const end : this->Ends)
    {
      if (this->isTaken(*end))
      {
        this->addAll(this->AllRings.secondOf(*end));
      }
    }
  }

  /// The distinct samples of the current edge, in an order that depends only on the tree.
  const std::vector<FitSample>& samples() const { return this->Samples; }

  /// The mean spacing at the ends whose neighbors are taken.
  double spacing()
  {
    double sum = 0.0;
    double count = 0.0;
    for (EndRings* const end : this->Ends)
    {
      if (this->isTaken(*end))
      {
        sum += this->AllRings.spacingOf(*end);
        count += 1.0;
      }
    }
    return sum / count;
  }

  FitSample sampleAt(Id leaf)
  {
    return { positionOf(this->Tree.sampleOf(leaf)), this->AllRings.valueOf(leaf) };
  }

private:
  using EndRings = typename LeafRings<TSample>::Rings;

  /// Whether the first ring of an end is taken, whole or by representatives.
  bool isTaken(const EndRings& end) const { return this->AreMany || !end.hasTooMany; }

  template <class TLeaves>
  void addAll(const TLeaves& leaves)
  {
    for (const Id leaf : leaves)
    {
      this->add(leaf);
    }
  }

  void add(Id leaf)
  {
    if (this->Known.add(leaf))
    {
      this->Samples.push_back(this->sampleAt(leaf));
    }
  }

  std::size_t treeIndexOf(Id leaf) const { return this->Tree.nodes[leaf].begin; }

  const SampleTree<TSample>& Tree;
  LeafRings<TSample> AllRings;
  std::array<EndRings*, 2> Ends{}; // of the current edge, in tree order
  bool AreMany = false;            // whether both have too many neighbors
  IndexSet<Id> Known;              // leaves whose samples are taken
  std::vector<FitSample> Samples;
  bool IsWide = false;
};

} // namespace isopoint
