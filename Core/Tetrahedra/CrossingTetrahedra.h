// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_CrossingTetrahedra_h
#define isopoint_CrossingTetrahedra_h

#include "Core/Base/Execution.h"
#include "Core/Neighbors/NeighborSearch.h"
#include "Core/Tetrahedra/Band.h"
#include "Core/Tetrahedra/SideCheck.h"
#include "Core/Tetrahedra/SphereSearch.h"
#include "Core/Tree/CoincidentSamples.h"
#include "Core/Tree/NodeMarks.h"
#include "Core/Tree/TreeRefinement.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace isopoint
{

/// What finding the crossing tetrahedra took.
struct TetrahedraCounts
{
  std::size_t band = 0; // samples near the surface
  std::size_t size = 0; // samples that were tetrahedrized in the end
  std::size_t rounds = 0;
  bool isWhole = false; // whether all samples were tetrahedrized in the end
};

/// Finds the crossing tetrahedra of the Delaunay tetrahedrization of all samples of a tree, without
/// that tetrahedrization: docs/triangles.md, which proves that they are these.
///
/// Where several ranks share the tree, all functions are collective. Every rank tetrahedrizes the
/// band of all, searches spheres for samples of its own, and finds all crossing tetrahedra.
/// @tparam TRanks SingleRank, or SharedRanks
template <class TSample, class TRanks>
class CrossingTetrahedraFinder
{
public:
  using Id = typename TSample::Id;

  /// @param tree refined around the isovalue (see NarrowBand); will be refined further
  /// @param values of the tree's leaves
  /// @param kept the band of an earlier search in this tree, or null; becomes that of this one, or
  /// null if that is large or the search fails
  CrossingTetrahedraFinder(const Execution& execution, SampleTree<TSample>& tree, TRanks& ranks,
    SharedLeafMeans<TSample>& values, double isovalue, std::unique_ptr<Band>& kept)
    : Run(execution)
    , Tree(tree)
    , Ranks(ranks)
    , Means(values)
    , Isovalue(isovalue)
    , Kept(kept)
  {
  }

  /// @param nodes below which all of this rank's leaves are that touch a leaf on the other side of
  /// the isovalue
  /// @returns tetrahedra of leaves of this rank's tree
  /// @throws std::bad_alloc, Aborted, FailedElsewhere, or std::length_error (see NarrowBand)
  std::vector<CrossingTetrahedron<Id>> find(const std::vector<BinaryIndex>& nodes)
  {
    std::vector<std::size_t> leaves = this->leavesAtSurface(nodes);
    this->Counts.band = static_cast<std::size_t>(this->Ranks.sum(leaves.size()));
    this->gather(leaves);
    if (leaves.empty()) // of all ranks: what is kept may serve the next isovalue
    {
      return {};
    }
    this->begin(leaves);
    if (!this->Current->isWhole && this->areMany(this->Counts.band))
    {
      this->insertAll();
    }
    this->insert(leaves);
    this->spanSpace();
    while (!this->Current->isWhole && this->triangulation().dimension() == 3)
    {
      ++this->Counts.rounds;
      if (!this->certify() && !this->checkSides())
      {
        break;
      }
      if (this->Ranks.isAny(this->isSpent()))
      {
        this->insertAll();
      }
    }
    this->Counts.size = this->triangulation().size();
    this->Counts.isWhole = this->Current->isWhole;
    std::vector<CrossingTetrahedron<Id>> found = this->crossing();
    this->Run.progress(1.0);
    if (this->Current->isSmall(this->Tree.ownCount()))
    {
      this->Kept = std::move(this->Current);
    }
    this->Current.reset();
    return found;
  }

  const TetrahedraCounts& counts() const { return this->Counts; }

private:
  /// The unit of the coordinates of this rank's samples, unless it is so small that few of those
  /// around a tetrahedron are within the units for which doubles are exact. @throws Aborted
  static CoordinateUnit unitOfSamples(const Execution& execution, const SampleTree<TSample>& tree)
  {
    double volume = 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      volume *= tree.region.upper[axis] - tree.region.lower[axis];
    }
    // No result depends on its last bits, nor on the unit: predicates are exact with any.
    constexpr double leastShare = 1.0 / 128.0; // of the mean spacing
    const CoordinateUnit none(
      leastShare * std::cbrt(volume / static_cast<double>(tree.samples.size())));
    CoordinateUnit unit = none;
    std::mutex mutex;
    constexpr std::size_t grain = 65536;
    const std::size_t first = tree.isPartial ? tree.ownBegin : 0;
    forBatches(execution, tree.ownCount(), 16 * grain, grain,
      [&](std::size_t begin, std::size_t end)
      {
        CoordinateUnit ofRange = none;
        for (std::size_t i = begin; i < end && ofRange.value() > 0.0; ++i)
        {
          ofRange.add(positionOf(tree.samples[first + i]));
        }
        const std::lock_guard<std::mutex> lock(mutex);
        unit.add(ofRange);
      });
    return unit;
  }

  std::vector<CrossingTetrahedron<Id>> crossing()
  {
    std::vector<CrossingTetrahedron<Id>> result(
      this->triangulation().listCrossingTetrahedra(this->Run));
    forEachIndex(this->Run, result.size(),
      [&](std::size_t i)
      {
        const auto [corners, belowCount, isAtHull] = this->triangulation().crossingTetrahedronAt(i);
        result[i].belowCount = belowCount;
        result[i].isAtHull = isAtHull;
        std::transform(corners.begin(), corners.end(), result[i].corners.begin(),
          [](std::uint64_t leaf) { return static_cast<Id>(leaf); });
      });
    this->triangulation().dropLists();
    return result;
  }

  /// What one thread needs to look for leaves at the surface.
  struct LeafSearch
  {
    LeafValueCache<TSample> values;
    Path path;
    std::vector<std::size_t> found;
  };

  /// This rank's leaves that touch one on the other side.
  std::vector<std::size_t> leavesAtSurface(const std::vector<BinaryIndex>& nodes)
  {
    std::vector<std::size_t> leaves;
    std::mutex mutex;
    const auto makeSearch = [this]() {
      return LeafSearch{ { this->Tree, this->Means }, pathToRoot(this->Tree), {} };
    };
    constexpr std::size_t grain = 256;
    this->Ranks.forEach(
      this->Run, { nodes.size(), 8 * grain, grain }, makeSearch,
      [&](LeafSearch& search, std::size_t i)
      {
        search.found.clear();
        moveTo(this->Tree, search.path, nodes[i]);
        forEachBelow(this->Tree, search.path, maximumDepth,
          [&](const Path& leaf)
          {
            if (this->isAtSurface(leaf, search.values))
            {
              search.found.push_back(leaf.nodeIndex());
            }
          });
        const std::lock_guard<std::mutex> lock(mutex);
        leaves.insert(leaves.end(), search.found.begin(), search.found.end());
      },
      partOf(this->Run, 0.0, searchEnd).progress);
    return leaves;
  }

  bool isAtSurface(const Path& leaf, LeafValueCache<TSample>& values) const
  {
    if (!this->Tree.hasOwn(this->Tree.nodes[leaf.nodeIndex()]))
    {
      return false;
    }
    const bool isBelow = values.at(leaf.nodeIndex()) < this->Isovalue;
    return touchesOtherSide(this->Tree, leaf, maximumDepth, this->Isovalue, isBelow);
  }

  BandTriangulation& triangulation() { return this->Current->triangulation; }

  /// Adds those of all other ranks to leaves of this one, and brings them into an order that is the
  /// same for any number of threads and on all ranks.
  /// @param leaves in any order, with repetitions
  void gather(std::vector<std::size_t>& leaves)
  {
    this->Ranks.gatherLeaves(leaves);
    std::sort(leaves.begin(), leaves.end(),
      [this](std::size_t a, std::size_t b)
      { return this->Tree.nodes[a].begin < this->Tree.nodes[b].begin; });
    leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  }

  /// Goes on with the band that was kept, if it holds most of the leaves and not many others, or
  /// begins a new one. Nothing is kept while it changes: it may fail.
  /// @param leaves gathered
  void begin(const std::vector<std::size_t>& leaves)
  {
    this->Current = std::move(this->Kept);
    const bool isNew = this->Ranks.isAny(!this->Current);
    if (isNew || !this->isOfUse(leaves))
    {
      this->Current.reset();
      this->Current = std::make_unique<Band>(unitOfSamples(this->Run, this->Tree));
      return;
    }
    LeafValueCache<TSample> values(this->Tree, this->Means);
    this->triangulation().setSides([&](std::uint64_t leaf)
      { return values.at(static_cast<std::size_t>(leaf)) < this->Isovalue; });
  }

  bool isOfUse(const std::vector<std::size_t>& leaves)
  {
    constexpr std::size_t mostTimes = 3;
    this->Current->marks.grow(this->Tree.nodes.size());
    const auto known = static_cast<std::size_t>(std::count_if(leaves.begin(), leaves.end(),
      [this](std::size_t leaf) { return this->Current->marks.has(leaf, bandmarks::inBand); }));
    return 2 * known >= leaves.size() && this->triangulation().size() <= mostTimes * leaves.size();
  }

  /// Adds leaves to the band.
  /// @param leaves gathered
  void insert(const std::vector<std::size_t>& leaves)
  {
    this->Current->marks.grow(this->Tree.nodes.size());
    this->triangulation().insert(this->Run, this->newSites(leaves),
      [step = this->nextStep()](double share)
      {
        throwIfAborted(step);
        step.progress(share);
      });
  }

  /// @param leaves of this rank, in any order, with repetitions
  void gatherAndInsert(std::vector<std::size_t> leaves)
  {
    this->gather(leaves);
    this->insert(leaves);
  }

  /// Marks leaves as those of the band. @returns those that were not
  std::vector<BandSite> newSites(const std::vector<std::size_t>& leaves)
  {
    LeafValueCache<TSample> values(this->Tree, this->Means);
    std::vector<BandSite> sites;
    sites.reserve(leaves.size());
    for (const std::size_t leaf : leaves)
    {
      if (!this->Current->marks.has(leaf, bandmarks::inBand))
      {
        this->Current->marks.set(leaf, bandmarks::inBand);
        sites.push_back(
          { positionOf(this->Tree.sampleOf(leaf)), leaf, values.at(leaf) < this->Isovalue });
      }
    }
    return sites;
  }

  /// Splits nodes of this rank.
  void split(const std::vector<std::size_t>& nodes)
  {
    splitFurther(this->Run, this->Tree, nodes);
    this->Current->marks.grow(this->Tree.nodes.size());
  }

  /// Inserts all samples.
  void insertAll()
  {
    splitCompletely(this->Run, this->Tree, { SampleTree<TSample>::rootNode });
    std::vector<std::size_t> leaves;
    Path path = pathToRoot(this->Tree);
    forEachBelow(this->Tree, path, maximumDepth,
      [&](const Path& leaf)
      {
        if (this->Tree.hasOwn(this->Tree.nodes[leaf.nodeIndex()]))
        {
          leaves.push_back(leaf.nodeIndex());
        }
      });
    this->gatherAndInsert(std::move(leaves));
    this->Current->isWhole = true;
  }

  /// Inserts samples until the band's are not coplanar, unless all are.
  void spanSpace()
  {
    while (this->triangulation().size() > 0 && this->triangulation().dimension() < 3)
    {
      const std::optional<std::size_t> node = this->nodeOffBand();
      std::vector<std::size_t> leaves;
      if (node && this->Tree.nodes[*node].isLeaf)
      {
        leaves.push_back(*node);
      }
      else if (node)
      {
        this->split({ *node });
      }
      if (!this->Ranks.isAny(node.has_value()))
      {
        return;
      }
      this->gatherAndInsert(std::move(leaves));
    }
  }

  /// A node of this rank without children with a sample that would raise the dimension of the band.
  std::optional<std::size_t> nodeOffBand()
  {
    std::optional<std::size_t> found;
    Path path = pathToRoot(this->Tree);
    forEachBelow(this->Tree, path, maximumDepth,
      [&](const Path& below)
      {
        const Node<TSample>& node = this->Tree.nodes[below.nodeIndex()];
        const std::size_t end = node.isLeaf ? node.begin + 1 : node.end;
        for (std::size_t i = node.begin; i < end && !found && this->Tree.hasOwn(node); ++i)
        {
          if (this->triangulation().raisesDimension(positionOf(this->Tree.samples[i])))
          {
            found = below.nodeIndex();
          }
        }
      });
    return found;
  }

  /// What searches in spheres yield.
  struct SearchResult
  {
    std::vector<std::size_t> leaves;  // that lie inside
    std::vector<std::size_t> unsplit; // nodes that have to be split for searches to be complete
  };

  /// Looks for samples inside the spheres of crossing cells, certifies cells without any, and
  /// inserts those found. A cell that holds one of another rank does not outlive that.
  /// @returns whether cells remain to be certified
  bool certify()
  {
    throwIfAborted(this->Run);
    const std::size_t openCount = this->triangulation().listOpenCells(this->Run);
    this->Visits += this->triangulation().cellCount();
    SearchResult result = this->searchSpheres(openCount);
    if (!this->Ranks.isAny(this->isSpent()))
    {
      this->split(result.unsplit);
      this->gatherAndInsert(std::move(result.leaves));
    }
    return this->Ranks.isAny(openCount > 0);
  }

  SearchResult searchSpheres(std::size_t openCount)
  {
    SearchResult all;
    std::mutex mutex;
    constexpr std::size_t grain = 512;
    forBatches(
      this->Run, openCount, 8 * grain, grain,
      [&](std::size_t begin, std::size_t end)
      {
        SphereSearch<TSample> search(this->Tree, this->triangulation(), this->Current->marks);
        std::vector<std::size_t> leaves;
        std::size_t visits = 0;
        for (std::size_t i = begin; i < end && !this->isSpent(); ++i)
        {
          if (const std::optional<std::size_t> leaf = search.find(i))
          {
            leaves.push_back(*leaf);
          }
          else if (search.isComplete())
          {
            this->triangulation().certify(i);
          }
          this->Visits += search.visits() - visits;
          ++this->Searches;
          visits = search.visits();
        }
        const std::lock_guard<std::mutex> lock(mutex);
        all.leaves.insert(all.leaves.end(), leaves.begin(), leaves.end());
        all.unsplit.insert(all.unsplit.end(), search.unsplit().begin(), search.unsplit().end());
      },
      this->nextStep().progress);
    return all;
  }

  /// Inserts samples whose value is on the other side than the band's surface has it.
  /// @returns whether there were any
  bool checkSides()
  {
    SideCheck<TSample> check(
      this->Run, this->Tree, this->triangulation(), this->Current->marks, this->Means);
    std::vector<std::size_t> leaves;
    std::vector<std::size_t> unsplit;
    for (const std::size_t node : check.find(this->Isovalue))
    {
      (this->Tree.nodes[node].isLeaf ? leaves : unsplit).push_back(node);
    }
    const bool isAnyWrong = !leaves.empty() || !unsplit.empty();
    this->split(unsplit);
    this->gatherAndInsert(std::move(leaves));
    return this->Ranks.isAny(isAnyWrong);
  }

  /// The execution of an insertion or a search. How many follow is not known: each takes half of
  /// the progress that is left.
  Execution nextStep()
  {
    const double begin = this->StepEnd;
    this->StepEnd = 0.5 * (begin + 1.0);
    return partOf(this->Run, begin, this->StepEnd);
  }

  /// Whether so many samples are near the surface that it is better to insert all.
  bool areMany(std::size_t leafCount) const
  {
    constexpr double manyShare = 1.0 / 3.0;
    constexpr std::size_t smallCloud = 1000; // whose samples are mostly near the surface
    const std::size_t count = this->Tree.samples.size();
    return count > smallCloud &&
           static_cast<double>(leafCount) > manyShare * static_cast<double>(count);
  }

  /// Whether searches took so long that it is better to insert all samples. Long searches, as in
  /// huge spheres through voids, promise more of their kind: they get less. On several ranks each
  /// would insert the samples of all.
  bool isSpent() const
  {
    constexpr std::size_t longSearch = 500;
    constexpr std::size_t smallCloud = 10000;
    const std::size_t visits = this->Visits.load(std::memory_order_relaxed);
    const bool areLong = visits > longSearch * this->Searches.load(std::memory_order_relaxed);
    const std::size_t visitsForSample = areLong ? 25 : 300;
    return visits > visitsForSample * (this->Tree.samples.size() + smallCloud);
  }

  const Execution& Run;
  SampleTree<TSample>& Tree;
  TRanks& Ranks;
  SharedLeafMeans<TSample>& Means;
  const double Isovalue;
  std::unique_ptr<Band>& Kept;
  std::unique_ptr<Band> Current;
  std::atomic<std::size_t> Visits{ 0 }; // of nodes, and of cells in lists, or as long as these
  std::atomic<std::size_t> Searches{ 0 };
  TetrahedraCounts Counts;
  static constexpr double searchEnd = 0.1; // for leaves at the surface; share of the progress
  double StepEnd = searchEnd;
};

} // namespace isopoint

#endif
