// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "BruteForce.h"

#include "Core/Extraction/SingleRank.h"
#include "Core/Tree/Loading.h"
#include "Core/Triangles/ExtractTriangles.h"
#include "Core/Triangles/GapTetrahedra.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <gtest/gtest.h>

/// The crossing tetrahedra of the core, and those of CGAL's tetrahedralization of all samples.
namespace triangles
{

using clouds::Cloud;

/// The ids of the samples at the corners, ascending.
using Corners = std::array<std::uint64_t, 4>;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel,
  CGAL::Triangulation_data_structure_3<
    CGAL::Triangulation_vertex_base_with_info_3<std::size_t, Kernel>,
    CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>;

/// CGAL's Delaunay tetrahedralization of a cloud's distinct positions.
class FullTetrahedralization
{
public:
  explicit FullTetrahedralization(const Cloud& cloud)
  {
    std::map<isopoint::Vector, std::vector<std::uint64_t>> idsAt;
    for (std::size_t i = 0; i < cloud.size(); ++i)
    {
      const auto [x, y, z] = cloud.at(i);
      idsAt[{ x + 0.0, y + 0.0, z + 0.0 }].push_back(i); // 0 for -0
    }
    std::vector<std::pair<Kernel::Point_3, std::size_t>> points;
    for (const auto& [p, same] : idsAt)
    {
      points.push_back({ Kernel::Point_3(p[0], p[1], p[2]), this->Ids.size() });
      std::vector<double> values;
      std::transform(same.begin(), same.end(), std::back_inserter(values),
        [&](std::uint64_t id) { return cloud.values[id]; });
      this->Ids.push_back(same[0]);
      this->Values.push_back(bruteforce::meanOf(values));
    }
    this->cells.insert(points.begin(), points.end());
  }

  std::uint64_t idOf(const Delaunay::Vertex_handle vertex) const
  {
    return this->Ids[vertex->info()];
  }

  bool isBelow(const Delaunay::Vertex_handle vertex, double isovalue) const
  {
    return this->Values[vertex->info()] < isovalue;
  }

  /// Whether the finite corners of a cell but one lie on both sides.
  bool isCrossing(const Delaunay::Cell_handle cell, double isovalue, int without = -1) const
  {
    return this->hasSide(true, cell, isovalue, without) && this->hasAbove(cell, isovalue, without);
  }

  /// Whether a finite corner of a cell, but one, is not below.
  bool hasAbove(const Delaunay::Cell_handle cell, double isovalue, int without = -1) const
  {
    return this->hasSide(false, cell, isovalue, without);
  }

  Corners cornersOf(const Delaunay::Cell_handle cell) const
  {
    Corners corners;
    for (int i = 0; i < 4; ++i)
    {
      corners[static_cast<std::size_t>(i)] = this->idOf(cell->vertex(i));
    }
    std::sort(corners.begin(), corners.end());
    return corners;
  }

  /// The crossing tetrahedra, ordered.
  std::vector<Corners> tetrahedra(double isovalue) const
  {
    std::vector<Corners> result;
    if (this->cells.dimension() == 3)
    {
      for (const auto cell : this->cells.finite_cell_handles())
      {
        if (this->isCrossing(cell, isovalue))
        {
          result.push_back(this->cornersOf(cell));
        }
      }
    }
    std::sort(result.begin(), result.end());
    return result;
  }

  Delaunay cells; // vertices know their number

private:
  bool hasSide(bool below, const Delaunay::Cell_handle cell, double isovalue, int without) const
  {
    bool isAny = false;
    for (int i = 0; i < 4; ++i)
    {
      isAny |= i != without && !this->cells.is_infinite(cell->vertex(i)) &&
               this->isBelow(cell->vertex(i), isovalue) == below;
    }
    return isAny;
  }

  std::vector<std::uint64_t> Ids; // by number: the lowest of coincident samples
  std::vector<double> Values;     // the mean of these
};

struct Found
{
  std::vector<Corners> corners; // ordered
  isopoint::TetrahedraCounts counts;
};

/// The crossing tetrahedra that the core finds, for one isovalue after another in one tree.
template <class TSample = isopoint::WideSample>
class TetrahedraSearch
{
public:
  explicit TetrahedraSearch(Cloud cloud, std::size_t threads = 1)
    : Samples(std::move(cloud))
    , Run(clouds::executionOn(threads))
    , Tree(isopoint::loadSamples<TSample>(
        this->Run, this->Samples.size(), clouds::readerOf(this->Samples)))
  {
  }

  /// Expects those of the full tetrahedralization. @returns what was found
  Found expectSame(double isovalue, bool keepsTetrahedra = true)
  {
    isopoint::IsosurfaceRequest request{ isovalue };
    request.keepsTetrahedra = keepsTetrahedra;
    Extraction extraction(this->Run, this->Tree, this->Rank, this->None, this->Band, request);
    return this->compared(extraction.tetrahedra(this->Run), extraction.counts(), isovalue);
  }

  /// The same from a first band of only a share of the narrow band's nodes.
  Found expectSameFromPart(double isovalue, double share)
  {
    auto nodes = isopoint::NarrowBand<TSample>(this->Tree, isovalue, this->Run).refine(this->Rank);
    nodes.resize(static_cast<std::size_t>(std::ceil(share * static_cast<double>(nodes.size()))));
    isopoint::LeafValues<TSample> means(this->Tree);
    isopoint::CrossingTetrahedraFinder<TSample, isopoint::SingleRank<TSample>> finder(
      this->Run, this->Tree, this->Rank, means, isovalue, this->Band);
    const auto tetrahedra = finder.find(nodes);
    return this->compared(tetrahedra, finder.counts(), isovalue);
  }

  /// Those in gaps, ordered.
  std::vector<Corners> inGaps(double isovalue, bool keepsHullSlivers = false)
  {
    const isopoint::IsosurfaceRequest request{ isovalue };
    Extraction extraction(this->Run, this->Tree, this->Rank, this->None, this->Band, request);
    const auto all = extraction.tetrahedra(this->Run);
    const std::vector<char> areInGaps =
      isopoint::GapTetrahedraFinder<TSample, isopoint::SingleRank<TSample>>(
        this->Run, this->Tree, this->Rank, all, keepsHullSlivers)
        .find();
    std::decay_t<decltype(all)> tetrahedra;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      if (areInGaps[i])
      {
        tetrahedra.push_back(all[i]);
      }
    }
    return this->cornersOf(tetrahedra);
  }

  bool hasBand() const { return this->Band != nullptr; }

private:
  using Extraction = isopoint::TriangleExtraction<TSample, isopoint::SingleRank<TSample>>;

  template <class Tetrahedra>
  std::vector<Corners> cornersOf(const Tetrahedra& tetrahedra) const
  {
    std::vector<Corners> result;
    for (const auto& tetrahedron : tetrahedra)
    {
      Corners& corners = result.emplace_back();
      for (std::size_t i = 0; i < 4; ++i)
      {
        corners[i] = this->Tree.samples[this->Tree.nodes[tetrahedron.corners[i]].begin].id;
      }
      std::sort(corners.begin(), corners.end());
    }
    std::sort(result.begin(), result.end());
    return result;
  }

  template <class Tetrahedra>
  Found compared(
    const Tetrahedra& tetrahedra, const isopoint::TetrahedraCounts& counts, double isovalue)
  {
    if (!this->Full)
    {
      this->Full.emplace(this->Samples);
    }
    const Found found{ this->cornersOf(tetrahedra), counts };
    const auto expected = this->Full->tetrahedra(isovalue);
    EXPECT_EQ(found.corners.size(), expected.size()) << isovalue;
    EXPECT_TRUE(found.corners == expected) << isovalue;
    return found;
  }

  Cloud Samples;
  isopoint::Execution Run;
  isopoint::SampleTree<TSample> Tree;
  isopoint::SingleRank<TSample> Rank{ this->Tree };
  isopoint::NeighborhoodCache<typename TSample::Id> None;
  std::unique_ptr<isopoint::KeptTetrahedra> Band;
  std::optional<FullTetrahedralization> Full; // once it is needed
};

/// Expects the same crossing tetrahedra from both. @returns what was found
template <class TSample = isopoint::WideSample>
Found expectSameTetrahedra(const Cloud& cloud, double isovalue, std::size_t threads = 1)
{
  return TetrahedraSearch<TSample>(cloud, threads).expectSame(isovalue);
}

} // namespace triangles
