// SPDX-License-Identifier: GPL-3.0-or-later
// The isopoints around each: those whose edges end in leaves around its own edge.
#include "BruteForce.h"

#include "Core/Extraction/ExtractIsosurface.h"
#include "Core/Extraction/IsopointNeighbors.h"
#include "Core/Extraction/SingleRank.h"
#include "Core/Tree/Loading.h"

#include <gtest/gtest.h>

namespace
{

using TSample = isopoint::WideSample;
using Cache = isopoint::NeighborhoodCache<TSample::Id>;

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
    isopoint::SingleRank<TSample> rank(this->tree);
    this->surface =
      isopoint::extractIsosurface({}, this->tree, rank, this->known, cloud.size(), { 0.3 });
    for (const isopoint::EdgeLeaves& leaves : this->surface.leaves)
    {
      this->Ends.push_back({ leaves.first, leaves.second });
    }
  }

  using Isopoints = std::set<std::size_t>;

  /// The isopoints with an end in a leaf or in one that touches it, by comparing all regions.
  Isopoints around(std::size_t leaf) const
  {
    const auto touches = [&](std::size_t end)
    {
      return bruteforce::touch(isopoint::pathToNode(this->tree, end).region,
        isopoint::pathToNode(this->tree, leaf).region);
    };
    Isopoints found;
    for (std::size_t i = 0; i < this->surface.size(); ++i)
    {
      if (touches(this->Ends[i][0]) || touches(this->Ends[i][1]))
      {
        found.insert(i);
      }
    }
    return found;
  }

  /// Those in so many rings around an isopoint.
  Isopoints inRings(std::size_t isopoint, int rings) const
  {
    Isopoints found; // first those whose edges begin in the same leaf
    for (std::size_t i = 0; i < this->surface.size(); ++i)
    {
      if (this->Ends[i][0] == this->Ends[isopoint][0])
      {
        found.insert(i);
      }
    }
    for (int ring = 1; ring <= rings; ++ring)
    {
      std::set<std::size_t> ends;
      for (const std::size_t other : found)
      {
        ends.insert(this->Ends[other].begin(), this->Ends[other].end());
      }
      for (const std::size_t end : ends)
      {
        found.merge(this->around(end));
      }
    }
    return found;
  }

private:
  std::vector<std::array<std::size_t, 2>> Ends; // of the isopoints' edges, leaves
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
      for (std::size_t i = 0; i < extracted.surface.size(); i += 35)
      {
        for (const int rings : { 1, 3, 2 })
        {
          const auto found = finder.find(i, rings);
          const Extracted::Isopoints each(found.begin(), found.end());
          EXPECT_EQ(each.size(), found.count) << i;
          EXPECT_EQ(each, extracted.inRings(i, rings)) << i << " in " << rings;
        }
      }
    }
  }
}

TEST(IsopointNeighbors, AreInTheOrderOfLeaves)
{
  const std::vector<isopoint::EdgeLeaves> leaves{ { 4, 2 }, { 0, 4 }, { 3, 1 }, { 0, 1 } };
  EXPECT_EQ(isopoint::inOrderOfLeaves({}, leaves, 5), (std::vector<std::size_t>{ 1, 3, 2, 0 }));
}

// Cells on three lines, each of which touches hundreds of those on the others.
TEST(IsopointNeighbors, OfLeavesThatTouchVeryManyAreFew)
{
  const Extracted extracted(clouds::lines(6000, 3, 0, 5));
  ASSERT_GT(extracted.surface.size(), 300u);
  const isopoint::IsopointNeighbors<TSample> neighbors(
    clouds::executionOn(2), extracted.tree, extracted.known, extracted.surface.leaves);
  isopoint::IsopointNeighbors<TSample>::Finder finder(neighbors);
  std::size_t most = 0;
  std::size_t lonely = 0;
  for (std::size_t i = 0; i < extracted.surface.size(); ++i)
  {
    lonely += finder.find(i, 1).count < 4 ? 1 : 0;
    most = std::max(most, finder.find(i, 2).count);
  }
  EXPECT_LT(most, 2304u);
  EXPECT_LT(lonely, extracted.surface.size() / 2);
}
