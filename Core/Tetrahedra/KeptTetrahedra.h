// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/ConcurrentMemo.h"
#include "Core/Base/Execution.h"
#include "Core/Base/Region.h"
#include "Core/Tetrahedra/PartialTriangulation.h"
#include "Core/Tree/NodeMarks.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

namespace isopoint
{

/// The tetrahedralization of the samples near the last surface, and what tree searches found:
/// certified cells, searched regions. It serves any isovalue and any values at the same positions.
struct KeptTetrahedra
{
  explicit KeptTetrahedra(const CoordinateUnit& unit)
    : triangulation(unit)
  {
  }

  /// Whether it is worth keeping between extractions, beside a tree of this many samples. A sample
  /// here takes 700 bytes, as much as about 30 in the tree.
  bool isSmall(std::size_t sampleCount) const
  {
    constexpr std::size_t minRatio = 8;
    constexpr std::size_t alwaysSmall = 500000;
    return this->triangulation.size() <= std::max(alwaysSmall, sampleCount / minRatio);
  }

  PartialTriangulation triangulation;
  NodeMarks marks;              // see nodemarks
  ConcurrentMemo<Region> boxes; // see SphereSearch
  bool isWhole = false;         // whether all samples are in it
  bool isUnlimited = false;     // whether those of all samples are known to be within the limit
};

/// Sets a pointer to null. @throws Aborted, after which it is null, too
inline void dropTetrahedra(const Execution& execution, std::unique_ptr<KeptTetrahedra>& kept)
{
  if (const auto dropped = std::move(kept))
  {
    dropped->triangulation.clear(execution);
  }
}

} // namespace isopoint
