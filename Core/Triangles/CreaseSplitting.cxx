// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/CreaseMesh.h"

#include "Core/Base/Lists.h"
#include "Core/Base/Sorting.h"
#include "Core/Fit/SurfacePiece.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace isopoint
{
namespace
{

/// The maximum distance of a crease vertex from the middle of its edge, in lengths of the edge.
constexpr double maxOffset = 1.0;

/// The maximum distance of a corner vertex from the middle of its triangle, in longest edges.
constexpr double maxCornerOffset = 2.0;

class CreaseSplitter
{
public:
  CreaseSplitter(const Execution& execution, CreaseSurface& whole)
    : Run(execution)
    , Whole(whole)
  {
  }

  /// Merges lost vertices with the nearest neighbor that inverts no triangle. Sets Pieces.
  std::vector<Facet> withoutLost(const std::vector<Facet>& facets)
  {
    FacetMesh mesh(this->Run, this->Whole.surface.positions, this->Whole.isInner, facets);
    forEachInOrder(this->Run, this->Whole.isInner.size(),
      [&](std::size_t vertex)
      {
        if (this->Whole.isInner[vertex] &&
            this->isLost(vertex, mesh.connectivity().neighborsOf(vertex)))
        {
          this->mergeWithNearest(mesh, vertex);
        }
      });
    this->Pieces = tabulated<std::size_t>(this->Run, this->Whole.isInner.size(),
      [&](std::size_t vertex)
      { return this->Whole.isInner[vertex] ? this->pieceOf(mesh, vertex) : vertex; });
    return mesh.facets();
  }

  std::vector<Facet> split(const std::vector<Facet>& facets)
  {
    this->Edges = collectedFromEach<Edge>(this->Run, 3 * facets.size(),
      [&](HalfEdge side, std::vector<Edge>& found)
      {
        const SurfaceTriangle& corners = facets[side / 3].corners;
        const Edge edge = std::minmax({ corners[side % 3], corners[(side + 1) % 3] });
        if (this->isAcrossCrease(edge.first, edge.second))
        {
          found.push_back(edge);
        }
      });
    this->Edges = sortedUnique(this->Run, this->Edges, this->Whole.surface.size(),
      [](const Edge& edge) { return static_cast<std::uint64_t>(edge.first); });
    std::vector<std::optional<Vector>> positions(this->Edges.size());
    forBatches(this->Run, positions.size(), 256, 64,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          positions[i] = this->positionOnCrease(this->Edges[i].first, this->Edges[i].second);
        }
      });
    this->OnEdges.resize(positions.size());
    forEachInOrder(this->Run, positions.size(),
      [&](std::size_t i)
      {
        if (positions[i])
        {
          const auto& [a, b] = this->Edges[i];
          this->OnEdges[i] = this->Whole.addVertex(a, *positions[i], { a, b });
        }
      });
    std::vector<Facet> parts;
    forEachInOrder(
      this->Run, facets.size(), [&](std::size_t i) { this->addParts(facets[i], parts); });
    return parts;
  }

private:
  void addParts(const Facet& facet, std::vector<Facet>& parts)
  {
    std::array<std::optional<std::size_t>, 3> onEdges;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      onEdges[i] = this->vertexOnCrease(facet.corners[i], facet.corners[(i + 1) % 3]);
      count += onEdges[i] ? 1 : 0;
    }
    // Rotates the corner that differs to the front.
    const auto rotatedTo = [&](std::size_t first)
    {
      return std::array{ facet.corners[first], facet.corners[(first + 1) % 3],
        facet.corners[(first + 2) % 3] };
    };
    if (count == 0)
    {
      parts.push_back(this->Whole.facetOf(facet.corners));
    }
    else if (count == 1)
    {
      const std::size_t edge = onEdges[0] ? 0 : onEdges[1] ? 1 : 2;
      const auto [a, b, c] = rotatedTo(edge);
      parts.push_back({ { a, *onEdges[edge], c }, this->Whole.normalOf({ a, c }) });
      parts.push_back({ { *onEdges[edge], b, c }, this->Whole.normalOf({ b, c }) });
    }
    else if (count == 2)
    {
      const std::size_t whole = !onEdges[0] ? 0 : !onEdges[1] ? 1 : 2;
      const auto [a, b, c] = rotatedTo((whole + 2) % 3);
      this->addTwoPieces(a, b, c, *onEdges[(whole + 2) % 3], *onEdges[(whole + 1) % 3], parts);
    }
    else
    {
      this->addThreePieces(facet.corners, { *onEdges[0], *onEdges[1], *onEdges[2] }, parts);
    }
  }

  /// @param a alone on its piece; ab, ca the crossings of the crease
  void addTwoPieces(std::size_t a, std::size_t b, std::size_t c, std::size_t ab, std::size_t ca,
    std::vector<Facet>& parts) const
  {
    const auto lengthBetween = [this](std::size_t p, std::size_t q)
    { return lengthOf(this->Whole.surface.positions[p] - this->Whole.surface.positions[q]); };
    const Vector normal = this->Whole.normalOf({ b, c });
    parts.push_back({ { a, ab, ca }, this->Whole.normals[a] });
    if (lengthBetween(ab, c) < lengthBetween(ca, b))
    {
      parts.push_back({ { ab, b, c }, normal });
      parts.push_back({ { ab, c, ca }, normal });
    }
    else
    {
      parts.push_back({ { ab, b, ca }, normal });
      parts.push_back({ { b, c, ca }, normal });
    }
  }

  void addThreePieces(const SurfaceTriangle& corners, const std::array<std::size_t, 3>& onEdges,
    std::vector<Facet>& parts)
  {
    const auto& [a, b, c] = corners;
    const auto& [ab, bc, ca] = onEdges;
    if (const std::optional<Vector> position = this->positionOfCorner(corners))
    {
      const std::size_t corner = this->Whole.addVertex(a, *position, { a, b, c });
      for (const auto& [piece, from, to] :
        { std::array{ a, ca, ab }, std::array{ b, ab, bc }, std::array{ c, bc, ca } })
      {
        parts.push_back({ { piece, to, corner }, this->Whole.normals[piece] });
        parts.push_back({ { piece, corner, from }, this->Whole.normals[piece] });
      }
      return;
    }
    parts.push_back({ { a, ab, ca }, this->Whole.normals[a] });
    parts.push_back({ { b, bc, ab }, this->Whole.normals[b] });
    parts.push_back({ { c, ca, bc }, this->Whole.normals[c] });
    parts.push_back({ { ab, bc, ca }, this->Whole.normalOf({ a, b, c }) });
  }

  std::optional<Vector> positionOfCorner(const SurfaceTriangle& corners) const
  {
    const auto& [a, b, c] = corners;
    const std::vector<Vector>& positions = this->Whole.surface.positions;
    const Vector center = 1.0 / 3.0 * (positions[a] + positions[b] + positions[c]);
    const Vector position = meetingOf(this->piecesAt({ a, b, c }), center);
    const double longest = std::max({ lengthOf(positions[a] - positions[b]),
      lengthOf(positions[b] - positions[c]), lengthOf(positions[c] - positions[a]) });
    return isFinite(position) && lengthOf(position - center) <= maxCornerOffset * longest
             ? std::optional(position)
             : std::nullopt;
  }

  /// Whether a vertex's piece is unknown: it has no fit, or a smooth fit that disagrees with all
  /// neighbors whose fits have the crease.
  bool isLost(std::size_t vertex, const std::vector<std::size_t>& neighbors) const
  {
    const auto knowsCrease = [this](std::size_t neighbor)
    { return this->Whole.isCrease(neighbor); };
    const auto agrees = [&](std::size_t neighbor)
    { return this->Whole.isCrease(neighbor) && this->Whole.isAlike(vertex, neighbor); };
    return !this->Whole.isFitted(vertex) ||
           (!this->Whole.isCrease(vertex) &&
             std::any_of(neighbors.begin(), neighbors.end(), knowsCrease) &&
             std::none_of(neighbors.begin(), neighbors.end(), agrees));
  }

  /// The selected neighbors with their distances, nearest first.
  template <class IsWanted>
  std::vector<std::pair<double, std::size_t>> nearestNeighbors(
    const FacetMesh& mesh, std::size_t vertex, const IsWanted& isWanted) const
  {
    std::vector<std::pair<double, std::size_t>> byDistance;
    for (const std::size_t neighbor : mesh.connectivity().neighborsOf(vertex))
    {
      if (isWanted(neighbor))
      {
        byDistance.emplace_back(
          lengthOf(this->Whole.surface.positions[neighbor] - this->Whole.surface.positions[vertex]),
          neighbor);
      }
    }
    std::sort(byDistance.begin(), byDistance.end());
    return byDistance;
  }

  void mergeWithNearest(FacetMesh& mesh, std::size_t vertex) const
  {
    const auto isUpright = [&](const Facet& moved)
    { return mesh.signedArea(this->Whole.facetOf(moved.corners)) > 0.0; };
    const auto isAny = [](const Facet&) { return true; }; // edges are flipped later
    const auto neighbors = this->nearestNeighbors(
      mesh, vertex, [this](std::size_t each) { return this->Whole.isFitted(each); });
    const auto mergesWith = [&](const auto& isAllowed)
    {
      return std::any_of(neighbors.begin(), neighbors.end(),
        [&](const auto& neighbor) { return mesh.collapse(vertex, neighbor.second, isAllowed); });
    };
    if (!mergesWith(isUpright))
    {
      mergesWith(isAny);
    }
  }

  /// The vertex whose fit describes a vertex's piece. Smooth fits near a crease are rounded; the
  /// fit of the nearest neighbor on the piece with the crease is used instead.
  std::size_t pieceOf(const FacetMesh& mesh, std::size_t vertex) const
  {
    if (this->Whole.isCrease(vertex))
    {
      return vertex;
    }
    const auto alike = this->nearestNeighbors(mesh, vertex,
      [&](std::size_t each)
      { return this->Whole.isCrease(each) && this->Whole.isAlike(vertex, each); });
    return alike.empty() ? vertex : alike.front().second;
  }

  std::size_t pieceCount(std::size_t vertex) const
  {
    return this->Whole.fitOf(this->Pieces[vertex]).creases.size() + 1;
  }

  /// The pieces of vertices: from the fit with the most pieces if it has all, otherwise from their
  /// own.
  std::vector<SurfacePiece> piecesAt(const std::vector<std::size_t>& vertices) const
  {
    const std::size_t viewer = *std::max_element(vertices.begin(), vertices.end(),
      [this](std::size_t a, std::size_t b) { return this->pieceCount(a) < this->pieceCount(b); });
    std::vector<SurfacePiece> own;
    std::vector<SurfacePiece> seen;
    for (const std::size_t vertex : vertices)
    {
      own.emplace_back(this->Whole.fitOf(this->Pieces[vertex]));
      if (const std::optional<SurfacePiece> piece = this->pieceSeenFrom(viewer, vertex))
      {
        seen.push_back(*piece);
      }
    }
    return seen.size() == own.size() ? seen : own;
  }

  /// The piece of a vertex according to another vertex's fit: the vertex's own piece if that fit
  /// has no more pieces, otherwise the piece with the most similar normal, if any is similar.
  std::optional<SurfacePiece> pieceSeenFrom(std::size_t viewer, std::size_t vertex) const
  {
    const LocalFit& fit = this->Whole.fitOf(this->Pieces[viewer]);
    if (this->pieceCount(viewer) == this->pieceCount(vertex))
    {
      return SurfacePiece(this->Whole.fitOf(this->Pieces[vertex]));
    }
    const CreasePlane* closest = nullptr;
    double cosine = maxCreaseCosine;
    for (const CreasePlane& plane : fit.creases)
    {
      const double own = std::abs(dot(plane.inward, this->Whole.normals[vertex]));
      if (own >= cosine)
      {
        closest = &plane;
        cosine = own;
      }
    }
    return closest ? std::optional(SurfacePiece(fit.position, *closest)) : std::nullopt;
  }

  using Edge = std::pair<std::size_t, std::size_t>; // the lower vertex first

  bool isAcrossCrease(std::size_t a, std::size_t b) const
  {
    return this->Whole.isInner[a] && this->Whole.isInner[b] && this->Whole.isFitted(a) &&
           this->Whole.isFitted(b) && (this->Whole.isCrease(a) || this->Whole.isCrease(b)) &&
           !this->Whole.isAlike(a, b);
  }

  /// The crossing of the crease by an edge that follows both pieces.
  std::optional<Vector> positionOnCrease(std::size_t a, std::size_t b) const
  {
    const Vector& p = this->Whole.surface.positions[a];
    const Vector& q = this->Whole.surface.positions[b];
    const std::vector<SurfacePiece> pieces = this->piecesAt({ a, b });
    const Vector center = 0.5 * (p + q);
    const Vector meeting = meetingOf(pieces, center);
    const Vector along = directionOf(cross(this->Whole.normals[a], this->Whole.normals[b]));
    const auto offsetOf = [&](const Vector& position)
    {
      const Vector offset = position - meeting;
      const double shift = dot(offset, along);
      return std::pair(shift, lengthOf(offset - shift * along));
    };
    const auto [pShift, pOff] = offsetOf(p);
    const auto [qShift, qOff] = offsetOf(q);
    const double off = pOff + qOff;
    const double shift = off > 0.0 ? (pShift * qOff + qShift * pOff) / off : 0.0;
    const Vector position = meetingOf(pieces, meeting + shift * along);
    const double length = lengthOf(q - p);
    return isFinite(position) && lengthOf(position - center) <= maxOffset * length
             ? std::optional(position)
             : std::nullopt;
  }

  std::optional<std::size_t> vertexOnCrease(std::size_t a, std::size_t b) const
  {
    const Edge edge = std::minmax(a, b);
    const auto found = std::lower_bound(this->Edges.begin(), this->Edges.end(), edge);
    return found != this->Edges.end() && *found == edge
             ? this->OnEdges[static_cast<std::size_t>(found - this->Edges.begin())]
             : std::nullopt;
  }

  const Execution& Run;
  CreaseSurface& Whole;
  std::vector<std::size_t> Pieces; // the vertex whose fit describes a vertex's piece
  std::vector<Edge> Edges;         // across creases, ordered
  std::vector<std::optional<std::size_t>> OnEdges; // the vertex on each of these
};

} // namespace

std::vector<Facet> splitAtCreases(
  const Execution& execution, CreaseSurface& whole, const std::vector<Facet>& facets)
{
  CreaseSplitter splitter(execution, whole);
  return splitter.split(splitter.withoutLost(facets));
}

} // namespace isopoint
