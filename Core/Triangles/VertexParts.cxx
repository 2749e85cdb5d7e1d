// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/VertexParts.h"

#include "Core/Base/Lists.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace isopoint
{
namespace
{

/// The distinct groups, or parts, of a triangle's vertices.
class LabelsOfTriangle
{
public:
  LabelsOfTriangle(const std::vector<std::size_t>& labels, const SurfaceTriangle& triangle)
  {
    for (const std::size_t vertex : triangle)
    {
      const std::size_t label = labels[vertex];
      if (label != VertexParts::none && std::find(this->begin(), this->end(), label) == this->end())
      {
        this->Labels[this->Count++] = label;
      }
    }
  }

  const std::size_t* begin() const { return this->Labels.data(); }
  const std::size_t* end() const { return this->Labels.data() + this->Count; }

private:
  std::array<std::size_t, 3> Labels{};
  std::size_t Count = 0;
};

} // namespace

/// Labels the vertices of one group at a time by part. Reuses memory.
class VertexParts::Labeling
{
public:
  Labeling(const std::vector<SurfaceTriangle>& triangles, const std::vector<std::size_t>& groups)
    : Triangles(triangles)
    , Groups(groups)
  {
  }

  /// Sorts the vertices of a group by part, and appends the parts.
  /// @param own the vertices, at `begin` among those of all groups
  void label(std::size_t* own, std::size_t count, std::size_t begin,
    const IndexSpan<std::size_t>& around, std::vector<Part>& parts)
  {
    this->Members.assign(own, own + count);
    this->Roots.resize(count);
    std::iota(this->Roots.begin(), this->Roots.end(), std::size_t{ 0 });
    this->findEdges(around);
    for (const auto& [a, b] : this->Edges)
    {
      const auto [low, high] = std::minmax({ this->rootOf(a), this->rootOf(b) });
      this->Roots[high] = low;
    }
    this->countUp();
    std::sort(this->Order.begin(), this->Order.end());
    for (std::size_t first = 0, end = 0; first < count; first = end)
    {
      const std::size_t root = this->Order[first].first;
      for (; end < count && this->Order[end].first == root; ++end)
      {
        own[end] = this->Members[this->Order[end].second];
      }
      if (end - first > 1)
      {
        parts.push_back({ begin + first, begin + end, this->Characteristics[root] == 1 });
      }
    }
  }

private:
  using Edge = std::pair<std::size_t, std::size_t>;

  std::size_t placeOf(std::size_t vertex) const
  {
    return static_cast<std::size_t>(
      std::lower_bound(this->Members.begin(), this->Members.end(), vertex) - this->Members.begin());
  }

  /// The edges between members, and the triangles between three members.
  void findEdges(const IndexSpan<std::size_t>& around)
  {
    const std::size_t group = this->Groups[this->Members.front()];
    this->Edges.clear();
    this->Inner.clear();
    for (const std::size_t triangle : around)
    {
      std::array<std::size_t, 3> places{};
      std::size_t inside = 0;
      for (const std::size_t vertex : this->Triangles[triangle])
      {
        if (this->Groups[vertex] == group)
        {
          places[inside++] = this->placeOf(vertex);
        }
      }
      for (std::size_t i = 1; i < inside; ++i)
      {
        this->Edges.emplace_back(std::minmax(places[i - 1], places[i]));
      }
      if (inside == 3)
      {
        this->Edges.emplace_back(std::minmax(places[0], places[2]));
        this->Inner.push_back(places[0]);
      }
    }
    keepUnique(this->Edges);
  }

  std::size_t rootOf(std::size_t place)
  {
    while (this->Roots[place] != place)
    {
      place = this->Roots[place] = this->Roots[this->Roots[place]];
    }
    return place;
  }

  /// The Euler characteristic of each part, and the part of each member.
  void countUp()
  {
    this->Order.clear();
    this->Characteristics.assign(this->Members.size(), 0);
    for (std::size_t place = 0; place < this->Members.size(); ++place)
    {
      this->Order.emplace_back(this->rootOf(place), place);
      ++this->Characteristics[this->Order.back().first];
    }
    for (const Edge& edge : this->Edges)
    {
      --this->Characteristics[this->rootOf(edge.first)];
    }
    for (const std::size_t place : this->Inner)
    {
      ++this->Characteristics[this->rootOf(place)];
    }
  }

  const std::vector<SurfaceTriangle>& Triangles;
  const std::vector<std::size_t>& Groups;
  std::vector<std::size_t> Members;
  // Indices of members.
  std::vector<std::size_t> Roots; // of lower number, down to the first member of the part
  std::vector<Edge> Edges;
  std::vector<std::size_t> Inner; // triangles between three members, by one of them
  std::vector<std::pair<std::size_t, std::size_t>> Order; // roots, and members
  std::vector<std::ptrdiff_t> Characteristics;            // at the roots
};

VertexParts::VertexParts(const Execution& execution, const std::vector<SurfaceTriangle>& triangles,
  const std::vector<std::size_t>& groups, std::size_t groupCount)
  : PartOf(groups.size(), none)
{
  const ItemLists trianglesOfGroups(execution, groupCount, triangles.size(),
    [&](std::size_t triangle) { return LabelsOfTriangle(groups, triangles[triangle]); });
  ItemLists members(execution, groupCount, groups.size(),
    [&](std::size_t vertex) { return std::array{ groups[vertex] }; });
  std::vector<std::size_t> begins(groupCount + 1, groups.size());
  forEachIndex(execution, groupCount,
    [&](std::size_t group)
    { begins[group] = static_cast<std::size_t>(members.at(group).first - members.at(0).first); });
  this->Vertices = std::move(members).all();
  constexpr std::size_t grain = 1024;
  this->Parts = collected<Part>(execution, { groupCount, 8 * grain, grain },
    [&](std::size_t begin, std::size_t end, std::vector<Part>& found)
    {
      Labeling labeling(triangles, groups);
      for (std::size_t group = begin; group < end; ++group)
      {
        const std::size_t count = begins[group + 1] - begins[group];
        if (count > 1)
        {
          labeling.label(this->Vertices.data() + begins[group], count, begins[group],
            trianglesOfGroups.at(group), found);
        }
      }
    });
  forEachIndex(execution, this->Parts.size(),
    [this](std::size_t part)
    {
      for (const std::size_t vertex : this->verticesOf(part))
      {
        this->PartOf[vertex] = part;
      }
    });
  this->Triangles.emplace(execution, this->Parts.size(), triangles.size(),
    [&](std::size_t triangle) { return LabelsOfTriangle(this->PartOf, triangles[triangle]); });
}

} // namespace isopoint
