// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"

#include <cstdint>
#include <tuple>
#include <type_traits>

namespace isopoint
{

/// One sample in the tree, with all data for building and searching. Positions and values keep the
/// input's type; the id is the sample's number in the input.
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

/// The layouts in use. Those with 32-bit ids hold fewer than 2^30 samples, since ids also number
/// nodes: two for each sample, and some that are reserved but unused. WideSample holds any cloud,
/// since float converts to double exactly.
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

/// The strict total order on an axis: by this coordinate, the next two cyclically, then id.
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
