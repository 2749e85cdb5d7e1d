// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_NearestPositions_h
#define isopoint_NearestPositions_h

#include "Isopoint/Base/Vector.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace isopoint
{

/// Finds the nearest ones among points of a surface. Those at one position count as one. Several
/// threads may search.
class NearestPositions
{
public:
  /// @throws std::bad_alloc. Complexity: O(n log n)
  explicit NearestPositions(const std::vector<Vector>& positions);
  ~NearestPositions();

  /// Lists that many points at other positions, by distance, or all there are; of those at one
  /// position the first.
  /// Complexity: O(count log n)
  void find(std::size_t point, std::size_t count, std::vector<std::size_t>& found) const;

private:
  struct Search;
  std::unique_ptr<const Search> Tree;
};

} // namespace isopoint

#endif
