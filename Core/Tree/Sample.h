// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Sample_h
#define isopoint_Sample_h

#include "Core/Base/Vector.h"

#include <cstdint>
#include <tuple>
#include <type_traits>

namespace isopoint
{

/// One sample as the tree holds it: all that building and searching need, in one place in memory.
/// Positions and values keep the input's type. The id identifies the sample in the input.
template <class TCoordinate, class TValue, class TId>
struct Sample
{
  using Coordinate = TCoordinate;
  using Value = TValue;
  using Id = TId;

  TCoordinate position[3];
  TId id;
  TValue value;
};

/// The layouts in use. Those with 32-bit ids serve clouds of fewer than 2^30 samples, since ids
/// also number the tree's nodes: two for each sample, and some that are reserved but never used.
/// Any cloud fits the wide layout, since float converts to double exactly.
using FloatSample = Sample<float, float, std::uint32_t>;
using FloatSampleOfDouble = Sample<float, double, std::uint32_t>;
using DoubleSampleOfFloat = Sample<double, float, std::uint32_t>;
using WideSample = Sample<double, double, std::uint64_t>;

static_assert(sizeof(FloatSample) == 20, "the commonest layout has no padding");

template <class TSample>
Vector positionOf(const TSample& sample)
{
  return { sample.position[0], sample.position[1], sample.position[2] };
}

template <class TSample>
bool haveOnePosition(const TSample& a, const TSample& b)
{
  return a.position[0] == b.position[0] && a.position[1] == b.position[1] &&
         a.position[2] == b.position[2];
}

/// The strict total order in which a node's samples are halved: by the coordinate on `axis`, then
/// on the two axes that follow it cyclically, then by id.
template <class TSample>
struct SplittingOrder
{
  explicit SplittingOrder(int axis)
    : First(axis)
    , Second((axis + 1) % 3)
    , Third((axis + 2) % 3)
  {
  }

  bool operator()(const TSample& a, const TSample& b) const
  {
    const auto keyOf = [this](const TSample& sample)
    {
      return std::tuple(sample.position[this->First], sample.position[this->Second],
        sample.position[this->Third], sample.id);
    };
    return keyOf(a) < keyOf(b);
  }

  int First;
  int Second;
  int Third;
};

} // namespace isopoint

#endif
