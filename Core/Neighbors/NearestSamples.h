// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Region.h"
#include "Core/Base/Vector.h"
#include "Core/Tree/SampleTree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace isopoint
{

/// The sample, or coincident samples, at one position, as seen from a place.
template <class TSample>
struct NearSample
{
  double squaredDistance;
  typename TSample::Id id;    // the lowest of coincident samples
  typename TSample::Id begin; // in tree order, ascending by id
  typename TSample::Id count;

  bool operator<(const NearSample& other) const
  {
    return this->squaredDistance != other.squaredDistance
             ? this->squaredDistance < other.squaredDistance
             : this->id < other.id;
  }
};

/// Finds the samples at the nearest positions to a place, in the order of distance, then of id.
/// They do not depend on the tree's refinement. Memory is kept. For one thread.
template <class TSample>
class NearestSamples
{
public:
  explicit NearestSamples(const SampleTree<TSample>& tree)
    : Tree(tree)
  {
  }

  /// O(count log count + log n) mostly.
  /// @param missing receives the nodes to split or to fetch, if any, before a search succeeds
  /// @returns whether found() has all
  bool search(const Vector& place, std::size_t count, std::vector<MissingNode>& missing)
  {
    this->Place = place;
    this->Count = count;
    this->Heap.clear();
    this->Missing = &missing;
    this->IsComplete = true;
    this->Bound = std::numeric_limits<double>::infinity();
    if (!this->Tree.isEmpty() && count > 0)
    {
      this->visit(rootNode, gapTo(this->Tree.region, place));
    }
    std::sort(this->Heap.begin(), this->Heap.end());
    return this->IsComplete;
  }

  const std::vector<NearSample<TSample>>& found() const { return this->Heap; }

private:
  /// @param gap from the place to the node's region, along each axis
  void visit(std::size_t nodeIndex, const Vector& gap)
  {
    const Node<TSample>& node = this->Tree.nodes[nodeIndex];
    if (node.isSplit() && !node.isBucket)
    {
      const double offset = this->Place[node.axis] - node.plane;
      const bool isUpper = offset > 0.0;
      this->visit(this->Tree.child(node, isUpper), gap);
      Vector far = gap;
      far[node.axis] = std::max(far[node.axis], std::abs(offset));
      if (dot(far, far) <= this->Bound)
      {
        this->visit(this->Tree.child(node, !isUpper), far);
      }
    }
    else if (node.isAbsent || !(node.isLeaf || node.isBucket))
    {
      this->miss(nodeIndex);
    }
    else if (node.isLeaf)
    {
      this->consider(this->Tree.samples[node.begin], node.begin, node.count());
    }
    else
    {
      for (std::size_t i = node.begin; i < node.end; ++i)
      {
        this->consider(this->Tree.samples[i], i, 1);
      }
    }
  }

  /// Until enough samples are known, the search ends here: it could miss the whole tree otherwise.
  void miss(std::size_t nodeIndex)
  {
    this->IsComplete = false;
    const bool isBounded = this->Bound < std::numeric_limits<double>::infinity();
    const double reach = isBounded ? std::sqrt(this->Bound) : 0.0;
    const Vector offset{ reach, reach, reach };
    this->Missing->push_back({ nodeIndex, { this->Place - offset, this->Place + offset } });
    this->Bound = isBounded ? this->Bound : -1.0;
  }

  void consider(const TSample& sample, std::size_t begin, std::size_t count)
  {
    using Id = typename TSample::Id;
    const Vector offset = positionOf(sample) - this->Place;
    const NearSample<TSample> near{ dot(offset, offset), sample.id, static_cast<Id>(begin),
      static_cast<Id>(count) };
    if (this->Heap.size() < this->Count)
    {
      this->Heap.push_back(near);
      if (this->Heap.size() == this->Count && this->IsComplete)
      {
        std::make_heap(this->Heap.begin(), this->Heap.end());
        this->Bound = this->Heap.front().squaredDistance;
      }
    }
    else if (near.squaredDistance <= this->Bound && near < this->Heap.front())
    {
      this->replaceFarthest(near);
      this->Bound = this->Heap.front().squaredDistance;
    }
  }

  void replaceFarthest(const NearSample<TSample>& near)
  {
    NearSample<TSample>* const heap = this->Heap.data();
    const std::size_t size = this->Heap.size();
    std::size_t at = 0;
    for (std::size_t child = 1; child < size; child = 2 * at + 1)
    {
      child += child + 1 < size && heap[child] < heap[child + 1] ? 1 : 0;
      if (!(near < heap[child]))
      {
        break;
      }
      heap[at] = heap[child];
      at = child;
    }
    heap[at] = near;
  }

  const SampleTree<TSample>& Tree;
  Vector Place{};
  std::size_t Count = 0;
  double Bound = 0.0;                    // squared distance within which samples may count
  bool IsComplete = true;                // whether no node was missing
  std::vector<NearSample<TSample>> Heap; // once full
  std::vector<MissingNode>* Missing = nullptr;
};

} // namespace isopoint
