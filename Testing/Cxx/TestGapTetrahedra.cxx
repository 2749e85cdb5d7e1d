// SPDX-License-Identifier: GPL-3.0-or-later
// The crossing tetrahedra in gaps: against a search of CGAL's tetrahedrization, and against clouds
// with and without gaps.
#include "BruteForce.h"
#include "RandomClouds.h"
#include "TriangleTesting.h"

#include "Core/Triangles/GapTetrahedra.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <random>
#include <vector>

namespace
{

using clouds::Cloud;
using clouds::Random;
using triangles::Corners;

/// The corners of the tetrahedra in gaps, ordered.
std::vector<Corners> foundInGaps(const Cloud& cloud, double isovalue, std::size_t threads = 1)
{
  using TSample = isopoint::WideSample;
  const isopoint::Execution execution = clouds::executionOn(threads);
  auto tree = isopoint::loadSamples<TSample>(execution, cloud.size(), clouds::readerOf(cloud));
  const isopoint::NeighborhoodCache<TSample::Id> none;
  isopoint::IsosurfaceRequest request;
  request.isovalue = isovalue;
  isopoint::SingleRank<TSample> rank(tree);
  std::unique_ptr<isopoint::Band> band;
  isopoint::TriangleExtraction<TSample, isopoint::SingleRank<TSample>> extraction(
    execution, tree, rank, none, band, request);
  auto tetrahedra = extraction.tetrahedra(execution);
  const std::vector<char> isInGap =
    isopoint::GapTetrahedraFinder<TSample, isopoint::SingleRank<TSample>>(
      execution, tree, rank, tetrahedra)
      .find();
  std::size_t count = 0;
  for (std::size_t i = 0; i < tetrahedra.size(); ++i)
  {
    if (isInGap[i])
    {
      tetrahedra[count++] = tetrahedra[i];
    }
  }
  tetrahedra.resize(count);
  return triangles::cornersOf(tree, tetrahedra);
}

/// A crossing tetrahedron of the whole tetrahedrization.
struct Tetrahedron
{
  Corners corners;
  std::vector<std::size_t> neighbors; // across crossing facets
  bool isAtHull = false;              // has a crossing facet there
  bool isWeak = false;                // has an edge over the weak criterion, or leaving the body
  bool isStrong = false;
};

/// Whether the edge {x, y} leaves the body at x.
bool leavesBody(const std::vector<bruteforce::Cell>& cells, std::size_t x, std::size_t y)
{
  return bruteforce::isCrowded(cells, y, x, 2.0, 2) &&
         bruteforce::isCrowded(cells, x, y, 4.0, 3, 0.0) &&
         !bruteforce::isCrowded(cells, x, y, 0.5, 2);
}

std::vector<Tetrahedron> allTetrahedra(const Cloud& cloud, double isovalue)
{
  const std::vector<triangles::Site> sites = triangles::sitesOf(cloud);
  const triangles::FullTetrahedrization full = triangles::fullTetrahedrization(sites);
  const bruteforce::Tree tree(cloud);
  std::map<std::uint64_t, std::size_t> cellOf; // by id
  for (std::size_t i = 0; i < tree.cells.size(); ++i)
  {
    cellOf[tree.cells[i].id] = i;
  }
  // Of the finite corners but one.
  const auto isCrossing = [&](const auto& cell, int without)
  {
    int below = 0;
    int finite = 0;
    for (int i = 0; i < 4; ++i)
    {
      if (i != without && !full.is_infinite(cell->vertex(i)))
      {
        ++finite;
        below += sites[cell->vertex(i)->info()].value < isovalue ? 1 : 0;
      }
    }
    return below > 0 && below < finite;
  };
  std::vector<Tetrahedron> result;
  if (full.dimension() < 3)
  {
    return result;
  }
  std::map<triangles::FullTetrahedrization::Cell_handle, std::size_t> numberOf;
  for (const auto cell : full.finite_cell_handles())
  {
    if (isCrossing(cell, -1))
    {
      numberOf.emplace(cell, numberOf.size());
    }
  }
  result.resize(numberOf.size());
  for (const auto& [cell, number] : numberOf)
  {
    Tetrahedron& tetrahedron = result[number];
    for (int i = 0; i < 4; ++i)
    {
      tetrahedron.corners[static_cast<std::size_t>(i)] = sites[cell->vertex(i)->info()].id;
      if (isCrossing(cell, i))
      {
        if (full.is_infinite(cell->neighbor(i)))
        {
          tetrahedron.isAtHull = true;
        }
        else
        {
          tetrahedron.neighbors.push_back(numberOf.at(cell->neighbor(i)));
        }
      }
    }
    std::sort(tetrahedron.corners.begin(), tetrahedron.corners.end());
    for (std::size_t i = 0; i < 4; ++i)
    {
      for (std::size_t j = i + 1; j < 4; ++j)
      {
        const std::size_t x = cellOf.at(tetrahedron.corners[i]);
        const std::size_t y = cellOf.at(tetrahedron.corners[j]);
        tetrahedron.isWeak |= bruteforce::isDroppedByGap(tree.cells, x, y, 2.0, 2) ||
                              leavesBody(tree.cells, x, y) || leavesBody(tree.cells, y, x);
        tetrahedron.isStrong |= bruteforce::isDroppedByGap(tree.cells, x, y, 4.0, 3);
      }
    }
  }
  return result;
}

/// Numbers pieces: tetrahedra of one kind that hang together have one number, others none (-1).
template <class Kind>
std::vector<int> piecesOf(const std::vector<Tetrahedron>& all, const Kind& isOfKind)
{
  std::vector<int> pieces(all.size(), -1);
  int count = 0;
  for (std::size_t first = 0; first < all.size(); ++first)
  {
    if (pieces[first] >= 0 || !isOfKind(first))
    {
      continue;
    }
    std::vector<std::size_t> open{ first };
    pieces[first] = count;
    while (!open.empty())
    {
      const std::size_t i = open.back();
      open.pop_back();
      for (const std::size_t neighbor : all[i].neighbors)
      {
        if (pieces[neighbor] < 0 && isOfKind(neighbor))
        {
          pieces[neighbor] = count;
          open.push_back(neighbor);
        }
      }
    }
    ++count;
  }
  return pieces;
}

/// The rule of docs/triangles.md, piece by piece.
std::vector<Corners> expectedInGaps(const Cloud& cloud, double isovalue)
{
  const std::vector<Tetrahedron> all = allTetrahedra(cloud, isovalue);
  const std::vector<int> weak = piecesOf(all, [&](std::size_t i) { return all[i].isWeak; });
  std::vector<bool> isGap(all.size(), false); // by piece
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (weak[i] >= 0 && (all[i].isStrong || all[i].isAtHull))
    {
      isGap[static_cast<std::size_t>(weak[i])] = true;
    }
  }
  const auto isInGap = [&](std::size_t i)
  { return weak[i] >= 0 && isGap[static_cast<std::size_t>(weak[i])]; };
  const std::vector<int> kept = piecesOf(all, [&](std::size_t i) { return !isInGap(i); });
  std::map<int, std::size_t> sizes;
  std::map<int, bool> bordersOnGap;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    ++sizes[kept[i]];
    for (const std::size_t neighbor : all[i].neighbors)
    {
      bordersOnGap[kept[i]] |= isInGap(neighbor);
    }
  }
  std::vector<Corners> result;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (isInGap(i) || (bordersOnGap[kept[i]] && sizes[kept[i]] < 8))
    {
      result.push_back(all[i].corners);
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// Values become a distance, or the like.
template <class Field>
Cloud withField(Cloud cloud, const Field& field)
{
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const double* const p = cloud.positions.data() + 3 * i;
    cloud.values[i] = field(p[0], p[1], p[2]);
  }
  return cloud;
}

double fromMiddle(double x, double y, double z)
{
  return std::hypot(x - 0.5, y - 0.5, z - 0.5);
}

double fromRing(double x, double y, double z)
{
  return std::hypot(std::hypot(x - 0.5, y - 0.5) - 0.3, z - 0.5);
}

/// Blades of random samples with void between them, joined along one side.
Cloud comb(std::size_t count, std::uint64_t seed)
{
  const Cloud cube = clouds::uniform(count, seed);
  Cloud result;
  for (std::size_t i = 0; i < cube.size(); ++i)
  {
    const double* const p = cube.positions.data() + 3 * i;
    if (p[0] < 0.2 || std::fmod(p[1], 0.4) < 0.2)
    {
      result.add(p[0], p[1], p[2], p[2]);
    }
  }
  return result;
}

} // namespace

TEST(GapTetrahedra, AreThoseOfTheDefinition)
{
  const auto expectSame = [](const Cloud& cloud, double isovalue)
  {
    const std::vector<Corners> expected = expectedInGaps(cloud, isovalue);
    EXPECT_TRUE(foundInGaps(cloud, isovalue) == expected);
    return expected.size();
  };
  EXPECT_GT(expectSame(comb(3000, 1), 0.5), 100u);
  expectSame(clouds::clustered(1500, 2), -4.0);
  EXPECT_GT(expectSame(clouds::lines(1500, 20, 0, 3), 0.3), 0u);
  expectSame(clouds::uniform(2000, 4), 0.3);
  expectSame(clouds::lattice(10, 11, 12), 2.0);
  expectSame(clouds::coincident(clouds::uniform(1000, 5), 0.6), 0.3);
  std::size_t all = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed)
  {
    SCOPED_TRACE(seed);
    clouds::Dice dice(seed);
    const Cloud cloud = clouds::randomCloud(dice, seed);
    all += cloud.size() == 0 ? 0 : expectSame(cloud, cloud.values[dice(cloud.size())]);
  }
  EXPECT_GT(all, 100u);
}

TEST(GapTetrahedra, AreNoneOfClosedSurfacesAmidSamples)
{
  for (const std::size_t count : { 20000, 200000 })
  {
    const Cloud cloud = clouds::uniform(count, 6);
    EXPECT_TRUE(foundInGaps(withField(cloud, fromMiddle), 0.35, 2).empty());
    EXPECT_TRUE(foundInGaps(withField(cloud, fromRing), 0.1, 2).empty());
    Cloud normal;
    std::mt19937_64 random(7);
    std::normal_distribution<double> distribution;
    for (std::size_t i = 0; i < count; ++i)
    {
      const double x = distribution(random);
      const double y = distribution(random);
      const double z = distribution(random);
      normal.add(x, y, z, std::hypot(x, y, z));
    }
    EXPECT_TRUE(foundInGaps(normal, 1.0, 2).empty());
    EXPECT_TRUE(foundInGaps(normal, 2.0, 2).empty());
  }
}

/// A ball of samples within others, with a void between that the surface lies in: it stays closed
/// where it is no wider than samples are apart, and goes where it is far wider.
TEST(GapTetrahedra, AreAllAcrossAVoidAllAround)
{
  const auto inGaps = [](double width)
  {
    const Cloud cube = clouds::uniform(20000, 8);
    Cloud cloud;
    for (std::size_t i = 0; i < cube.size(); ++i)
    {
      const double* const p = cube.positions.data() + 3 * i;
      const double r = fromMiddle(p[0], p[1], p[2]);
      if (std::abs(r - 0.3) > 0.5 * width)
      {
        cloud.add(p[0], p[1], p[2], r);
      }
    }
    const auto all = static_cast<double>(triangles::fullTetrahedra(cloud, 0.3).size());
    return static_cast<double>(foundInGaps(cloud, 0.3).size()) / all;
  };
  EXPECT_EQ(inGaps(0.01), 0.0);
  EXPECT_GT(inGaps(0.3), 0.99);
}

/// Nothing lies behind a sheet that is one sample thick, so that the ends of edges from a body to
/// it cannot agree on the spacing.
TEST(GapTetrahedra, AreThoseBetweenABodyAndASheet)
{
  Random random(9);
  Cloud cloud;
  for (int i = 0; i < 8600; ++i)
  {
    const double x = random();
    const double y = random();
    const double z = i < 8000 ? 0.5 * random() : 1.0 + 0.02 * random();
    cloud.add(x, y, z, z);
  }
  const auto all = static_cast<double>(triangles::fullTetrahedra(cloud, 0.75).size());
  EXPECT_GT(static_cast<double>(foundInGaps(cloud, 0.75).size()), 0.97 * all);
}

/// The last of several slices is no farther from the next one than these are apart.
TEST(GapTetrahedra, AreFewBetweenSlices)
{
  const Cloud cube = clouds::uniform(6000, 10);
  Cloud cloud;
  for (std::size_t i = 0; i < cube.size(); ++i)
  {
    const double* const p = cube.positions.data() + 3 * i;
    const double z = std::floor(5.0 * p[2]) / 5.0;
    cloud.add(p[0], p[1], z, z + 0.2 * p[0]);
  }
  for (const double isovalue : { 0.1, 0.5, 0.9 })
  {
    const auto all = static_cast<double>(triangles::fullTetrahedra(cloud, isovalue).size());
    EXPECT_LT(static_cast<double>(foundInGaps(cloud, isovalue).size()), 0.05 * all) << isovalue;
  }
}
