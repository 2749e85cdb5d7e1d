// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Base/Region.h"
#include "Core/Base/Sorting.h"
#include "Core/Base/Vector.h"
#include "Core/Neighbors/NearestSamples.h"
#include "Core/Places/PlaceEvaluator.h"
#include "Core/Tree/SampleTree.h"
#include "Core/Tree/TreeRefinement.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <type_traits>
#include <utility>
#include <vector>

namespace isopoint
{

/// Splits the nodes that searches miss, on one rank that has all samples.
template <class TSample>
class OwnNodes
{
public:
  OwnNodes(const Execution& execution, SampleTree<TSample>& tree)
    : Run(execution)
    , Tree(tree)
  {
  }

  /// As NodeExchange::fetchNodes(), which takes its place on ranks.
  bool fetchNodes(std::vector<MissingNode>& missing, int /*depth*/)
  {
    std::vector<std::size_t> nodes;
    nodes.reserve(missing.size());
    for (const MissingNode& node : missing)
    {
      nodes.push_back(node.nodeIndex);
    }
    missing.clear();
    splitToBuckets(this->Run, this->Tree, nodes);
    return !nodes.empty();
  }

private:
  const Execution& Run;
  SampleTree<TSample>& Tree;
};

/// The samples around one place after the other. For one thread.
template <class TSample>
class SurroundingsSearch
{
public:
  SurroundingsSearch(const SampleTree<TSample>& tree, const ProbeOptions& options)
    : Tree(tree)
    , Search(tree)
    , Fitted(fittedCount(options.method))
    , Needed(neededCount(options))
    , IgnoresFar(options.outside == OutsideStrategy::Number)
  {
  }

  /// @param missing see NearestSamples
  /// @returns whether all were found; see around()
  bool search(const Vector& place, std::vector<MissingNode>& missing)
  {
    this->Around.clear();
    if (!isFinite(place) || (this->IgnoresFar && this->isFar(place)))
    {
      return true;
    }
    if (!this->Search.search(place, std::max(this->Needed, this->Fitted + 1), missing))
    {
      return false;
    }
    const auto& found = this->Search.found();
    const std::size_t count = std::min(this->Needed, found.size());
    for (std::size_t i = 0; i < count; ++i)
    {
      const TSample* const samples = this->Tree.samples.data() + found[i].begin;
      this->Around.offsets.push_back(positionOf(samples[0]) - place);
      for (std::size_t k = 0; k < found[i].count; ++k)
      {
        this->Around.ids.push_back(samples[k].id);
      }
      this->Around.idBegins.push_back(this->Around.ids.size());
    }
    this->Around.setReach(this->Fitted,
      found.size() > this->Fitted ? std::sqrt(found[this->Fitted].squaredDistance) : -1.0);
    if (!std::isfinite(this->Around.reach))
    {
      this->Around.clear(); // distances overflow
    }
    return true;
  }

  const NearbySamples& around() const { return this->Around; }

  /// The samples of around(), and perhaps one more.
  const std::vector<NearSample<TSample>>& found() const { return this->Search.found(); }

private:
  /// Whether a place is outside for certain: farther from the samples than these are from each
  /// other. There, distances are equal up to rounding, and a search may visit all samples.
  bool isFar(const Vector& place) const
  {
    const Region& region = this->Tree.region;
    const Vector gap = gapTo(region, place);
    return *std::max_element(gap.begin(), gap.end()) > lengthOf(region.upper - region.lower);
  }

  const SampleTree<TSample>& Tree;
  NearestSamples<TSample> Search;
  const std::size_t Fitted;
  const std::size_t Needed;
  const bool IgnoresFar;
  NearbySamples Around;
};

/// The unsplit node or bucket around a place.
template <class TSample>
std::size_t nodeAround(const SampleTree<TSample>& tree, const Vector& place)
{
  std::size_t index = rootNode;
  while (tree.nodes[index].isSplit() && !tree.nodes[index].isBucket)
  {
    const Node<TSample>& node = tree.nodes[index];
    index = tree.child(node, place[node.axis] > node.plane);
  }
  return index;
}

/// The numbers of places in the order of the tree, which is refined around them.
template <class TSample, class TNodes>
std::vector<std::size_t> placesInTreeOrder(const Execution& execution,
  const SampleTree<TSample>& tree, TNodes& nodes, const std::vector<Vector>& places)
{
  if (tree.isEmpty())
  {
    return iota(places.size());
  }
  using NodeAtPlace = std::pair<std::size_t, std::size_t>;
  std::vector<MissingNode> missing;
  do
  {
    const auto found = collected<NodeAtPlace>(execution, { places.size(), 1 << 16, 1024 },
      [&](std::size_t begin, std::size_t end, std::vector<NodeAtPlace>& list)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          const std::size_t index = nodeAround(tree, places[i]);
          const Node<TSample>& node = tree.nodes[index];
          if ((node.isAbsent || !(node.isLeaf || node.isBucket)) &&
              (list.empty() || list.back().first != index))
          {
            list.emplace_back(index, i);
          }
        }
      });
    for (const auto& [node, place] : found)
    {
      missing.push_back({ node, { places[place], places[place] } });
    }
  } while (nodes.fetchNodes(missing, maximumDepth + 1));
  return orderByKeys(
    execution, places.size(), tree.samples.size(),
    [&](std::size_t i) -> std::size_t { return tree.nodes[nodeAround(tree, places[i])].begin; },
    [](std::size_t begin) { return begin; });
}

/// Calls use(worker, place, search) for each place, with a SurroundingsSearch that has found the
/// samples around it.
/// @param nodes OwnNodes, or for ranks NodeExchange
template <class TSample, class TNodes, class MakeWorker, class Use>
void forSurroundings(const Execution& execution, const SampleTree<TSample>& tree, TNodes& nodes,
  const ProbeOptions& options, const std::vector<Vector>& places, const MakeWorker& makeWorker,
  const Use& use)
{
  struct Worker
  {
    SurroundingsSearch<TSample> search;
    std::decay_t<decltype(makeWorker())> user;
  };
  const Execution rising = withRisingProgress(execution);
  std::vector<std::size_t> order = placesInTreeOrder(rising, tree, nodes, places);
  std::vector<MissingNode> missing;
  std::mutex mutex;
  const auto done = [&](double share)
  {
    rising.progress(
      1.0 - (1.0 - share) * static_cast<double>(order.size()) / static_cast<double>(places.size()));
  };
  do
  {
    std::vector<std::size_t> again;
    forEachItem(
      rising, { order.size(), 2048, 256 },
      [&]() {
        return Worker{ SurroundingsSearch<TSample>(tree, options), makeWorker() };
      },
      [&](Worker& worker, std::size_t i)
      {
        std::vector<MissingNode> needed;
        if (worker.search.search(places[order[i]], needed))
        {
          use(worker.user, order[i], worker.search);
          return;
        }
        const std::lock_guard<std::mutex> lock(mutex);
        again.push_back(order[i]);
        missing.insert(missing.end(), needed.begin(), needed.end());
      },
      done);
    order.swap(again);
  } while (nodes.fetchNodes(missing, maximumDepth + 1));
}

} // namespace isopoint
