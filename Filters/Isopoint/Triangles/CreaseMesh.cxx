// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Triangles/CreaseMesh.h"

#include "Isopoint/Base/SortUnique.h"
#include "Isopoint/Triangles/FacetMesh.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace isopoint
{
namespace
{

/// A crease's vertex is at most this many lengths of the edge away from the middle of it.
constexpr double mostOffset = 1.0;

/// Facets of a vertex whose normals form a smaller cosine, of 20 degrees or more with it, get a
/// copy of it.
constexpr double mostPartedCosine = 0.94;

/// The vertex of a corner is at most this many lengths of the longest edge away from the middle of
/// the triangle.
constexpr double mostCornerOffset = 2.0;

/// One of the smooth pieces that meet at a crease: where a function of degree two is zero.
struct Piece
{
  Vector place; // on it
  Vector slope; // there, of length 1
  Hessian bend; // over the slope

  explicit Piece(const LocalFit& fit)
    : place(fit.position)
    , slope(directionOf(fit.gradient))
    , bend(fit.hessian)
  {
    for (double& each : this->bend)
    {
      each /= lengthOf(fit.gradient);
    }
  }

  /// The tangent plane of another piece of a vertex's fit.
  Piece(const Vector& vertex, const CreasePlane& plane)
    : place(sum(vertex, -plane.distance, plane.inward))
    , slope(plane.inward)
    , bend{}
  {
  }

  double valueAt(const Vector& position) const
  {
    const Vector o = difference(position, this->place);
    return 0.5 * dot(sum(this->slope, 1.0, this->slopeAt(position)), o);
  }

  Vector slopeAt(const Vector& position) const
  {
    const Vector o = difference(position, this->place);
    const Hessian& h = this->bend;
    return { this->slope[0] + h[0] * o[0] + h[3] * o[1] + h[4] * o[2],
      this->slope[1] + h[3] * o[0] + h[1] * o[1] + h[5] * o[2],
      this->slope[2] + h[4] * o[0] + h[5] * o[1] + h[2] * o[2] };
  }
};

/// The place near another one where two or three pieces meet: Newton's steps of least length. Not
/// finite where they do not.
template <int count>
Vector meetingOf(const std::array<Piece, count>& pieces, const Vector& from)
{
  constexpr int steps = 4;
  Vector place = from;
  for (int step = 0; step < steps; ++step)
  {
    Eigen::Matrix<double, count, 3> slopes;
    Eigen::Matrix<double, count, 1> levels;
    for (int i = 0; i < count; ++i)
    {
      const Piece& piece = pieces[static_cast<std::size_t>(i)];
      const Vector slope = piece.slopeAt(place);
      slopes.row(i) << slope[0], slope[1], slope[2];
      levels[i] = piece.valueAt(place);
    }
    const Eigen::Matrix<double, count, count> products = slopes * slopes.transpose();
    const Eigen::Vector3d move = slopes.transpose() * (products.inverse() * levels);
    place = { place[0] - move[0], place[1] - move[1], place[2] - move[2] };
  }
  return place;
}

bool isFinite(const Vector& vector)
{
  return std::isfinite(vector[0]) && std::isfinite(vector[1]) && std::isfinite(vector[2]);
}

Vector middle(const Vector& a, const Vector& b)
{
  return scaled(0.5, sum(a, 1.0, b));
}

class CreaseMesher
{
public:
  CreaseMesher(
    const Execution& execution, Isosurface& surface, std::vector<SurfaceTriangle>& triangles)
    : Run(execution)
    , Surface(surface)
    , Triangles(triangles)
  {
  }

  void mesh(bool parts)
  {
    this->computeNormals();
    std::vector<Facet> facets = this->takeFacets();
    if (facets.empty())
    {
      return;
    }
    facets = this->withoutUnfitted(std::move(facets));
    facets = this->split(facets);
    facets = this->untangled(std::move(facets));
    if (parts)
    {
      this->partCreases(facets);
    }
    for (const Facet& facet : facets)
    {
      this->Triangles.push_back(facet.corners);
    }
    this->order();
  }

private:
  const LocalFit& fitOf(std::size_t vertex) const { return this->Surface.fits[vertex]; }
  bool isFitted(std::size_t vertex) const { return this->fitOf(vertex).order.has_value(); }
  bool isCrease(std::size_t vertex) const { return this->fitOf(vertex).order == FitOrder::Crease; }

  void computeNormals()
  {
    this->Normals.reserve(this->Surface.size());
    for (const LocalFit& fit : this->Surface.fits)
    {
      this->Normals.push_back(scaled(-1.0, directionOf(fit.gradient)));
    }
  }

  /// Takes the triangles beside creases out of the surface, and those around.
  std::vector<Facet> takeFacets()
  {
    std::vector<bool> isNear(this->Surface.size(), false);
    for (std::size_t i = 0; i < isNear.size(); ++i)
    {
      isNear[i] = this->isCrease(i);
    }
    const auto isAnyNear = [&isNear](const SurfaceTriangle& triangle)
    {
      return std::any_of(
        triangle.begin(), triangle.end(), [&](std::size_t corner) { return isNear[corner]; });
    };
    this->IsInner.assign(isNear.size(), false);
    for (const SurfaceTriangle& triangle : this->Triangles)
    {
      if (isAnyNear(triangle))
      {
        for (const std::size_t corner : triangle)
        {
          this->IsInner[corner] = true;
        }
      }
    }
    isNear = this->IsInner;
    const auto end = std::stable_partition(this->Triangles.begin(), this->Triangles.end(),
      [&](const SurfaceTriangle& triangle) { return !isAnyNear(triangle); });
    std::vector<Facet> facets;
    std::transform(end, this->Triangles.end(), std::back_inserter(facets),
      [this](const SurfaceTriangle& triangle) { return this->facetOf(triangle); });
    this->Triangles.erase(end, this->Triangles.end());
    return facets;
  }

  Facet facetOf(const SurfaceTriangle& corners) const
  {
    return { corners, this->normalOf({ corners[0], corners[1], corners[2] }) };
  }

  Vector normalOf(std::initializer_list<std::size_t> vertices) const
  {
    Vector all{};
    for (const std::size_t vertex : vertices)
    {
      all = sum(all, 1.0, this->Normals[vertex]);
    }
    return directionOf(all);
  }

  bool isAlike(std::size_t a, std::size_t b) const
  {
    return dot(this->Normals[a], this->Normals[b]) >= mostCreaseCosine;
  }

  /// Whether nothing is known of the piece that a vertex is on: no fit holds, or a smooth one that
  /// differs from all around that know the crease.
  bool isLost(std::size_t vertex, const std::vector<std::size_t>& neighbors) const
  {
    const auto knowsCrease = [this](std::size_t neighbor) { return this->isCrease(neighbor); };
    const auto agrees = [&](std::size_t neighbor)
    { return this->isCrease(neighbor) && this->isAlike(vertex, neighbor); };
    return !this->isFitted(vertex) ||
           (!this->isCrease(vertex) &&
             std::any_of(neighbors.begin(), neighbors.end(), knowsCrease) &&
             std::none_of(neighbors.begin(), neighbors.end(), agrees));
  }

  /// Merges vertices that are lost with the nearest neighbor that leaves no triangle looking the
  /// wrong way, and finds the fits that describe pieces.
  std::vector<Facet> withoutUnfitted(std::vector<Facet> facets)
  {
    FacetMesh mesh(this->Surface.positions, this->IsInner, std::move(facets));
    for (std::size_t vertex = 0; vertex < this->IsInner.size(); ++vertex)
    {
      if (this->IsInner[vertex] && this->isLost(vertex, mesh.neighborsOf(vertex)))
      {
        this->mergeWithNearest(mesh, vertex);
      }
    }
    this->Pieces.resize(this->IsInner.size());
    for (std::size_t vertex = 0; vertex < this->IsInner.size(); ++vertex)
    {
      this->Pieces[vertex] = this->IsInner[vertex] ? this->pieceOf(mesh, vertex) : vertex;
    }
    return mesh.facets();
  }

  /// Neighbors that are wanted, the nearest first.
  template <class IsWanted>
  std::vector<std::size_t> nearestNeighbors(
    const FacetMesh& mesh, std::size_t vertex, const IsWanted& isWanted) const
  {
    std::vector<std::pair<double, std::size_t>> byDistance;
    for (const std::size_t neighbor : mesh.neighborsOf(vertex))
    {
      if (isWanted(neighbor))
      {
        byDistance.emplace_back(
          lengthOf(difference(this->Surface.positions[neighbor], this->Surface.positions[vertex])),
          neighbor);
      }
    }
    std::sort(byDistance.begin(), byDistance.end());
    std::vector<std::size_t> neighbors;
    for (const auto& [distance, neighbor] : byDistance)
    {
      neighbors.push_back(neighbor);
    }
    return neighbors;
  }

  void mergeWithNearest(FacetMesh& mesh, std::size_t vertex) const
  {
    const auto isUpright = [&](const Facet& moved)
    { return mesh.signedArea(this->facetOf(moved.corners)) > 0.0; };
    const auto isAny = [](const Facet&) { return true; }; // edges are flipped later
    const std::vector<std::size_t> neighbors = this->nearestNeighbors(
      mesh, vertex, [this](std::size_t each) { return this->isFitted(each); });
    const auto mergesWith = [&](const auto& isAllowed)
    {
      return std::any_of(neighbors.begin(), neighbors.end(), [&](std::size_t neighbor)
        { return mesh.collapse(vertex, neighbor, isAllowed); });
    };
    if (!mergesWith(isUpright))
    {
      mergesWith(isAny);
    }
  }

  /// The vertex whose fit describes the piece that a vertex is on: beside a crease smooth fits are
  /// rounded, so that of the nearest neighbor on the piece that knows the crease.
  std::size_t pieceOf(const FacetMesh& mesh, std::size_t vertex) const
  {
    if (this->isCrease(vertex))
    {
      return vertex;
    }
    const std::vector<std::size_t> alike = this->nearestNeighbors(mesh, vertex,
      [&](std::size_t each) { return this->isCrease(each) && this->isAlike(vertex, each); });
    return alike.empty() ? vertex : alike.front();
  }

  /// The pieces that vertices are on: all as the vertex whose fit has the most pieces sees them, if
  /// it sees all, or else each as its own vertex does.
  template <int count>
  std::array<Piece, count> piecesAt(const std::array<std::size_t, count>& vertices) const
  {
    const auto seen = [this](std::size_t vertex)
    { return this->fitOf(this->Pieces[vertex]).creases.size(); };
    const std::size_t most = *std::max_element(vertices.begin(), vertices.end(),
      [&](std::size_t a, std::size_t b) { return seen(a) < seen(b); });
    std::array<Piece, count> pieces = this->ownPieces(vertices, std::make_index_sequence<count>());
    std::array<Piece, count> all = pieces;
    for (std::size_t i = 0; i < vertices.size(); ++i)
    {
      const std::optional<Piece> piece = this->pieceSeenFrom(most, vertices[i]);
      if (!piece)
      {
        return pieces;
      }
      all[i] = *piece;
    }
    return all;
  }

  template <std::size_t count, std::size_t... indices>
  std::array<Piece, count> ownPieces(
    const std::array<std::size_t, count>& vertices, std::index_sequence<indices...>) const
  {
    return { Piece(this->fitOf(this->Pieces[vertices[indices]]))... };
  }

  /// The piece of a vertex as another one's fit sees it, if that has a piece of a similar normal,
  /// and sees more pieces.
  std::optional<Piece> pieceSeenFrom(std::size_t viewer, std::size_t vertex) const
  {
    const LocalFit& fit = this->fitOf(this->Pieces[viewer]);
    if (viewer == vertex || this->fitOf(this->Pieces[vertex]).creases.size() == fit.creases.size())
    {
      return Piece(this->fitOf(this->Pieces[vertex]));
    }
    for (const CreasePlane& plane : fit.creases)
    {
      if (std::abs(dot(plane.inward, this->Normals[vertex])) >= mostCreaseCosine)
      {
        return Piece(fit.position, plane);
      }
    }
    return std::nullopt;
  }

  using Edge = std::pair<std::size_t, std::size_t>; // the lower vertex first

  /// Whether two vertices are on different pieces.
  bool isAcrossCrease(std::size_t a, std::size_t b) const
  {
    return this->IsInner[a] && this->IsInner[b] && this->isFitted(a) && this->isFitted(b) &&
           (this->isCrease(a) || this->isCrease(b)) &&
           !this->isAlike(a, b);
  }

  /// Where an edge that is laid along both pieces crosses the crease between them.
  std::optional<Vector> placeOnCrease(std::size_t a, std::size_t b) const
  {
    const Vector& p = this->Surface.positions[a];
    const Vector& q = this->Surface.positions[b];
    const std::array<Piece, 2> pieces = this->piecesAt<2>({ a, b });
    const Vector center = middle(p, q);
    const Vector near = meetingOf<2>(pieces, center);
    const Vector along = directionOf(cross(this->Normals[a], this->Normals[b]));
    const auto offsetOf = [&](const Vector& place)
    {
      const Vector offset = difference(place, near);
      const double shift = dot(offset, along);
      return std::pair(shift, lengthOf(sum(offset, -shift, along)));
    };
    const auto [pShift, pOff] = offsetOf(p);
    const auto [qShift, qOff] = offsetOf(q);
    const double off = pOff + qOff;
    const double shift = off > 0.0 ? (pShift * qOff + qShift * pOff) / off : 0.0;
    const Vector place = meetingOf<2>(pieces, sum(near, shift, along));
    const double length = lengthOf(difference(q, p));
    return isFinite(place) && lengthOf(difference(place, center)) <= mostOffset * length
             ? std::optional(place)
             : std::nullopt;
  }

  /// Appends a vertex, which takes over the edge of another one.
  std::size_t addVertex(
    std::size_t like, const Vector& place, std::initializer_list<std::size_t> around)
  {
    double slope = 0.0;
    for (const std::size_t each : around)
    {
      slope += lengthOf(this->fitOf(each).gradient) / static_cast<double>(around.size());
    }
    return this->addVertex(like, place, this->normalOf(around), slope);
  }

  std::size_t addVertex(std::size_t like, const Vector& place, const Vector& normal, double slope)
  {
    Isosurface& surface = this->Surface;
    const std::size_t vertex = surface.size();
    LocalFit fit = surface.fits[like];
    fit.position = place;
    fit.gradient = scaled(-slope, normal);
    fit.hessian = {};
    fit.isSmooth = false;
    fit.order = FitOrder::Crease;
    fit.creases.clear();
    surface.edges.push_back(IsopointEdge(surface.edges[like]));
    surface.positions.push_back(place);
    surface.decreasingEdges.push_back(Vector(surface.decreasingEdges[like]));
    surface.leaves.push_back(EdgeLeaves(surface.leaves[like]));
    surface.fits.push_back(std::move(fit));
    this->Normals.push_back(normal);
    this->IsInner.push_back(true);
    return vertex;
  }

  std::optional<std::size_t> vertexOnCrease(std::size_t a, std::size_t b) const
  {
    const auto found = this->OnCreases.find(std::minmax(a, b));
    return found != this->OnCreases.end() ? std::optional(found->second) : std::nullopt;
  }

  std::vector<Facet> split(const std::vector<Facet>& facets)
  {
    this->FirstNew = this->Surface.size();
    std::vector<Edge> edges;
    for (const Facet& facet : facets)
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        const Edge edge = std::minmax({ facet.corners[i], facet.corners[(i + 1) % 3] });
        if (this->isAcrossCrease(edge.first, edge.second))
        {
          edges.push_back(edge);
        }
      }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (const auto& [a, b] : edges)
    {
      if (const std::optional<Vector> place = this->placeOnCrease(a, b))
      {
        this->OnCreases[{ a, b }] = this->addVertex(a, *place, { a, b });
      }
    }
    std::vector<Facet> parts;
    for (const Facet& facet : facets)
    {
      this->addParts(facet, parts);
    }
    return parts;
  }

  void addParts(const Facet& facet, std::vector<Facet>& parts)
  {
    std::array<std::optional<std::size_t>, 3> onEdges;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      onEdges[i] = this->vertexOnCrease(facet.corners[i], facet.corners[(i + 1) % 3]);
      count += onEdges[i] ? 1 : 0;
    }
    // Turned so that the corner that differs is the first one.
    const auto turnedTo = [&](std::size_t first)
    {
      return std::array{ facet.corners[first], facet.corners[(first + 1) % 3],
        facet.corners[(first + 2) % 3] };
    };
    if (count == 0)
    {
      parts.push_back(this->facetOf(facet.corners));
    }
    else if (count == 1)
    {
      const auto edge = static_cast<std::size_t>(
        std::find_if(onEdges.begin(), onEdges.end(), [](const auto& each) { return each; }) -
        onEdges.begin());
      const auto [a, b, c] = turnedTo(edge);
      parts.push_back({ { a, *onEdges[edge], c }, this->normalOf({ a, c }) });
      parts.push_back({ { *onEdges[edge], b, c }, this->normalOf({ b, c }) });
    }
    else if (count == 2)
    {
      const auto whole = static_cast<std::size_t>(
        std::find_if(onEdges.begin(), onEdges.end(), [](const auto& each) { return !each; }) -
        onEdges.begin());
      const auto [a, b, c] = turnedTo((whole + 2) % 3);
      this->addTwoPieces(a, b, c, *onEdges[(whole + 2) % 3], *onEdges[(whole + 1) % 3], parts);
    }
    else
    {
      this->addThreePieces(facet.corners, { *onEdges[0], *onEdges[1], *onEdges[2] }, parts);
    }
  }

  /// @param a alone on its piece; ab, ca where the crease crosses
  void addTwoPieces(std::size_t a, std::size_t b, std::size_t c, std::size_t ab, std::size_t ca,
    std::vector<Facet>& parts) const
  {
    const auto lengthBetween = [this](std::size_t p, std::size_t q)
    { return lengthOf(difference(this->Surface.positions[p], this->Surface.positions[q])); };
    const Vector normal = this->normalOf({ b, c });
    parts.push_back({ { a, ab, ca }, this->Normals[a] });
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
    if (const std::optional<Vector> place = this->placeOfCorner(corners))
    {
      const std::size_t corner = this->addVertex(a, *place, { a, b, c });
      for (const auto& [piece, from, to] :
        { std::array{ a, ca, ab }, std::array{ b, ab, bc }, std::array{ c, bc, ca } })
      {
        parts.push_back({ { piece, to, corner }, this->Normals[piece] });
        parts.push_back({ { piece, corner, from }, this->Normals[piece] });
      }
      return;
    }
    parts.push_back({ { a, ab, ca }, this->Normals[a] });
    parts.push_back({ { b, bc, ab }, this->Normals[b] });
    parts.push_back({ { c, ca, bc }, this->Normals[c] });
    parts.push_back({ { ab, bc, ca }, this->normalOf({ a, b, c }) });
  }

  std::optional<Vector> placeOfCorner(const SurfaceTriangle& corners) const
  {
    const auto& [a, b, c] = corners;
    const std::vector<Vector>& positions = this->Surface.positions;
    const Vector center =
      scaled(1.0 / 3.0, sum(sum(positions[a], 1.0, positions[b]), 1.0, positions[c]));
    const Vector place = meetingOf<3>(this->piecesAt<3>(corners), center);
    const double longest = std::max({ lengthOf(difference(positions[a], positions[b])),
      lengthOf(difference(positions[b], positions[c])),
      lengthOf(difference(positions[c], positions[a])) });
    return isFinite(place) && lengthOf(difference(place, center)) <= mostCornerOffset * longest
             ? std::optional(place)
             : std::nullopt;
  }

  /// Flips edges of triangles that look the wrong way, and merges vertices of creases where that
  /// does not suffice.
  std::vector<Facet> untangled(std::vector<Facet> facets) const
  {
    FacetMesh mesh(this->Surface.positions, this->IsInner, std::move(facets));
    mesh.untangle();
    for (const std::size_t inverted : mesh.invertedFacets())
    {
      this->mergeAt(mesh, inverted);
    }
    mesh.untangle();
    return mesh.facets();
  }

  void mergeAt(FacetMesh& mesh, std::size_t inverted) const
  {
    const Facet facet = mesh.facet(inverted);
    for (std::size_t i = 0; i < 3; ++i)
    {
      for (const auto& [from, to] :
        { std::pair(i, (i + 1) % 3), std::pair((i + 1) % 3, i) })
      {
        const std::size_t vertex = facet.corners[from];
        const std::size_t neighbor = facet.corners[to];
        const bool isPossible = vertex >= this->FirstNew && neighbor >= this->FirstNew;
        if (isPossible && mesh.collapse(vertex, neighbor,
                            [&](const Facet& moved) { return mesh.signedArea(moved) >= 0.0; }))
        {
          return;
        }
      }
    }
  }

  /// Repeats the vertices of facets that look to different sides: the copy for a piece has the
  /// normal of the first facet there.
  void partCreases(std::vector<Facet>& facets)
  {
    std::map<std::size_t, std::vector<std::size_t>> copies; // of vertices, the vertex itself first
    for (Facet& facet : facets)
    {
      for (std::size_t& corner : facet.corners)
      {
        if (dot(this->Normals[corner], facet.normal) < mostPartedCosine)
        {
          corner = this->copyOf(corner, facet.normal, copies[corner]);
        }
      }
    }
  }

  std::size_t copyOf(
    std::size_t vertex, const Vector& normal, std::vector<std::size_t>& copies)
  {
    for (const std::size_t copy : copies)
    {
      if (dot(this->Normals[copy], normal) >= mostPartedCosine)
      {
        return copy;
      }
    }
    const Vector place = this->Surface.positions[vertex]; // which adding moves
    copies.push_back(
      this->addVertex(vertex, place, normal, lengthOf(this->fitOf(vertex).gradient)));
    return copies.back();
  }

  /// Drops vertices without triangles, and orders the triangles.
  void order()
  {
    constexpr std::size_t unused = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> number(this->Surface.size(), unused);
    for (const SurfaceTriangle& triangle : this->Triangles)
    {
      for (const std::size_t corner : triangle)
      {
        number[corner] = 0;
      }
    }
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < number.size(); ++i)
    {
      if (number[i] != unused)
      {
        number[i] = kept.size();
        kept.push_back(i);
      }
    }
    if (kept.size() < number.size())
    {
      const std::size_t dropped = this->Surface.droppedEdges;
      this->Surface = chosenIsopoints(this->Surface, kept);
      this->Surface.droppedEdges = dropped;
    }
    for (SurfaceTriangle& triangle : this->Triangles)
    {
      triangle = { number[triangle[0]], number[triangle[1]], number[triangle[2]] };
      std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    }
    this->Triangles = sortedUnique(this->Run, this->Triangles, kept.size(),
      [](const SurfaceTriangle& triangle) { return static_cast<std::uint64_t>(triangle[0]); });
  }

  const Execution& Run;
  Isosurface& Surface;
  std::vector<SurfaceTriangle>& Triangles;
  std::vector<Vector> Normals;
  std::vector<bool> IsInner;                  // whether all triangles around a vertex are facets
  std::vector<std::size_t> Pieces;            // the vertex whose fit describes that of a vertex
  std::map<Edge, std::size_t> OnCreases;      // vertices, by the edges that they are on
  std::size_t FirstNew = 0;                   // vertex
};

} // namespace

void meshCreases(const Execution& execution, Isosurface& surface,
  std::vector<SurfaceTriangle>& triangles, bool parts)
{
  CreaseMesher(execution, surface, triangles).mesh(parts);
}

} // namespace isopoint
