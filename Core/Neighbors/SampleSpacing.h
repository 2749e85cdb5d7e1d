// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"
#include "Core/Neighbors/NearestSample.h"
#include "Core/Tree/SampleTree.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace isopoint
{

/// Whether a sample in a ball, or on its boundary, is of a kind.
template <class TSample, class Kind>
class AnyInBallSearch : public BallSearch<TSample>
{
public:
  /// @param isOfKind of the sample's offset from the center
  AnyInBallSearch(
    const SampleTree<TSample>& tree, const Vector& center, double radius, const Kind& isOfKind)
    : BallSearch<TSample>(tree, center, radius)
    , IsOfKind(isOfKind)
  {
  }

  /// O(log n) mostly. @throws MissingNode at a node whose samples another rank holds
  bool hasAny()
  {
    return searchRegion(this->Tree, rootNode, this->needed(this->Tree.region), *this);
  }

  bool add(std::size_t nodeIndex) const
  {
    const Node<TSample>& node = this->Tree.nodes[nodeIndex];
    const auto first = this->Tree.samples.data() + node.begin;
    return std::any_of(first, first + (node.positionsEnd() - node.begin),
      [this](const TSample& sample)
      {
        const Vector offset = positionOf(sample) - this->Center;
        return lengthOf(offset) <= this->Radius && this->IsOfKind(offset);
      });
  }

private:
  const Kind IsOfKind;
};

/// Distances from a sample to others.
struct SampleSpacing
{
  double nearest; // to the nearest other position
  double tenth;   // to the tenth nearest one; infinite if there are fewer
};

/// Finds the spacing of the samples around one of them.
template <class TSample>
class SpacingSearch : public BallSearch<TSample>
{
public:
  SpacingSearch(const SampleTree<TSample>& tree, const TSample& sample)
    : BallSearch<TSample>(tree, positionOf(sample), std::numeric_limits<double>::infinity())
    , Sample(sample)
  {
  }

  /// O(log n) mostly. @throws MissingNode at a node whose samples another rank holds
  SampleSpacing find()
  {
    searchRegion(this->Tree, rootNode, this->Tree.region, *this);
    return { this->Nearest.front().distance, this->Radius };
  }

  bool add(std::size_t nodeIndex)
  {
    const Node<TSample>& node = this->Tree.nodes[nodeIndex];
    for (std::size_t i = node.begin; i < node.positionsEnd(); ++i)
    {
      const TSample& sample = this->Tree.samples[i];
      const double distance = lengthOf(positionOf(sample) - this->Center);
      if (distance < this->Radius && !this->isKnown(sample))
      {
        this->insert({ distance, &sample });
      }
    }
    return false;
  }

private:
  static constexpr std::size_t wantedCount = 10;

  struct Near
  {
    double distance;
    const TSample* sample;
  };

  bool isKnown(const TSample& sample) const
  {
    return haveOnePosition(sample, this->Sample) ||
           std::any_of(this->Nearest.data(), this->Nearest.data() + this->Count,
             [&](const Near& near) { return haveOnePosition(*near.sample, sample); });
  }

  void insert(const Near& near)
  {
    std::size_t i = this->Count < wantedCount ? this->Count++ : wantedCount - 1;
    for (; i > 0 && near.distance < this->Nearest[i - 1].distance; --i)
    {
      this->Nearest[i] = this->Nearest[i - 1];
    }
    this->Nearest[i] = near;
    if (this->Count == wantedCount)
    {
      this->Radius = this->Nearest.back().distance;
    }
  }

  const TSample& Sample;
  std::array<Near, wantedCount> Nearest; // ascending
  std::size_t Count = 0;
};

} // namespace isopoint
