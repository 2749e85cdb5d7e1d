// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Band_h
#define isopoint_Band_h

#include "Core/Tetrahedra/BandTriangulation.h"
#include "Core/Tree/NodeMarks.h"

#include <algorithm>
#include <cstddef>

namespace isopoint
{

/// The samples near a surface, tetrahedrized, and what searches of the tree have shown: which
/// tetrahedra are empty, and where the samples are that have been looked at. All of it holds for
/// any isovalue and any values, as long as the samples stay where they are.
struct Band
{
  explicit Band(const CoordinateUnit& unit)
    : triangulation(unit)
  {
  }

  /// Whether it is worth its memory between extractions, where a tree of this many samples is kept:
  /// a sample of the band takes about as much as 30 of the tree, 700 bytes.
  bool isSmall(std::size_t sampleCount) const
  {
    constexpr std::size_t leastRatio = 8;
    constexpr std::size_t alwaysSmall = 500000;
    return this->triangulation.size() <= std::max(alwaysSmall, sampleCount / leastRatio);
  }

  BandTriangulation triangulation;
  NodeMarks marks;      // see bandmarks
  bool isWhole = false; // whether all samples are in it
};

} // namespace isopoint

#endif
