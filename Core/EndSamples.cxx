// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/EndSamples.h"

#include "Core/Base/Lists.h"

#include <algorithm>
#include <cstddef>

namespace isopoint
{

std::vector<std::uint64_t> endSamples(const std::vector<ExtractedIsosurface>& surfaces)
{
  std::vector<std::uint64_t> ids;
  for (const ExtractedIsosurface& extracted : surfaces)
  {
    for (const IsopointEdge& edge : extracted.surface.edges)
    {
      ids.insert(ids.end(), { edge.first, edge.second });
    }
    for (const CoincidentSamples& group : extracted.surface.coincident)
    {
      ids.insert(ids.end(), group.ids.begin(), group.ids.end());
    }
  }
  keepUnique(ids);
  return ids;
}

void renumberEndSamples(
  std::vector<ExtractedIsosurface>& surfaces, const std::vector<std::uint64_t>& ids)
{
  const auto renumber = [&ids](std::uint64_t& id)
  { id = static_cast<std::uint64_t>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin()); };
  for (ExtractedIsosurface& extracted : surfaces)
  {
    for (IsopointEdge& edge : extracted.surface.edges)
    {
      renumber(edge.first);
      renumber(edge.second);
    }
    for (CoincidentSamples& group : extracted.surface.coincident)
    {
      std::for_each(group.ids.begin(), group.ids.end(), renumber);
    }
  }
}

std::vector<std::vector<std::uint64_t>> idsByRank(
  const std::vector<std::uint64_t>& ids, const std::vector<std::uint64_t>& counts)
{
  std::vector<std::vector<std::uint64_t>> byRank(counts.size());
  std::uint64_t first = 0;
  auto next = ids.begin();
  for (std::size_t rank = 0; rank < counts.size(); ++rank)
  {
    for (; next != ids.end() && *next < first + counts[rank]; ++next)
    {
      byRank[rank].push_back(*next - first);
    }
    first += counts[rank];
  }
  return byRank;
}

} // namespace isopoint
