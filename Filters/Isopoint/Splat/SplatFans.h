// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatFans_h
#define isopoint_SplatFans_h

#include "Isopoint/Base/TangentFrame.h"
#include "Isopoint/Base/Vector.h"
#include "Isopoint/Splat/Splat.h"
#include "Isopoint/Splat/SplatCell.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace isopoint
{

/// How many corners of cells are brought together, at most.
constexpr std::size_t mostMeeting = 6;

/// How far away points matter for a splat, in rings (see IsopointNeighbors): of cells that meet
/// each is in the third ring of the next, and so are those that share their sides.
constexpr int fanRings = 3 * static_cast<int>(mostMeeting);

/// Makes splats of cells: lowers their corners onto the surface, and brings those together that
/// meet; see docs/algorithm.md, section 12.6.
class SplatFans
{
public:
  /// @param splats of which normals are set
  /// @param cells withMutualSides() of all points within fanRings of those that are shaped; may be
  /// filled later
  SplatFans(const std::vector<Vector>& positions, const std::vector<Splat>& splats,
    const std::vector<SplatCell>& cells)
    : Positions(positions)
    , Splats(splats)
    , Cells(cells)
  {
  }

  /// Sets all of a splat but its normal. O(1)
  void shape(std::size_t point, Splat& splat) const;

private:
  /// A corner of a point's cell.
  struct Corner
  {
    std::size_t point;
    std::size_t number;
  };

  /// A corner on the surface.
  struct Place
  {
    Corner corner;
    Vector position;
    Vector normal;   // of length 1
    double distance; // from the point, in its tangent plane
  };

  /// The corners of cells that meet, each once, in the order of points and numbers.
  struct Meeting
  {
    std::array<Place, mostMeeting> places{};
    std::size_t count = 0;
    bool isTooLarge = false;    // then they are not brought together
    bool isOverlapping = false; // so are they not; see SplatCell::overlapping

    void add(const Place& place);
  };

  std::optional<Corner> across(const Corner& corner, bool isOnward) const;
  std::size_t beyond(const Corner& corner, bool isOnward) const;
  bool isBetweenPoints(const Corner& corner) const;
  Place placeOf(const Corner& corner) const;
  bool areClose(const Place& a, const Place& b) const;
  bool follow(const Place& first, bool isOnward, Meeting& meeting) const;
  Place joined(const Corner& corner) const;
  static void turnOneWay(const TangentFrame& frame, std::size_t count,
    std::array<Vector, mostCorners>& offsets, std::array<Vector, mostCorners>& normals);

  const std::vector<Vector>& Positions;
  const std::vector<Splat>& Splats;
  const std::vector<SplatCell>& Cells;
};

} // namespace isopoint

#endif
