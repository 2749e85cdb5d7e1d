// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TriangleTesting_h
#define TriangleTesting_h

#include "Clouds.h"

#include "Core/Extraction/SingleRank.h"
#include "Core/Tree/Loading.h"
#include "Core/Triangles/ExtractTriangles.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace triangles
{

using clouds::Cloud;

/// The ids of the samples at the corners, ascending.
using Corners = std::array<std::uint64_t, 4>;

/// A cloud's distinct positions, with the lowest ids and the means of values.
struct Site
{
  std::array<double, 3> position;
  std::uint64_t id;
  double value;
};

inline std::vector<Site> sitesOf(const Cloud& cloud)
{
  std::map<std::array<double, 3>, std::vector<std::uint64_t>> ids;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const double* const p = cloud.positions.data() + 3 * i;
    ids[{ p[0] + 0.0, p[1] + 0.0, p[2] + 0.0 }].push_back(i); // 0 for -0
  }
  std::vector<Site> sites;
  for (const auto& [position, same] : ids)
  {
    double sum = 0.0;
    double lowest = cloud.values[same[0]];
    double highest = lowest;
    for (const std::uint64_t id : same)
    {
      sum += cloud.values[id];
      lowest = std::min(lowest, cloud.values[id]);
      highest = std::max(highest, cloud.values[id]);
    }
    const double mean = same.size() == 1 ? sum : sum / static_cast<double>(same.size());
    sites.push_back({ position, same[0], std::min(std::max(mean, lowest), highest) });
  }
  return sites;
}

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using FullTetrahedrization = CGAL::Delaunay_triangulation_3<Kernel,
  CGAL::Triangulation_data_structure_3<
    CGAL::Triangulation_vertex_base_with_info_3<std::size_t, Kernel>,
    CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>;

/// CGAL's Delaunay tetrahedrization of all sites; vertices know their number.
inline FullTetrahedrization fullTetrahedrization(const std::vector<Site>& sites)
{
  std::vector<std::pair<Kernel::Point_3, std::size_t>> points;
  for (std::size_t i = 0; i < sites.size(); ++i)
  {
    const auto& p = sites[i].position;
    points.push_back({ Kernel::Point_3(p[0], p[1], p[2]), i });
  }
  return { points.begin(), points.end() };
}

/// Its crossing tetrahedra, ordered.
inline std::vector<Corners> fullTetrahedra(const Cloud& cloud, double isovalue)
{
  const std::vector<Site> sites = sitesOf(cloud);
  const FullTetrahedrization full = fullTetrahedrization(sites);
  std::vector<Corners> result;
  if (full.dimension() < 3)
  {
    return result;
  }
  for (const auto cell : full.finite_cell_handles())
  {
    Corners corners;
    int below = 0;
    for (std::size_t i = 0; i < 4; ++i)
    {
      const Site& site = sites[cell->vertex(static_cast<int>(i))->info()];
      corners[i] = site.id;
      below += site.value < isovalue ? 1 : 0;
    }
    if (below > 0 && below < 4)
    {
      std::sort(corners.begin(), corners.end());
      result.push_back(corners);
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// The number of its hull's facets with corners on both sides.
inline std::size_t crossingHullFacets(const Cloud& cloud, double isovalue)
{
  const std::vector<Site> sites = sitesOf(cloud);
  const FullTetrahedrization full = fullTetrahedrization(sites);
  std::size_t count = 0;
  for (const auto cell : full.all_cell_handles())
  {
    int below = 0;
    int finite = 0;
    for (int i = 0; i < 4; ++i)
    {
      if (!full.is_infinite(cell->vertex(i)))
      {
        ++finite;
        below += sites[cell->vertex(i)->info()].value < isovalue ? 1 : 0;
      }
    }
    count += finite == 3 && below > 0 && below < 3 ? 1 : 0;
  }
  return count;
}

struct Found
{
  std::vector<Corners> corners; // ordered
  isopoint::TetrahedraCounts counts;
};

/// The ids of the samples at the corners of tetrahedra, ordered.
template <class TSample>
std::vector<Corners> cornersOf(const isopoint::SampleTree<TSample>& tree,
  const std::vector<isopoint::CrossingTetrahedron<typename TSample::Id>>& tetrahedra)
{
  std::vector<Corners> result;
  for (const auto& tetrahedron : tetrahedra)
  {
    Corners corners;
    for (std::size_t i = 0; i < 4; ++i)
    {
      corners[i] = tree.samples[tree.nodes[tetrahedron.corners[i]].begin].id;
    }
    std::sort(corners.begin(), corners.end());
    result.push_back(corners);
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// The same as the core finds them.
template <class TSample = isopoint::WideSample>
Found foundTetrahedra(const Cloud& cloud, double isovalue, std::size_t threads = 1)
{
  const isopoint::Execution execution = clouds::executionOn(threads);
  auto tree = isopoint::loadSamples<TSample>(execution, cloud.size(), clouds::readerOf(cloud));
  const isopoint::NeighborhoodCache<typename TSample::Id> none;
  isopoint::IsosurfaceRequest request;
  request.isovalue = isovalue;
  isopoint::SingleRank<TSample> rank(tree);
  std::unique_ptr<isopoint::Band> band;
  isopoint::TriangleExtraction<TSample, isopoint::SingleRank<TSample>> extraction(
    execution, tree, rank, none, band, request);
  Found found;
  found.corners = cornersOf(tree, extraction.tetrahedra(execution));
  found.counts = extraction.counts();
  return found;
}

/// The crossing tetrahedra of one isovalue after another, in one tree, with the band kept.
class KeptTetrahedra
{
public:
  explicit KeptTetrahedra(Cloud cloud)
    : Samples(std::move(cloud))
    , Tree(isopoint::loadSamples<TSample>(
        this->Run, this->Samples.size(), clouds::readerOf(this->Samples)))
  {
  }

  /// Expects those of the full tetrahedrization. @returns what was found
  Found expectSame(double isovalue, bool keepsBand = true)
  {
    isopoint::IsosurfaceRequest request;
    request.isovalue = isovalue;
    request.keepsBand = keepsBand;
    isopoint::SingleRank<TSample> rank(this->Tree);
    isopoint::TriangleExtraction<TSample, isopoint::SingleRank<TSample>> extraction(
      this->Run, this->Tree, rank, this->None, this->Band, request);
    Found found;
    found.corners = cornersOf(this->Tree, extraction.tetrahedra(this->Run));
    found.counts = extraction.counts();
    const std::vector<Corners> expected = fullTetrahedra(this->Samples, isovalue);
    EXPECT_EQ(found.corners.size(), expected.size()) << isovalue;
    EXPECT_TRUE(found.corners == expected) << isovalue;
    return found;
  }

  bool hasBand() const { return this->Band != nullptr; }

private:
  using TSample = isopoint::WideSample;

  Cloud Samples;
  isopoint::Execution Run;
  isopoint::SampleTree<TSample> Tree;
  isopoint::NeighborhoodCache<TSample::Id> None;
  std::unique_ptr<isopoint::Band> Band;
};

/// Finds them from a band of a share of the nodes that a narrow band yields, the first of them.
inline Found foundFromPart(const Cloud& cloud, double isovalue, double share)
{
  using TSample = isopoint::WideSample;
  const isopoint::Execution execution;
  auto tree = isopoint::loadSamples<TSample>(execution, cloud.size(), clouds::readerOf(cloud));
  isopoint::SingleRank<TSample> rank(tree);
  std::vector<isopoint::BinaryIndex> nodes =
    isopoint::NarrowBand<TSample>(tree, isovalue, execution).refine(rank);
  nodes.resize(static_cast<std::size_t>(std::ceil(share * static_cast<double>(nodes.size()))));
  isopoint::SharedLeafMeans<TSample> means(tree);
  std::unique_ptr<isopoint::Band> band;
  isopoint::CrossingTetrahedraFinder<TSample, isopoint::SingleRank<TSample>> finder(
    execution, tree, rank, means, isovalue, band);
  Found found;
  found.corners = cornersOf(tree, finder.find(nodes));
  found.counts = finder.counts();
  return found;
}

/// Expects the same crossing tetrahedra from both. @returns what was found
template <class TSample = isopoint::WideSample>
Found expectSameTetrahedra(const Cloud& cloud, double isovalue, std::size_t threads = 1)
{
  Found found = foundTetrahedra<TSample>(cloud, isovalue, threads);
  const std::vector<Corners> expected = fullTetrahedra(cloud, isovalue);
  EXPECT_EQ(found.corners.size(), expected.size());
  EXPECT_TRUE(found.corners == expected);
  return found;
}

} // namespace triangles

#endif
