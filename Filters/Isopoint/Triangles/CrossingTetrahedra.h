// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_CrossingTetrahedra_h
#define isopoint_CrossingTetrahedra_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Neighbors/NeighborSearch.h"
#include "Isopoint/Tree/LeafValueCache.h"
#include "Isopoint/Triangles/BandTriangulation.h"
#include "Isopoint/Triangles/NodeMarks.h"
#include "Isopoint/Triangles/SideCheck.h"
#include "Isopoint/Triangles/SphereSearch.h"
#include "Isopoint/Triangles/TreeRefinement.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace isopoint
{

/// What finding the crossing tetrahedra took.
struct TetrahedraCounts
{
  std::size_t band = 0;     // samples near the surface, tetrahedrised first
  std::size_t inserted = 0; // added since
  std::size_t rounds = 0;
  bool isWhole = false; // whether all samples were tetrahedrised in the end
};

/// Finds the crossing tetrahedra of the Delaunay tetrahedrisation of all samples of a tree, without
/// that tetrahedrisation: docs/triangles.md, which proves that they are these.
template <class TSample>
class CrossingTetrahedraFinder
{
public:
  using Id = typename TSample::Id;

  /// @param tree refined around the isovalue (see NarrowBand); will be refined further
  /// @param values of the tree's leaves
  CrossingTetrahedraFinder(const Execution& execution, SampleTree<TSample>& tree,
    SharedLeafMeans<TSample>& values, double isovalue)
    : Run(execution)
    , Tree(tree)
    , Means(values)
    , Isovalue(isovalue)
    , Band(execution)
  {
  }

  /// @param nodes below which all leaves are that touch a leaf on the other side of the isovalue
  /// @throws std::bad_alloc, Aborted, or std::length_error (see NarrowBand)
  std::vector<CrossingTetrahedron<Id>> find(const std::vector<BinaryIndex>& nodes)
  {
    this->Marks.grow(this->Tree.nodes.size());
    std::vector<std::size_t> leaves = this->leavesAtSurface(nodes);
    this->Counts.band = leaves.size();
    if (this->areMany(leaves.size()))
    {
      this->insertAll();
    }
    this->insert(std::move(leaves));
    this->spanSpace();
    while (!this->Counts.isWhole && this->Band.dimension() == 3)
    {
      throwIfAborted(this->Run);
      ++this->Counts.rounds;
      if (!this->certify() && !this->checkSides())
      {
        break;
      }
      if (this->isSpent())
      {
        this->insertAll();
      }
    }
    this->Counts.inserted = this->Band.size() - this->Counts.band;
    return this->crossing();
  }

  const TetrahedraCounts& counts() const { return this->Counts; }

private:
  std::vector<CrossingTetrahedron<Id>> crossing() const
  {
    std::vector<CrossingTetrahedron<Id>> result;
    this->Band.visitCrossing(
      [&result](const CrossingTetrahedron<std::uint64_t>& tetrahedron)
      {
        CrossingTetrahedron<Id> narrow{ {}, tetrahedron.belowCount };
        std::transform(tetrahedron.corners.begin(), tetrahedron.corners.end(),
          narrow.corners.begin(), [](std::uint64_t leaf) { return static_cast<Id>(leaf); });
        result.push_back(narrow);
      });
    return result;
  }

  /// The leaves that touch one on the other side.
  std::vector<std::size_t> leavesAtSurface(const std::vector<BinaryIndex>& nodes)
  {
    std::vector<std::size_t> leaves;
    std::mutex mutex;
    constexpr std::size_t grain = 256;
    forBatches(this->Run, nodes.size(), 8 * grain, grain,
      [&](std::size_t begin, std::size_t end)
      {
        LeafValueCache<TSample> values(this->Tree, this->Means);
        std::vector<std::size_t> found;
        Path path = pathToRoot(this->Tree);
        for (std::size_t i = begin; i < end; ++i)
        {
          moveTo(this->Tree, path, nodes[i]);
          forEachBelow(this->Tree, path, maximumDepth,
            [&](const Path& leaf)
            {
              const bool isBelow = values.at(leaf.nodeIndex()) < this->Isovalue;
              if (touchesOtherSide(this->Tree, leaf, maximumDepth, this->Isovalue, isBelow))
              {
                found.push_back(leaf.nodeIndex());
              }
            });
        }
        const std::lock_guard<std::mutex> lock(mutex);
        leaves.insert(leaves.end(), found.begin(), found.end());
      });
    return leaves;
  }

  /// Adds leaves to the band.
  /// @param leaves in any order, with repetitions
  void insert(std::vector<std::size_t> leaves)
  {
    // The same order for any number of threads.
    std::sort(leaves.begin(), leaves.end());
    leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
    LeafValueCache<TSample> values(this->Tree, this->Means);
    std::vector<BandSite> sites;
    sites.reserve(leaves.size());
    for (const std::size_t leaf : leaves)
    {
      if (!this->Marks.isInBand(leaf))
      {
        this->Marks.addToBand(leaf);
        sites.push_back({ positionOf(this->Tree.samples[this->Tree.nodes[leaf].begin]), leaf,
          values.at(leaf) < this->Isovalue });
      }
    }
    this->Band.insert(sites,
      [this](double share)
      {
        throwIfAborted(this->Run);
        this->report(share);
      });
  }

  void split(const std::vector<std::size_t>& nodes)
  {
    splitFurther(this->Run, this->Tree, nodes);
    this->Marks.grow(this->Tree.nodes.size());
  }

  /// Inserts all samples.
  void insertAll()
  {
    splitCompletely(this->Run, this->Tree);
    this->Marks.grow(this->Tree.nodes.size());
    std::vector<std::size_t> leaves;
    Path path = pathToRoot(this->Tree);
    forEachBelow(this->Tree, path, maximumDepth,
      [&leaves](const Path& leaf) { leaves.push_back(leaf.nodeIndex()); });
    this->insert(std::move(leaves));
    this->Counts.isWhole = true;
  }

  /// Inserts samples until the band's are not coplanar, unless all are.
  void spanSpace()
  {
    while (this->Band.size() > 0 && this->Band.dimension() < 3)
    {
      const std::optional<std::size_t> node = this->nodeOffBand();
      if (!node)
      {
        return;
      }
      if (this->Tree.nodes[*node].isLeaf)
      {
        this->insert({ *node });
      }
      else
      {
        this->split({ *node });
      }
    }
  }

  /// A node without children with a sample that would raise the dimension of the band.
  std::optional<std::size_t> nodeOffBand()
  {
    std::optional<std::size_t> found;
    Path path = pathToRoot(this->Tree);
    forEachBelow(this->Tree, path, maximumDepth,
      [&](const Path& below)
      {
        const Node<TSample>& node = this->Tree.nodes[below.nodeIndex()];
        const std::size_t end = node.isLeaf ? node.begin + 1 : node.end;
        for (std::size_t i = node.begin; i < end && !found; ++i)
        {
          if (this->Band.raisesDimension(positionOf(this->Tree.samples[i])))
          {
            found = below.nodeIndex();
          }
        }
      });
    return found;
  }

  /// Looks for samples inside the spheres of crossing cells, certifies cells without any, and
  /// inserts those found.
  /// @returns whether cells remain to be certified
  bool certify()
  {
    const std::size_t count = this->Band.listOpenCells();
    this->Visits += this->Band.cellCount();
    std::vector<std::size_t> found;
    std::vector<std::size_t> unsplit;
    std::mutex mutex;
    constexpr std::size_t grain = 512;
    forBatches(
      this->Run, count, 8 * grain, grain,
      [&](std::size_t begin, std::size_t end)
      {
        SphereSearch<TSample> search(this->Tree, this->Band, this->Marks);
        std::vector<std::size_t> foundHere;
        std::size_t visits = 0;
        for (std::size_t i = begin; i < end && !this->isSpent(); ++i)
        {
          if (const std::optional<std::size_t> leaf = search.find(i))
          {
            foundHere.push_back(*leaf);
          }
          else if (search.isComplete())
          {
            this->Band.certify(i);
          }
          this->Visits += search.visits() - visits;
          ++this->Searches;
          visits = search.visits();
        }
        const std::lock_guard<std::mutex> lock(mutex);
        found.insert(found.end(), foundHere.begin(), foundHere.end());
        unsplit.insert(unsplit.end(), search.unsplit().begin(), search.unsplit().end());
      },
      [this](double share) { this->report(share); });
    if (!this->isSpent())
    {
      this->split(unsplit);
      this->insert(std::move(found));
    }
    return count > 0;
  }

  /// Inserts samples whose value is on the other side than the band's surface has it.
  /// @returns whether there were any
  bool checkSides()
  {
    SideCheck<TSample> check(this->Run, this->Tree, this->Band, this->Marks, this->Means);
    const std::vector<std::size_t> nodes = check.find(this->Isovalue);
    std::vector<std::size_t> leaves;
    std::vector<std::size_t> unsplit;
    for (const std::size_t node : nodes)
    {
      (this->Tree.nodes[node].isLeaf ? leaves : unsplit).push_back(node);
    }
    this->split(unsplit);
    this->insert(std::move(leaves));
    return !nodes.empty();
  }

  /// Reports progress: half of the work is the first tetrahedrisation, most of the rest the first
  /// round.
  void report(double share)
  {
    const double begin = 1.0 - std::pow(0.4, static_cast<double>(this->Counts.rounds));
    this->Run.progress(begin + 0.5 * share * (1.0 - begin));
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
  /// huge spheres through voids, promise more of their kind: they get less.
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
  SharedLeafMeans<TSample>& Means;
  const double Isovalue;
  BandTriangulation Band;
  NodeMarks Marks;
  std::atomic<std::size_t> Visits{ 0 }; // of nodes, and of cells in lists, or as long as these
  std::atomic<std::size_t> Searches{ 0 };
  TetrahedraCounts Counts;
};

} // namespace isopoint

#endif
