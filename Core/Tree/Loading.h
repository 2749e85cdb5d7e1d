// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Hash.h"
#include "Core/Base/Region.h"
#include "Core/Tree/Path.h"
#include "Core/Tree/SampleTree.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace isopoint
{

template <class TSample>
bool isFinite(const TSample& sample)
{
  return isFinite(positionOf(sample)) && std::isfinite(sample.value);
}

/// Summary of the samples read from a slice of the input.
template <class TSample>
struct SliceSummary
{
  using Value = typename TSample::Value;

  std::size_t kept = 0;
  Region region = emptyRegion; // of the kept samples
  Value minimum = std::numeric_limits<Value>::infinity();
  Value maximum = -std::numeric_limits<Value>::infinity();

  void add(const TSample& sample)
  {
    ++this->kept;
    const Vector position = positionOf(sample);
    this->region = united(this->region, { position, position });
    this->minimum = std::min(this->minimum, sample.value);
    this->maximum = std::max(this->maximum, sample.value);
  }
};

/// Reads the items [begin, end) into samples[begin] and following, without gaps.
template <class TSample, class Reader>
SliceSummary<TSample> loadSlice(
  TSample* samples, std::size_t begin, std::size_t end, const Reader& read, std::uint64_t firstId)
{
  SliceSummary<TSample> summary;
  TSample* next = samples + begin;
  for (std::size_t id = begin; id < end; ++id)
  {
    next->id = static_cast<typename TSample::Id>(firstId + id);
    if (read(id, next->position, next->value) && isFinite(*next))
    {
      summary.add(*next++);
    }
  }
  return summary;
}

/// Creates the root of a tree whose samples are loaded.
template <class TSample>
void makeRoot(SampleTree<TSample>& tree, const std::vector<SliceSummary<TSample>>& slices)
{
  SliceSummary<TSample> all;
  for (const SliceSummary<TSample>& slice : slices)
  {
    all.region = united(all.region, slice.region);
    all.minimum = std::min(all.minimum, slice.minimum);
    all.maximum = std::max(all.maximum, slice.maximum);
  }
  tree.region = all.region;
  Node<TSample>& root = tree.nodes[rootNode];
  root = makeNode<TSample>(0, tree.samples.size());
  root.minimum = all.minimum;
  root.maximum = all.maximum;
}

/// Creates a tree of only a root from an input of `count` items, each read once.
/// @param read(id, position, value) writes an item's coordinates and value; returns false to leave
/// it out. Items with a non-finite coordinate or value are left out as well
/// @param firstId id of the first item's sample
/// @throws std::bad_alloc, Aborted
template <class TSample, class Reader>
SampleTree<TSample> loadSamples(
  const Execution& execution, std::size_t count, const Reader& read, std::uint64_t firstId = 0)
{
  SampleTree<TSample> tree;
  tree.samples.resize(count);
  tree.nodes.resize(2);
  tree.usedPairs = 1;

  // Slices are packed on their own; the gaps between them are closed afterwards.
  constexpr std::size_t sliceLength = std::size_t{ 1 } << 16;
  const std::size_t sliceCount = (count + sliceLength - 1) / sliceLength;
  std::vector<SliceSummary<TSample>> slices(sliceCount);
  forBatches(
    execution, sliceCount, 4, 1,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t slice = begin; slice < end; ++slice)
      {
        slices[slice] = loadSlice(tree.samples.data(), slice * sliceLength,
          std::min((slice + 1) * sliceLength, count), read, firstId);
      }
    },
    execution.progress);

  std::size_t size = 0;
  for (std::size_t slice = 0; slice < sliceCount; ++slice)
  {
    if (size != slice * sliceLength)
    {
      throwIfAborted(execution);
      std::memmove(tree.samples.data() + size, tree.samples.data() + slice * sliceLength,
        slices[slice].kept * sizeof(TSample));
    }
    size += slices[slice].kept;
  }
  tree.samples.resize(size);
  tree.samples.shrinkToFit();
  tree.skipped = count - size;
  if (size > 0)
  {
    makeRoot(tree, slices);
  }
  return tree;
}

/// Recomputes the value ranges of a node and its descendants, `levels` levels down: from children,
/// or from samples where nodes are not split.
template <class TSample>
void recomputeRanges(SampleTree<TSample>& tree, Node<TSample>& node, int levels)
{
  if (levels == 0)
  {
    return;
  }
  if (!node.isSplit())
  {
    computeRange(node, tree.samples.data());
    return;
  }
  Node<TSample>& lower = tree.nodes[node.lowerNode()];
  Node<TSample>& upper = tree.nodes[node.upperNode()];
  recomputeRanges(tree, lower, levels - 1);
  recomputeRanges(tree, upper, levels - 1);
  uniteRanges(node, lower, upper);
}

/// An item's contribution to a hash.
template <class TCoordinate>
std::uint64_t hashOfItem(std::uint64_t id, const TCoordinate* position)
{
  std::uint64_t hash = id;
  for (int axis = 0; axis < 3; ++axis)
  {
    hash = extendedHash(hash, bitsOf(static_cast<double>(position[axis])));
  }
  return hash;
}

/// A hash of the ids and positions of the items in use, among 0 .. count - 1. Different inputs
/// have equal hashes with a probability of 2^-64.
/// @param hashAt(i) the item's contribution, 0 if it is left out
/// @throws Aborted
template <class HashAt>
std::uint64_t hashOfAll(const Execution& execution, std::size_t count, const HashAt& hashAt)
{
  constexpr std::size_t grain = 1 << 14;
  std::atomic<std::uint64_t> sum{ 0 };
  forBatches(execution, count, 16 * grain, grain,
    [&](std::size_t begin, std::size_t end)
    {
      std::uint64_t part = 0;
      for (std::size_t i = begin; i < end; ++i)
      {
        part += hashAt(i);
      }
      sum += part;
    });
  return sum;
}

/// The hash of loaded samples.
/// @param firstId as for loadSamples()
template <class TSample>
std::uint64_t hashOfSamples(
  const Execution& execution, const RawArray<TSample>& samples, std::uint64_t firstId)
{
  return hashOfAll(execution, samples.size(),
    [&](std::size_t i) { return hashOfItem(samples[i].id - firstId, samples[i].position); });
}

/// The hash of items as loadSamples() reads them.
template <class TSample, class Reader>
std::uint64_t hashOfItems(const Execution& execution, std::size_t count, const Reader& read)
{
  return hashOfAll(execution, count,
    [&](std::size_t id) -> std::uint64_t
    {
      TSample sample;
      const bool takesPart = read(id, sample.position, sample.value) && isFinite(sample);
      return takesPart ? hashOfItem(id, sample.position) : 0;
    });
}

/// Sets new values of a tree's samples and the nodes' value ranges. The tree's shape stays.
/// @param read as for loadSamples(); the hash of its items must equal that of the samples
/// @throws Aborted, after which some values are new
template <class TSample, class Reader>
void replaceValues(const Execution& execution, SampleTree<TSample>& tree, const Reader& read)
{
  constexpr std::size_t grain = 1 << 14;
  forBatches(execution, tree.samples.size(), 16 * grain, grain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        typename TSample::Coordinate position[3];
        read(tree.samples[i].id, position, tree.samples[i].value);
      }
    });
  if (tree.isEmpty())
  {
    return;
  }
  constexpr int topLevels = 8;
  std::vector<std::size_t> tops;
  Path path = pathToRoot(tree);
  forEachBelow(
    tree, path, topLevels, [&tops](const Path& top) { tops.push_back(top.nodeIndex()); });
  forRanges(execution, tops.size(), 1,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        recomputeRanges(tree, tree.nodes[tops[i]], maximumDepth + 1);
      }
    });
  recomputeRanges(tree, tree.nodes[rootNode], topLevels);
}

} // namespace isopoint
