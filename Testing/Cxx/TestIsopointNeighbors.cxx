// SPDX-License-Identifier: GPL-3.0-or-later
// The isopoints around each: those whose edges end in leaves that touch the ends of its own.
#include "Clouds.h"

#include "Isopoint/Extraction/ExtractIsosurface.h"
#include "Isopoint/Extraction/IsopointNeighbors.h"
#include "Isopoint/Tree/Loading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

namespace
{

using TSample = isopoint::WideSample;
using Cache = isopoint::NeighborhoodCache<TSample::Id>;

bool doTouch(const isopoint::Region& a, const isopoint::Region& b)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (a.lower[axis] > b.upper[axis] || b.lower[axis] > a.upper[axis])
    {
      return false;
    }
  }
  return true;
}

/// A surface, and the tree that it was extracted from.
struct Extracted
{
  isopoint::SampleTree<TSample> tree;
  Cache known;
  isopoint::Isosurface surface;

  explicit Extracted(const clouds::Cloud& cloud)
    : tree(isopoint::loadSamples<TSample>(
        clouds::executionOn(1), cloud.size(), clouds::readerOf(cloud)))
  {
    isopoint::IsosurfaceRequest request{};
    request.isovalue = 0.3;
    request.angle = isopoint::defaultAngle;
    const isopoint::Execution execution = clouds::executionOn(1);
    isopoint::WorkProgress progress(execution);
    this->surface = isopoint::extractIsosurface(
      execution, this->tree, this->known, cloud.size(), request, progress, 0.0);
  }

  /// By comparing the regions of all leaves.
  std::set<std::size_t> around(std::size_t isopoint) const
  {
    const auto regionOf = [this](std::size_t leaf)
    { return isopoint::pathToLeaf(this->tree, leaf).region; };
    std::set<std::size_t> found;
    const isopoint::EdgeLeaves& own = this->surface.leaves[isopoint];
    for (std::size_t i = 0; i < this->surface.size(); ++i)
    {
      for (const std::size_t end :
        { this->surface.leaves[i].first, this->surface.leaves[i].second })
      {
        if (doTouch(regionOf(end), regionOf(own.first)) ||
            doTouch(regionOf(end), regionOf(own.second)))
        {
          found.insert(i);
        }
      }
    }
    return found;
  }
};

} // namespace

TEST(IsopointNeighbors, EndInTouchingLeaves)
{
  for (const clouds::Cloud& cloud : { clouds::uniform(1500, 4), clouds::lattice(10, 11, 12),
         clouds::coincident(clouds::uniform(1500, 5), 0.1) })
  {
    const Extracted extracted(cloud);
    ASSERT_GT(extracted.surface.size(), 100u);
    // Neighborhoods are searched for where they are not known.
    const Cache none;
    for (const Cache* const known : { &extracted.known, &none })
    {
      const isopoint::IsopointNeighbors<TSample> neighbors(
        clouds::executionOn(2), extracted.tree, *known, extracted.surface.leaves);
      isopoint::IsopointNeighbors<TSample>::Finder finder(neighbors);
      std::vector<std::size_t> found;
      for (std::size_t i = 0; i < extracted.surface.size(); i += 7)
      {
        const std::set<std::size_t> expected = extracted.around(i);
        finder.find(i, 1, found);
        EXPECT_EQ(std::set<std::size_t>(found.begin(), found.end()), expected) << i;
        std::set<std::size_t> wider;
        for (const std::size_t other : expected)
        {
          const std::set<std::size_t> more = extracted.around(other);
          wider.insert(more.begin(), more.end());
        }
        if (i % 5 == 0)
        {
          finder.find(i, 2, found);
          EXPECT_EQ(std::set<std::size_t>(found.begin(), found.end()), wider) << i;
        }
      }
      std::vector<std::size_t> order = neighbors.inOrder();
      std::sort(order.begin(), order.end());
      ASSERT_EQ(order.size(), extracted.surface.size());
      for (std::size_t i = 0; i < order.size(); ++i)
      {
        ASSERT_EQ(order[i], i);
      }
    }
  }
}

// Cells on three lines, each of which touches hundreds of those on the others.
TEST(IsopointNeighbors, OfLeavesThatTouchVeryManyAreFew)
{
  const Extracted extracted(clouds::lines(6000, 3, 0, 5));
  ASSERT_GT(extracted.surface.size(), 300u);
  const isopoint::IsopointNeighbors<TSample> neighbors(
    clouds::executionOn(2), extracted.tree, extracted.known, extracted.surface.leaves);
  isopoint::IsopointNeighbors<TSample>::Finder finder(neighbors);
  std::vector<std::size_t> found;
  std::size_t most = 0;
  std::size_t lonely = 0;
  for (std::size_t i = 0; i < extracted.surface.size(); ++i)
  {
    finder.find(i, 1, found);
    lonely += found.size() < 4 ? 1 : 0;
    finder.find(i, 2, found);
    most = std::max(most, found.size());
  }
  EXPECT_LT(most, 2304u);
  EXPECT_LT(lonely, extracted.surface.size() / 2);
}
