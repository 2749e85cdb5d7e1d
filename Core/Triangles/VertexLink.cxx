// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/VertexLink.h"

#include "Core/Base/Lists.h"

#include <algorithm>

namespace isopoint
{

bool VertexLink::isCycleOrPath()
{
  std::sort(this->Edges.begin(), this->Edges.end());
  this->Ends.clear();
  for (const DirectedEdge& edge : this->Edges)
  {
    this->Ends.push_back(edge.second);
  }
  std::sort(this->Ends.begin(), this->Ends.end());
  const auto begin = this->Edges.begin();
  const auto end = this->Edges.end();
  const auto isSameStart = [](const DirectedEdge& a, const DirectedEdge& b)
  { return a.first == b.first; };
  if (this->Edges.empty() || std::adjacent_find(begin, end, isSameStart) != end ||
      std::adjacent_find(this->Ends.begin(), this->Ends.end()) != this->Ends.end())
  {
    return false;
  }
  // Each vertex has at most one successor and one predecessor. So the edges are one path or cycle
  // if a path or cycle includes all of them.
  const auto start = std::find_if(begin, end,
    [this](const DirectedEdge& edge)
    { return !std::binary_search(this->Ends.begin(), this->Ends.end(), edge.first); });
  this->IsPath = start != end;
  const std::size_t first = this->IsPath ? start->first : begin->first;
  std::size_t length = 0;
  std::size_t at = first;
  do
  {
    const auto next = std::lower_bound(begin, end, DirectedEdge(at, 0));
    if (next == end || next->first != at)
    {
      break;
    }
    at = next->second;
    ++length;
  } while (at != first);
  return length == this->Edges.size() && (this->IsPath || length >= 3);
}

bool VertexLink::hasVertex(std::size_t vertex) const
{
  const auto edge =
    std::lower_bound(this->Edges.begin(), this->Edges.end(), DirectedEdge(vertex, 0));
  return (edge != this->Edges.end() && edge->first == vertex) ||
         std::binary_search(this->Ends.begin(), this->Ends.end(), vertex);
}

std::vector<std::size_t> branchedVertices(
  const Execution& execution, const std::vector<SurfaceTriangle>& triangles, std::size_t count)
{
  const ItemLists around(execution, count, triangles.size(),
    [&](std::size_t triangle) -> const SurfaceTriangle& { return triangles[triangle]; });
  constexpr std::size_t grain = 4096;
  return collected<std::size_t>(execution, { count, 4 * grain, grain },
    [&](std::size_t begin, std::size_t end, std::vector<std::size_t>& found)
    {
      VertexLink link;
      for (std::size_t vertex = begin; vertex < end; ++vertex)
      {
        link.clear();
        for (const std::size_t triangle : around.at(vertex))
        {
          const auto& [a, b, c] = triangles[triangle];
          link.add(a == vertex ? b : b == vertex ? c : a, a == vertex ? c : b == vertex ? a : b);
        }
        if (!link.isCycleOrPath())
        {
          found.push_back(vertex);
        }
      }
    });
}

} // namespace isopoint
