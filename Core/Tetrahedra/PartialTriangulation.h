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
#include <memory>
#include <vector>

namespace isopoint
{

/// A sample, or several coincident samples, as a vertex.
struct BandSite
{
  Vector position;
  std::uint64_t leaf; // node index in the tree, below 2^63
  bool isBelow;       // the isovalue
};

/// A tetrahedron with corners on both sides of the isovalue.
template <class TId>
struct CrossingTetrahedron
{
  /// Node indices of the leaves at the corners, those below first, in positive orientation.
  std::array<TId, 4> corners;
  std::uint8_t belowCount; // 1 to 3
  bool isAtHull;           // whether a crossing facet lies on the convex hull
};

/// The Delaunay tetrahedralization of a growing subset of the samples, by CGAL. Predicates are
/// exact. If more than four samples lie on an empty sphere, the lexicographic order of positions
/// decides. Therefore the result, and whether a position lies inside a sphere, depend only on the
/// set of positions.
///
/// A cell is a tetrahedron, or a facet of the convex hull with the half-space beyond it. A cell is
/// *crossing* if some corners are below the isovalue and others are not.
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
  /// @throws Aborted and what step throws, with some samples added; std::bad_alloc, after which
  /// only destruction is allowed
  void insert(const Execution& execution, const std::vector<BandSite>& sites,
    const std::function<void(double share)>& step);

  /// Sets the side of the isovalue of each sample. O(samples)
  /// @throws Aborted, after which some are set
  void setSides(const Execution& execution, const std::function<bool(std::uint64_t leaf)>& isBelow);

  std::size_t size() const;

  /// The number of cells, including those beyond the hull. O(1)
  std::size_t cellCount() const;

  /// 3, or less if all samples are coplanar (2), collinear (1), a single one (0), or none (-1).
  int dimension() const;

  bool raisesDimension(const Vector& position) const;

  /// Lists the crossing cells that are not certified, if the dimension is 3. Lists are valid until
  /// the next insertion. @returns their number. O(cells)
  /// @throws std::bad_alloc, Aborted
  std::size_t listOpenCells(const Execution& execution);

  /// Whether a listed cell is a facet of the hull; the corners of a listed tetrahedron or facet.
  bool isBeyondHull(std::size_t openCell) const;
  TetrahedronCorners tetrahedronAt(std::size_t openCell) const;
  HullFacetCorners hullFacetAt(std::size_t openCell) const;

  /// Whether a position, not of a corner, lies inside a listed cell's sphere; exact, decides ties.
  /// From any thread.
  bool isInside(std::size_t openCell, const Vector& position) const;

  /// Marks the sphere of a listed cell as empty. From any thread, once per cell.
  void certify(std::size_t openCell);

  /// For each position in no crossing cell, whether the corners of its cell are below the isovalue.
  /// From any thread. Fastest if consecutive positions are close.
  std::vector<bool> areBelow(const std::vector<Vector>& positions) const;

  /// Lists the crossing tetrahedra instead of open cells, in any order. @returns their number.
  /// O(cells)
  /// @throws std::bad_alloc, Aborted
  std::size_t listCrossingTetrahedra(const Execution& execution);

  /// Frees the memory of lists.
  void dropLists();

  /// A listed crossing tetrahedron. From any thread.
  CrossingTetrahedron<std::uint64_t> crossingTetrahedronAt(std::size_t tetrahedron) const;

private:
  class Internals;
  std::unique_ptr<Internals> Inside;
};

} // namespace isopoint
