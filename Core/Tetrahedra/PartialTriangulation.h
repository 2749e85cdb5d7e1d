// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Tetrahedra/CoordinateUnit.h"
#include "Core/Tetrahedra/SphereFunction.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace isopoint
{

/// A sample, or several coincident samples, to insert as a vertex.
struct Site
{
  Vector position;
  std::uint64_t leaf; // node index in the tree, below 2^63
  bool isBelow;       // the isovalue
};

/// A tetrahedron, mostly with corners on both sides of the isovalue.
struct LeafTetrahedron
{
  /// Node indices of the leaves at the corners, those below first, in positive orientation.
  std::array<std::size_t, 4> corners;
  std::uint8_t belowCount; // 1 to 3 if it is crossing
  bool isAtHull;           // whether a crossing facet lies on the convex hull
};

/// A facet of an explored tetrahedron, opposite to a corner.
struct ExploredFacet
{
  std::size_t tetrahedron;
  int corner; // 0 to 3

  bool operator==(const ExploredFacet& other) const
  {
    return this->tetrahedron == other.tetrahedron && this->corner == other.corner;
  }
};

/// The corners of a facet, counterclockwise seen from outside its tetrahedron.
struct FacetCorners
{
  std::array<std::size_t, 3> corners; // leaves
  std::array<bool, 3> areBelow;

  bool isAllBelow() const { return this->areBelow[0] && this->areBelow[1] && this->areBelow[2]; }
};

/// A cell of a PartialTriangulation, until the next insertion.
using CellHandle = struct OpaqueCell*;

/// The Delaunay tetrahedralization of a growing subset of the samples, by CGAL. Predicates are
/// exact, and the lexicographic order of positions breaks ties, so that results depend only on the
/// set of positions.
///
/// A cell is a tetrahedron, or a facet of the convex hull with the half-space beyond it. A cell is
/// *crossing* if some corners are below the isovalue and others are not. For bodies, the outside
/// counts as below: then facets of the hull are crossing if a corner is not below.
/// *Explored* tetrahedra have numbers from 0 on: first the crossing ones, then, step by step, the
/// *targets* across some of their facets. They are certified, so insertions do not change them.
class PartialTriangulation
{
public:
  /// @param unit of all positions inserted or queried
  explicit PartialTriangulation(const CoordinateUnit& unit);
  PartialTriangulation(const PartialTriangulation&) = delete;
  PartialTriangulation& operator=(const PartialTriangulation&) = delete;
  ~PartialTriangulation();

  /// Removes all samples, and frees their memory: some ten nanoseconds per cell.
  /// @throws Aborted, after which they are removed as well
  void clear(const Execution& execution);

  /// Adds distinct positions, on all threads if oneTBB is available.
  /// @param step(share) called from the calling thread every few milliseconds with the share done
  /// @param most stops soon after there are more cells; on one thread, always after as many samples
  /// @returns whether all positions were added
  /// @throws Aborted and what step throws, with some samples added; std::bad_alloc, after which
  /// only destruction is allowed
  bool insert(const Execution& execution, const std::vector<Site>& sites,
    const std::function<void(double share)>& step,
    std::size_t most = std::numeric_limits<std::size_t>::max());

  /// Sets the side of the isovalue of each sample. O(samples)
  /// @throws Aborted, after which some are set
  void setSides(const Execution& execution, const std::function<bool(std::uint64_t leaf)>& isBelow);

  /// Whether the outside counts as below; false at first.
  void setOutsideBelow(bool isBelow);

  std::size_t size() const;

  /// The number of cells, including those beyond the hull. O(1)
  std::size_t cellCount() const;

  /// 3, or less if all samples are coplanar (2), collinear (1), a single one (0), or none (-1).
  int dimension() const;

  bool raisesDimension(const Vector& position) const;

  /// The crossing cells that are not certified; none if the dimension is below 3. O(cells)
  /// @throws std::bad_alloc, Aborted
  std::vector<CellHandle> openCells(const Execution& execution);

  /// The crossing tetrahedra, in any order; none if the dimension is below 3. O(cells)
  /// @throws std::bad_alloc, Aborted
  std::vector<LeafTetrahedron> crossingTetrahedra(const Execution& execution);

  /// Whether a cell is a facet of the hull.
  bool isBeyondHull(CellHandle cell) const;

  /// The corners of a cell that is a tetrahedron.
  TetrahedronCorners tetrahedronOf(CellHandle cell) const;

  /// The corners of a cell that is a facet of the hull.
  HullFacetCorners hullFacetOf(CellHandle cell) const;

  /// Whether a position, not of a corner, lies inside a cell's sphere; exact, decides ties. From
  /// any thread.
  bool isInside(CellHandle cell, const Vector& position) const;

  /// Marks the sphere of a cell as empty. From any thread, once per cell.
  void certify(CellHandle cell);

  /// For each position in no crossing cell, whether the corners of its cell are below the isovalue.
  /// From any thread. Fastest if consecutive positions are close.
  std::vector<bool> areBelow(const std::vector<Vector>& positions) const;

  /// Explores the crossing tetrahedra, which must be certified, and nothing else. Targets are then
  /// the tetrahedra behind crossing facets of the hull. @returns the number of tetrahedra
  /// @param treeIndexOf(leaf) new tetrahedra are numbered in the order of these, since that of
  /// cells depends on threads and ranks
  /// @throws std::bad_alloc, Aborted
  std::size_t beginExploring(const Execution& execution,
    const std::function<std::uint64_t(std::uint64_t leaf)>& treeIndexOf);

  /// Makes the tetrahedra across facets of explored ones the targets.
  void targetAcross(const std::vector<ExploredFacet>& facets);

  /// The targets that are not certified, each once.
  std::vector<CellHandle> openTargets() const;

  /// Explores the targets, which must be certified. @returns the number of all explored
  /// @param treeIndexOf see beginExploring()
  /// @throws std::bad_alloc, Aborted
  std::size_t exploreTargets(const Execution& execution,
    const std::function<std::uint64_t(std::uint64_t leaf)>& treeIndexOf);

  /// Results of across() other than numbers of explored tetrahedra.
  static constexpr std::size_t outside = ~std::size_t{ 0 };
  static constexpr std::size_t unexplored = outside - 1;

  /// The tetrahedron across a facet, `unexplored`, or `outside`. From any thread.
  std::size_t across(const ExploredFacet& facet) const;

  FacetCorners cornersOf(const ExploredFacet& facet) const;
  LeafTetrahedron exploredTetrahedron(std::size_t tetrahedron) const;

  /// Turns from a facet at the border of a body around one of its edges, through the body, to the
  /// next facet at the border. From any thread. O(tetrahedra at the edge)
  /// @param side of the facet: from corner `side` to the next
  /// @param areInGap explored tetrahedra that are not in the body
  ExploredFacet nextBorderFacet(
    const ExploredFacet& facet, std::size_t side, const std::vector<char>& areInGap) const;

private:
  class Internals;
  std::unique_ptr<Internals> Inside;
};

} // namespace isopoint
