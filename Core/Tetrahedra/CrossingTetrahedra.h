// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Extraction/TetrahedraLimit.h"
#include "Core/Neighbors/NeighborSearch.h"
#include "Core/Tetrahedra/KeptTetrahedra.h"
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
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace isopoint
{

struct TetrahedraCounts
{
  std::size_t atSurface = 0; // samples of leaves near the surface
  std::size_t size = 0;      // samples tetrahedralized in the end
  std::size_t cells = 0;     // tetrahedra of these, and facets of their hull
  std::size_t edges = 0;     // asked whether they are in gaps, with repetitions
  std::size_t rounds = 0;
  bool isWhole = false; // whether these are all samples
};

/// Finds the crossing tetrahedra of the Delaunay tetrahedralization of all samples, without
/// building it. See docs/triangles.md for the proof.
/// With a process group, all functions are collective: every rank inserts the samples of all,
/// searches spheres for its own samples only, and finds all crossing tetrahedra.
/// @tparam TRanks SingleRank, or SharedRanks
template <class TSample, class TRanks>
class CrossingTetrahedraFinder
{
public:
  /// @param tree refined around the isovalue (see NarrowBand); is refined further
  /// @param values of the tree's leaves
  /// @param kept of an earlier search in this tree, or null; receives what to keep of this one:
  /// null if that is large or the search fails
  /// @param limit of the tetrahedra of all samples
  CrossingTetrahedraFinder(const Execution& execution, SampleTree<TSample>& tree, TRanks& ranks,
    LeafValues<TSample>& values, double isovalue, std::unique_ptr<KeptTetrahedra>& kept,
    const TetrahedraLimit& limit = {})
    : Run(execution)
    , Tree(tree)
    , Ranks(ranks)
    , Values(values)
    , Isovalue(isovalue)
    , Kept(kept)
    , Most(limit.of(tree.samples.size()))
  {
  }

  /// @param nodes that contain all of this rank's leaves that touch a leaf on the other side
  /// @returns tetrahedra of leaves of this rank's tree
  /// @throws std::bad_alloc, Aborted, FailedElsewhere, TreeTooLarge (see NarrowBand), or
  /// TooManyTetrahedra on all ranks
  std::vector<LeafTetrahedron> find(const std::vector<BinaryIndex>& nodes)
  {
    std::vector<LeafTetrahedron> found;
    this->search(
      [&]()
      {
        if (this->certifyCrossing(nodes))
        {
          found = this->triangulation().crossingTetrahedra(this->Run);
          this->finish();
        }
      });
    return found;
  }

  /// For bodies: counts the outside as below, certifies the crossing tetrahedra and facets of the
  /// hull, then calls explore(), which may use triangulation() and certifyTargets(). Coplanar
  /// samples have no body.
  /// @param nodes as above
  /// @param explore may be called again, after an exception that certifyTargets() throws
  /// @throws as find(), and what explore throws
  template <class Explore>
  void findBody(const std::vector<BinaryIndex>& nodes, const Explore& explore)
  {
    this->IsBody = true;
    this->search(
      [&]()
      {
        if (this->certifyCrossing(nodes))
        {
          if (this->triangulation().dimension() == 3)
          {
            explore();
          }
          this->finish();
        }
      });
  }

  /// Certifies the targets of the triangulation. Samples in their spheres are inserted, which
  /// replaces the targets, until all spheres are empty.
  void certifyTargets()
  {
    while (!this->Current->isWhole)
    {
      const std::vector<CellHandle> open = this->triangulation().openTargets();
      if (!this->Ranks.isAny(!open.empty()))
      {
        return;
      }
      this->certifyOrInsert(open);
      this->insertAllIfSpent();
    }
  }

  /// During findBody().
  PartialTriangulation& triangulation() { return this->Current->triangulation; }

  const TetrahedraCounts& counts() const { return this->Counts; }

private:
  /// Searches again without inserting all samples if only that exceeded the limit: when searches
  /// take too long differs among ranks.
  template <class Work>
  void search(const Work& work)
  {
    try
    {
      work();
    }
    catch (const TooManyTetrahedra&)
    {
      if (!this->IsInsertingAll)
      {
        throw;
      }
      this->IsInsertingAll = false;
      this->MayInsertAll = false;
      dropTetrahedra(this->Run, this->Current);
      work();
    }
  }

  /// @returns whether the surface may have tetrahedra
  bool certifyCrossing(const std::vector<BinaryIndex>& nodes)
  {
    std::vector<std::size_t> leaves = this->leavesAtSurface(nodes);
    this->Counts.atSurface = this->Ranks.sum(leaves.size());
    this->gather(leaves);
    if (leaves.empty() && !this->IsBody) // on all ranks; keeps tetrahedra for the next isovalue
    {
      return false;
    }
    this->begin(leaves);
    this->triangulation().setOutsideBelow(this->IsBody);
    if (!this->Current->isWhole && this->areTooManyToSearch(this->Counts.atSurface))
    {
      this->insertAll();
    }
    this->insert(leaves);
    if (this->IsBody)
    {
      this->gatherAndInsert(this->cornerLeaves());
    }
    this->insertUntilNotCoplanar();
    while (!this->Current->isWhole && this->triangulation().dimension() == 3)
    {
      ++this->Counts.rounds;
      if (!this->certify() && !this->checkSides())
      {
        break;
      }
      this->insertAllIfSpent();
    }
    return true;
  }

  /// Keeps the triangulation for the next isovalue if it is small.
  void finish()
  {
    this->Counts.size = this->triangulation().size();
    this->Counts.cells = this->triangulation().cellCount();
    this->Counts.isWhole = this->Current->isWhole;
    this->Run.progress(1.0);
    if (this->Current->isSmall(this->Tree.ownCount()))
    {
      this->Kept = std::move(this->Current);
    }
    dropTetrahedra(this->Run, this->Current);
  }

  /// The unit of this rank's coordinates, unless too small for doubles to be exact.
  /// @throws Aborted
  static CoordinateUnit unitOfSamples(const Execution& execution, const SampleTree<TSample>& tree)
  {
    double volume = 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      volume *= tree.region.upper[axis] - tree.region.lower[axis];
    }
    // The unit affects only speed: predicates are exact with any.
    constexpr double minShare = 1.0 / 128.0; // of the mean spacing
    const CoordinateUnit none(
      minShare * std::cbrt(volume / static_cast<double>(tree.samples.size())));
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

  /// Reusable memory of one thread.
  struct LeafSearch
  {
    Path path;
    std::vector<std::size_t> found;
  };

  /// This rank's leaves that touch a leaf on the other side of the isovalue.
  std::vector<std::size_t> leavesAtSurface(const std::vector<BinaryIndex>& nodes)
  {
    std::vector<std::size_t> leaves;
    std::mutex mutex;
    const auto makeSearch = [this]() { return LeafSearch{ pathToRoot(this->Tree), {} }; };
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
            if (this->isAtSurface(leaf))
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

  bool isAtSurface(const Path& leaf) const
  {
    if (!this->Tree.hasOwn(this->Tree.nodes[leaf.nodeIndex()]))
    {
      return false;
    }
    const bool isBelow = this->Values.at(leaf.nodeIndex()) < this->Isovalue;
    return touchesOtherSide(this->Tree, leaf, maximumDepth, this->Isovalue, isBelow);
  }

  /// Adds the leaves of all other ranks, in an order that depends on neither threads nor ranks.
  /// @param leaves in any order, with repetitions
  void gather(std::vector<std::size_t>& leaves)
  {
    this->Ranks.gatherLeaves(leaves);
    leaves = inTreeOrder(this->Run, this->Tree, leaves);
  }

  /// Reuses the kept triangulation if it has at least a quarter of the leaves and at most three
  /// samples per leaf; bodies, whose borders change little, have no such limit. Otherwise starts a
  /// new one. `Kept` is null meanwhile, because updates may fail.
  /// @param leaves gathered
  void begin(const std::vector<std::size_t>& leaves)
  {
    this->Current = std::move(this->Kept);
    const bool isNew = this->Ranks.isAny(!this->Current);
    if (isNew || !this->isReusable(leaves))
    {
      dropTetrahedra(this->Run, this->Current);
      this->Current = std::make_unique<KeptTetrahedra>(unitOfSamples(this->Run, this->Tree));
      return;
    }
    this->triangulation().setSides(
      this->Run, [this](std::uint64_t leaf) { return this->Values.at(leaf) < this->Isovalue; });
  }

  bool isReusable(const std::vector<std::size_t>& leaves)
  {
    constexpr std::size_t minShare = 4; // one of so many
    constexpr std::size_t maxTimes = 3;
    this->Current->marks.grow(this->Tree.nodes.size());
    std::size_t known = 0;
    forEachInOrder(this->Run, leaves.size(),
      [&](std::size_t i)
      { known += this->Current->marks.has(leaves[i], nodemarks::inserted) ? 1 : 0; });
    return minShare * known >= leaves.size() &&
           (this->IsBody || this->triangulation().size() <= maxTimes * leaves.size());
  }

  /// @param leaves gathered
  void insert(const std::vector<std::size_t>& leaves)
  {
    this->Current->marks.grow(this->Tree.nodes.size());
    const std::vector<Site> sites = this->newSites(leaves);
    const std::size_t most =
      this->Current->isUnlimited ? unlimited : this->suspiciousCount(sites.size());
    const bool isFull = !this->insert(this->triangulation(), this->nextStep(), sites, most);
    if (this->Ranks.isAny(isFull))
    {
      this->requireFewInAll();
      this->Current->isUnlimited = true;
      this->insert(this->triangulation(), this->nextStep(), sites, unlimited);
    }
  }

  /// Cells depend on ranks and former isovalues. So all samples decide, whenever the limit may be
  /// near: at a third of it, or early if samples have more than any but those on curves.
  std::size_t suspiciousCount(std::size_t newCount)
  {
    constexpr std::size_t nearPart = 3;
    constexpr std::size_t earlyPart = 16;
    constexpr std::size_t manyForSample = 100;
    const std::size_t early =
      std::max(this->Most / earlyPart, manyForSample * (this->triangulation().size() + newCount));
    return std::min(this->Most / nearPart, early);
  }

  static bool insert(PartialTriangulation& triangulation, const Execution& step,
    const std::vector<Site>& sites, std::size_t most)
  {
    return triangulation.insert(
      step, sites,
      [&step](double share)
      {
        throwIfAborted(step);
        step.progress(share);
      },
      most);
  }

  /// Throws if all samples have too many tetrahedra: inserts them in one order on one thread.
  void requireFewInAll()
  {
    if (this->MayInsertAll)
    {
      std::vector<std::size_t> leaves = this->allOwnLeaves();
      this->gather(leaves);
      this->Current->marks.grow(this->Tree.nodes.size());
      Execution alone = this->nextStep();
      alone.threads = 1;
      PartialTriangulation all(unitOfSamples(this->Run, this->Tree));
      const bool isFull = !insert(all, alone,
        tabulated<Site>(this->Run, leaves.size(),
          [&](std::size_t i) -> Site {
            return { positionOf(this->Tree.sampleOf(leaves[i])), leaves[i], false };
          }),
        this->Most);
      all.clear(this->Run);
      if (!this->Ranks.isAny(isFull))
      {
        return;
      }
    }
    throw TooManyTetrahedra(this->Tree.samples.size(), this->Most);
  }

  /// @param leaves of this rank, in any order, with repetitions
  void gatherAndInsert(std::vector<std::size_t> leaves)
  {
    this->gather(leaves);
    this->insert(leaves);
  }

  /// Marks leaves as inserted. @returns the new ones
  std::vector<Site> newSites(const std::vector<std::size_t>& leaves)
  {
    std::vector<Site> sites;
    sites.reserve(leaves.size());
    forEachInOrder(this->Run, leaves.size(),
      [&](std::size_t i)
      {
        const std::size_t leaf = leaves[i];
        if (!this->Current->marks.has(leaf, nodemarks::inserted))
        {
          this->Current->marks.set(leaf, nodemarks::inserted);
          sites.push_back({ positionOf(this->Tree.sampleOf(leaf)), leaf,
            this->Values.at(leaf) < this->Isovalue });
        }
      });
    return sites;
  }

  void split(const std::vector<std::size_t>& nodes)
  {
    splitFurther(this->Run, this->Tree, nodes);
    this->Current->marks.grow(this->Tree.nodes.size());
  }

  void insertAll()
  {
    this->IsInsertingAll = true;
    this->gatherAndInsert(this->allOwnLeaves());
    this->IsInsertingAll = false;
    this->Current->isWhole = true;
  }

  std::vector<std::size_t> allOwnLeaves()
  {
    splitCompletely(this->Run, this->Tree, { rootNode });
    std::vector<std::size_t> leaves;
    this->forEachOwnEnd([&](std::size_t leaf) { leaves.push_back(leaf); });
    return leaves;
  }

  /// This rank's leaves in the corners of the tree: the hull grows from them.
  std::vector<std::size_t> cornerLeaves()
  {
    const unsigned count = this->Tree.ownCount() > 0 ? 8 : 0;
    std::vector<std::size_t> ends;
    std::vector<std::size_t> unsplit;
    do
    {
      this->split(unsplit);
      ends.clear();
      unsplit.clear();
      for (unsigned corner = 0; corner < count; ++corner)
      {
        ends.push_back(this->endInCorner(corner));
        if (!this->Tree.nodes[ends.back()].isLeaf)
        {
          unsplit.push_back(ends.back());
        }
      }
      keepUnique(unsplit);
    } while (!unsplit.empty());
    return ends;
  }

  /// A node of this rank without children.
  /// @param corner bits of the axes on whose upper side it is
  std::size_t endInCorner(unsigned corner) const
  {
    std::size_t end = rootNode;
    while (this->Tree.nodes[end].isSplit())
    {
      const Node<TSample>& node = this->Tree.nodes[end];
      const bool isUpper = (corner >> node.axis) % 2 != 0;
      end = this->Tree.child(node, isUpper);
      if (!this->Tree.hasOwn(this->Tree.nodes[end]))
      {
        end = this->Tree.child(node, !isUpper);
      }
    }
    return end;
  }

  /// Inserts samples until they are not coplanar, unless all samples are.
  void insertUntilNotCoplanar()
  {
    while (this->triangulation().size() > 0 && this->triangulation().dimension() < 3)
    {
      const std::optional<std::size_t> node = this->nodeOffPlane();
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

  /// A node of this rank, without children, with a sample that would raise the dimension.
  std::optional<std::size_t> nodeOffPlane()
  {
    std::optional<std::size_t> found;
    this->forEachOwnEnd(
      [&](std::size_t index)
      {
        const Node<TSample>& node = this->Tree.nodes[index];
        const std::size_t end = node.positionsEnd();
        for (std::size_t i = node.begin; i < end && !found; ++i)
        {
          if (this->triangulation().raisesDimension(positionOf(this->Tree.samples[i])))
          {
            found = index;
          }
        }
      });
    return found;
  }

  /// Calls visit(node) for this rank's nodes without children, in the order of the tree.
  template <class Visit>
  void forEachOwnEnd(const Visit& visit) const
  {
    constexpr std::size_t batch = 4096;
    std::size_t count = 0;
    Path path = pathToRoot(this->Tree);
    forEachBelow(this->Tree, path, maximumDepth,
      [&](const Path& below)
      {
        if (count++ % batch == 0)
        {
          throwIfAborted(this->Run);
        }
        if (this->Tree.hasOwn(this->Tree.nodes[below.nodeIndex()]))
        {
          visit(below.nodeIndex());
        }
      });
  }

  struct SearchResult
  {
    std::vector<std::size_t> leaves;  // with samples inside a sphere
    std::vector<std::size_t> unsplit; // nodes to be split before a search is complete
  };

  /// Searches the spheres of open cells. An empty sphere certifies its cell; a sample found is
  /// inserted, which destroys the cell. Samples of other ranks do so when their rank inserts them.
  /// @returns whether any cells remain uncertified
  bool certify()
  {
    const std::vector<CellHandle> open = this->triangulation().openCells(this->Run);
    this->Visits += this->triangulation().cellCount();
    this->certifyOrInsert(open);
    return this->Ranks.isAny(!open.empty());
  }

  /// Certifies the cells whose spheres are empty, and inserts the samples found in the others.
  void certifyOrInsert(const std::vector<CellHandle>& open)
  {
    throwIfAborted(this->Run);
    SearchResult result = this->searchSpheres(open);
    if (!this->Ranks.isAny(this->isBudgetSpent()))
    {
      this->split(result.unsplit);
      this->gatherAndInsert(std::move(result.leaves));
    }
  }

  void insertAllIfSpent()
  {
    if (!this->Current->isWhole && this->Ranks.isAny(this->isBudgetSpent()))
    {
      this->insertAll();
    }
  }

  SearchResult searchSpheres(const std::vector<CellHandle>& open)
  {
    SearchResult all;
    std::mutex mutex;
    constexpr std::size_t grain = 512;
    forBatches(
      this->Run, open.size(), 8 * grain, grain,
      [&](std::size_t begin, std::size_t end)
      {
        SphereSearch<TSample> search(this->Tree, this->triangulation(), this->Current->marks,
          this->Current->boxes, this->IsBody);
        std::vector<std::size_t> leaves;
        std::size_t visits = 0;
        for (std::size_t i = begin; i < end && !this->isBudgetSpent(); ++i)
        {
          if (const std::optional<std::size_t> leaf = search.find(open[i]))
          {
            leaves.push_back(*leaf);
          }
          else if (search.isComplete())
          {
            this->triangulation().certify(open[i]);
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

  /// Inserts samples whose values are not on the side of the isovalue that SideCheck expects.
  /// @returns whether there were any
  bool checkSides()
  {
    SideCheck<TSample> check(
      this->Run, this->Tree, this->triangulation(), this->Current->marks, this->Values);
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

  /// The execution of an insertion or a search. As their number is unknown, each takes half of the
  /// remaining progress.
  Execution nextStep()
  {
    const double begin = this->StepEnd;
    this->StepEnd = 0.5 * (begin + 1.0);
    return partOf(this->Run, begin, this->StepEnd);
  }

  /// Whether it is faster to insert all samples, because so many are near the surface.
  bool areTooManyToSearch(std::size_t leafCount) const
  {
    constexpr double manyShare = 1.0 / 3.0;
    constexpr std::size_t smallCloud = 1000; // most of its samples are near the surface
    const std::size_t count = this->Tree.samples.size();
    return this->MayInsertAll && count > smallCloud &&
           static_cast<double>(leafCount) > manyShare * static_cast<double>(count);
  }

  /// Whether searches took longer than inserting all samples would. Long searches, as in huge
  /// spheres through voids, get a twelfth of the budget: more of them follow.
  bool isBudgetSpent() const
  {
    constexpr std::size_t longSearch = 500;
    constexpr std::size_t smallCloud = 10000;
    const std::size_t visits = this->Visits.load(std::memory_order_relaxed);
    const bool areLong = visits > longSearch * this->Searches.load(std::memory_order_relaxed);
    const std::size_t visitsForSample = areLong ? 25 : 300;
    return this->MayInsertAll &&
           visits > visitsForSample * (this->Tree.samples.size() + smallCloud);
  }

  const Execution& Run;
  SampleTree<TSample>& Tree;
  TRanks& Ranks;
  LeafValues<TSample>& Values;
  const double Isovalue;
  std::unique_ptr<KeptTetrahedra>& Kept;
  std::unique_ptr<KeptTetrahedra> Current;
  static constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();
  const std::size_t Most; // tetrahedra of all samples
  bool MayInsertAll = true;
  bool IsInsertingAll = false;
  bool IsBody = false;
  std::atomic<std::size_t> Visits{ 0 }; // nodes and list entries visited, or equal work
  std::atomic<std::size_t> Searches{ 0 };
  TetrahedraCounts Counts;
  static constexpr double searchEnd = 0.1; // share of the progress
  double StepEnd = searchEnd;
};

} // namespace isopoint
