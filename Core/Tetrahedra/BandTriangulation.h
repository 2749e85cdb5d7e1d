// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_BandTriangulation_h
#define isopoint_BandTriangulation_h

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

/// A sample, or several that coincide, as a vertex.
struct BandSite
{
  Vector position;
  std::uint64_t leaf; // its node index in the tree, below 2^63
  bool isBelow;       // the isovalue
};

/// A tetrahedron with corners on both sides of the isovalue.
template <class TId>
struct CrossingTetrahedron
{
  /// The node indices of the leaves at its corners, those below first; the orientation is positive.
  std::array<TId, 4> corners;
  std::uint8_t belowCount; // 1 to 3
  bool isAtHull;           // whether it has a crossing facet on the convex hull
};

/// The Delaunay tetrahedrization of some of the samples, which grows. It is that of CGAL, whose
/// predicates are exact and whose ties, where more than four samples lie on one empty sphere, are
/// decided by the lexicographic order of positions: it depends on the set of positions alone, and
/// so does whether a position lies inside a sphere.
///
/// A cell is a tetrahedron, or a facet of the convex hull with the half-space beyond it. It is
/// *crossing* if some corners are below the isovalue and others are not.
class BandTriangulation
{
public:
  /// @param unit of all positions that are asked for, and have not been inserted
  explicit BandTriangulation(const CoordinateUnit& unit);
  BandTriangulation(const BandTriangulation&) = delete;
  BandTriangulation& operator=(const BandTriangulation&) = delete;
  ~BandTriangulation();

  /// Adds samples, none of which coincide with another one; many at a time on all threads, where
  /// oneTBB is available.
  /// @param step(share) called from the calling thread with the share that is done, every few
  /// milliseconds
  /// @throws what step throws, and then some of them are added; std::bad_alloc, after which this
  /// can only be destroyed
  void insert(const Execution& execution, const std::vector<BandSite>& sites,
    const std::function<void(double share)>& step);

  /// Sets the sides of the isovalue on which samples are. O(samples)
  void setSides(const std::function<bool(std::uint64_t leaf)>& isBelow);

  std::size_t size() const;

  /// The number of cells, those beyond the hull included. O(1)
  std::size_t cellCount() const;

  /// Of the hull: 3, or less if all samples are coplanar (2), collinear (1), one (0), or none (-1).
  int dimension() const;

  /// Whether a sample at this position would raise the dimension.
  bool raisesDimension(const Vector& position) const;

  /// Lists the crossing cells that were not certified, if the dimension is 3. Lists are valid until
  /// the next insertion. @returns their number. O(cells)
  /// @throws std::bad_alloc, Aborted
  std::size_t listOpenCells(const Execution& execution);

  /// Of the listed cells: whether it is a facet of the hull; the corners of a tetrahedron, and
  /// those of a facet.
  bool isBeyondHull(std::size_t openCell) const;
  TetrahedronCorners tetrahedronAt(std::size_t openCell) const;
  HullFacetCorners hullFacetAt(std::size_t openCell) const;

  /// Whether a position, not that of a corner, lies inside the sphere of a listed cell, ties
  /// decided: exact. From any thread.
  bool isInside(std::size_t openCell, const Vector& position) const;

  /// Notes that no sample lies inside the sphere of a listed cell. From any thread, once for each.
  void certify(std::size_t openCell);

  /// On which side of the surface positions lie that are in no crossing cell.
  /// @returns for each whether the corners of its cell are below the isovalue. From any thread.
  /// Quickest if consecutive positions lie close together.
  std::vector<bool> areBelow(const std::vector<Vector>& positions) const;

  /// Lists the crossing tetrahedra, in any order, in place of the open cells. @returns their
  /// number. O(cells)
  /// @throws std::bad_alloc, Aborted
  std::size_t listCrossingTetrahedra(const Execution& execution);

  /// Gives back the memory of lists.
  void dropLists();

  /// One of the listed crossing tetrahedra. From any thread.
  CrossingTetrahedron<std::uint64_t> crossingTetrahedronAt(std::size_t tetrahedron) const;

private:
  class Internals;
  std::unique_ptr<Internals> Inside;
};

} // namespace isopoint

#endif
