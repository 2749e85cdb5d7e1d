// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "BruteForce.h"

#include "Core/Extraction/Isosurface.h"

#include <gtest/gtest.h>

/// Shared by the tests that compare isopoints with brute force.
namespace isopointtesting
{

/// Expects the same edges in the same order and, bit for bit, the same parameters.
/// @tparam TIsopoint a point by brute force, or an edge
template <class TIsopoint>
void expectSameIsopoints(
  const std::vector<TIsopoint>& expected, const std::vector<isopoint::IsopointEdge>& found)
{
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    ASSERT_EQ(expected[i].first, found[i].first) << "isopoint " << i;
    ASSERT_EQ(expected[i].second, found[i].second) << "isopoint " << i;
    ASSERT_EQ(0, std::memcmp(&expected[i].parameter, &found[i].parameter, sizeof(double)))
      << "isopoint " << i;
  }
}

} // namespace isopointtesting
