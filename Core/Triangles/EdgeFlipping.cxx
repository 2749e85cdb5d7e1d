// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/EdgeFlipping.h"

#include "Core/Base/Lists.h"
#include "Core/Triangles/SurfaceMesh.h"
#include "Core/Triangles/VertexNormals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace isopoint
{
namespace
{

/// The minimum cosine between the normals of an upright triangle and of its vertices.
constexpr double upright = 0.6;

class EdgeFlipper
{
public:
  EdgeFlipper(const Execution& execution, const std::vector<Vector>& positions,
    const std::vector<char>& areFixed, std::vector<SurfaceTriangle> triangles)
    : Run(execution)
    , Positions(positions)
    , AreFixed(areFixed)
    , Mesh(execution, std::move(triangles), positions.size())
    , Normals(areaNormals(execution, positions, this->Mesh.triangles(), this->Mesh.outgoing()))
    , States(3 * this->Mesh.triangles().size(), State::Suspect)
  {
    forEachIndex(execution, this->Normals.size(),
      [this](std::size_t vertex)
      {
        const double length = lengthOf(this->Normals[vertex]);
        this->Normals[vertex] = length > 0.0 ? 1.0 / length * this->Normals[vertex] : Vector{};
      });
  }

  /// Flips edges in the order of their sides, in rounds. All threads choose among the suspects, and
  /// the calling thread flips.
  std::vector<SurfaceTriangle> flip()
  {
    constexpr int maxRounds = 10;
    bool isAnyFlipped = true;
    for (int round = 0; round < maxRounds && isAnyFlipped; ++round)
    {
      isAnyFlipped = false;
      std::vector<State> states(this->States.size(), State::Seen);
      forEachIndex(this->Run, states.size(), [&](HalfEdge side) { this->choose(side, states); });
      this->States = std::move(states);
      forEachInOrder(this->Run, this->States.size(),
        [&](HalfEdge side)
        {
          if (this->States[side] != State::Seen)
          {
            isAnyFlipped = this->flipIfImproved(side) || isAnyFlipped;
          }
        });
    }
    return std::move(this->Mesh).takeTriangles();
  }

private:
  enum class State : char
  {
    Suspect, // one of the triangles at the side changed
    Chosen,  // a flip improves them
    Seen     // none does
  };

  /// Examines a suspect edge by one of its sides.
  void choose(HalfEdge side, std::vector<State>& states) const
  {
    const HalfEdge twin = this->Mesh.twinOf(side);
    const auto isSuspect = [this](HalfEdge each) { return this->States[each] == State::Suspect; };
    if (twin != noHalfEdge && (isSuspect(side) || isSuspect(twin)) && this->facesObtuse(side) &&
        (side < twin || !this->facesObtuse(twin)) && this->isImproved(side))
    {
      const bool isOwn = isSuspect(side) && (side < twin || !isSuspect(twin));
      states[isOwn ? side : twin] = State::Chosen;
    }
  }

  bool flipIfImproved(HalfEdge side)
  {
    const HalfEdge twin = this->Mesh.twinOf(side);
    const State state = std::exchange(this->States[side], State::Seen);
    if (twin == noHalfEdge)
    {
      return false;
    }
    this->States[twin] = State::Seen;
    const bool isImproved =
      state == State::Chosen ||
      ((this->facesObtuse(side) || this->facesObtuse(twin)) && this->isImproved(side));
    if (!isImproved || !this->isFree(side))
    {
      return false;
    }
    this->Mesh.flip(side);
    for (const HalfEdge first : { side / 3 * 3, twin / 3 * 3 })
    {
      this->States[first + 2] = State::Seen; // the new edge
      for (const HalfEdge outer : { first, first + 1 })
      {
        this->States[outer] = State::Suspect;
        if (this->Mesh.twinOf(outer) != noHalfEdge)
        {
          this->States[this->Mesh.twinOf(outer)] = State::Suspect;
        }
      }
    }
    return true;
  }

  Vector edgeOf(std::size_t from, std::size_t to) const
  {
    return this->Positions[to] - this->Positions[from];
  }

  /// Whether a flip makes the two triangles at a side more regular and keeps them upright.
  bool isImproved(HalfEdge side) const
  {
    const std::size_t a = this->Mesh.startOf(side);
    const std::size_t b = this->Mesh.endOf(side);
    const std::size_t c = this->Mesh.oppositeOf(side);
    const std::size_t d = this->Mesh.oppositeOf(this->Mesh.twinOf(side));
    const bool isOfKept =
      this->AreFixed[a] && this->AreFixed[b] && (this->AreFixed[c] || this->AreFixed[d]);
    return c != d && !isOfKept && this->isObtuse(a, b, c, d) && !this->isCrease(a, b, c, d) &&
           this->staysUpright(a, b, c, d);
  }

  /// Whether the corners opposite to an edge are not connected, as far as is known: only the one
  /// with fewer triangles is asked, and several fans may meet there.
  bool isFree(HalfEdge side) const
  {
    const auto triangleCount = [this](std::size_t vertex)
    {
      std::size_t count = 0;
      this->Mesh.outgoing().forEachAt(vertex, [&count](HalfEdge) { ++count; });
      return count;
    };
    std::size_t c = this->Mesh.oppositeOf(side);
    std::size_t d = this->Mesh.oppositeOf(this->Mesh.twinOf(side));
    if (triangleCount(c) > triangleCount(d))
    {
      std::swap(c, d);
    }
    return !this->Mesh.hasEdge(c, d) && this->Mesh.fanAt(c) != SurfaceMesh::Fan::Branched;
  }

  /// Whether the angle opposite to a side exceeds 90 degrees: at one side of an edge to be flipped.
  bool facesObtuse(HalfEdge side) const
  {
    const std::size_t c = this->Mesh.oppositeOf(side);
    return dot(this->edgeOf(c, this->Mesh.startOf(side)), this->edgeOf(c, this->Mesh.endOf(side))) <
           0.0;
  }

  /// Whether the angles at c and d, opposite the edge ab, add up to more than 180 degrees.
  bool isObtuse(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const
  {
    const auto angleAt = [&](std::size_t corner)
    {
      const Vector toA = this->edgeOf(corner, a);
      const Vector toB = this->edgeOf(corner, b);
      return std::array{ dot(toA, toB), lengthOf(cross(toA, toB)) }; // cosine, sine
    };
    const auto [cosC, sinC] = angleAt(c);
    const auto [cosD, sinD] = angleAt(d);
    constexpr double minSine = 0.01; // a smaller excess is not worth a flip
    const double scale =
      std::sqrt(cosC * cosC + sinC * sinC) * std::sqrt(cosD * cosD + sinD * sinD);
    return sinC * cosD + cosC * sinD < -minSine * scale;
  }

  /// The cosine between the normals of a triangle and of its vertices.
  double uprightness(const SurfaceTriangle& triangle) const
  {
    const auto& [a, b, c] = triangle;
    const Vector normal = areaNormal(this->Positions, triangle);
    const Vector around = this->Normals[a] + this->Normals[b] + this->Normals[c];
    const double lengths = lengthOf(normal) * lengthOf(around);
    return lengths > 0.0 ? dot(normal, around) / lengths : -1.0;
  }

  double minUprightness(const SurfaceTriangle& first, const SurfaceTriangle& second) const
  {
    return std::min(this->uprightness(first), this->uprightness(second));
  }

  /// Whether the surface bends by more than 60 degrees at the edge, and no triangle is folded over.
  bool isCrease(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const
  {
    constexpr double minCosine = 0.5;
    const Vector first = areaNormal(this->Positions, { a, b, c });
    const Vector second = areaNormal(this->Positions, { b, a, d });
    return dot(first, second) < minCosine * lengthOf(first) * lengthOf(second) &&
           this->minUprightness({ a, b, c }, { b, a, d }) >= upright;
  }

  /// Whether a flip leaves two triangles that are upright, or at least as upright as before.
  bool staysUpright(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const
  {
    const double after = this->minUprightness({ c, a, d }, { d, b, c });
    return after >= upright ||
           (after > 0.0 && after >= this->minUprightness({ a, b, c }, { b, a, d }));
  }

  const Execution& Run;
  const std::vector<Vector>& Positions;
  const std::vector<char>& AreFixed; // each vertex
  SurfaceMesh Mesh;
  std::vector<Vector> Normals; // of vertices, before any flip
  std::vector<State> States;   // of sides
};

} // namespace

void flipEdges(const Execution& execution, const std::vector<Vector>& positions,
  const std::vector<char>& areFixed, std::vector<SurfaceTriangle>& triangles)
{
  triangles = ordered(execution,
    EdgeFlipper(execution, positions, areFixed, std::move(triangles)).flip(), positions.size());
}

} // namespace isopoint
