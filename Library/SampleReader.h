// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Contour.h"
#include "Core/Failure.h"
#include "Library/Arrays.h"
#include "Library/Places.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace isopoint
{

/// Reads samples from arrays for IsosurfaceExtractor::load().
class SampleReader
{
public:
  /// @param values null: all are 0
  /// @param excluded null, or bytes that are not 0 for samples to skip
  /// @throws UsageError if the arrays do not fit together
  SampleReader(
    const isopoint_array* positions, const isopoint_array* values, const isopoint_array* excluded)
    : Positions(positions, "positions")
  {
    this->Positions.require(this->Positions.count(), 3);
    if (values)
    {
      this->Values.emplace(values, "values");
      this->Values->require(this->Positions.count(), 1);
    }
    this->Positions.requireFloatingPoint();
    if (excluded)
    {
      this->Excluded.emplace(excluded, "excluded samples");
      this->Excluded->require(this->Positions.count(), 1);
      if (this->Excluded->type() != ISOPOINT_UINT8)
      {
        throw UsageError(
          "The array of excluded samples is not of bytes. Pass ISOPOINT_UINT8.", UsageError::Array);
      }
    }
  }

  std::size_t count() const { return this->Positions.count(); }

  SampleTypes types() const
  {
    SampleTypes types;
    const std::int32_t type = this->Values ? this->Values->type() : ISOPOINT_FLOAT;
    types.areFloatPositions = this->Positions.type() == ISOPOINT_FLOAT;
    types.areFloatValues = type == ISOPOINT_FLOAT || sizeOfType(type) <= 2;
    types.areIntegers = !isFloatingPoint(type);
    return types;
  }

  CloudCounts counts() const
  {
    CloudCounts counts;
    counts.items = this->count();
    for (std::size_t id = 0; this->Excluded && id < this->count(); ++id)
    {
      counts.excluded += this->isExcluded(id) ? 1 : 0;
    }
    return counts;
  }

  /// @param count of the samples that the tree left out. @throws std::bad_alloc
  SkippedItems skippedItems(std::size_t count) const
  {
    if (count == 0)
    {
      return nullptr;
    }
    std::vector<bool> items(this->count());
    for (std::size_t id = 0; id < items.size(); ++id)
    {
      Vector position;
      double value = 0.0;
      items[id] =
        !(*this)(id, position.data(), value) || !isFinite(position) || !std::isfinite(value);
    }
    return std::make_shared<const std::vector<bool>>(std::move(items));
  }

  template <class TCoordinate, class TValue>
  bool operator()(std::size_t id, TCoordinate* position, TValue& value) const
  {
    if (this->isExcluded(id))
    {
      return false;
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      position[axis] = static_cast<TCoordinate>(this->Positions.at(id, axis));
    }
    value = static_cast<TValue>(this->Values ? this->Values->at(id, 0) : 0.0);
    return true;
  }

private:
  bool isExcluded(std::size_t id) const
  {
    return this->Excluded && this->Excluded->at<std::uint8_t>(id, 0) != 0;
  }

  ArrayReader Positions;
  std::optional<ArrayReader> Values;
  std::optional<ArrayReader> Excluded;
};

} // namespace isopoint
