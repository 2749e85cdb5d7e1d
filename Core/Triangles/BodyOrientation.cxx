// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/BodyOrientation.h"

#include "Core/Base/Lists.h"
#include "Core/Triangles/SurfacePieces.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace isopoint
{
namespace
{

bool changesSign(double before, double after)
{
  return (before > 0.0 && !(after > 0.0)) || (before < 0.0 && !(after < 0.0));
}

/// Whether a triangle of three vertices faces away when they are at other positions.
bool isInverted(const std::vector<Vector>& before, const std::vector<Vector>& after,
  const SurfaceTriangle& triangle)
{
  return dot(areaNormal(before, triangle), areaNormal(after, triangle)) < 0.0;
}

/// By vertex, whether other positions or triangles change the sign of its piece's volume.
/// @param after triangles of the same pieces
std::vector<char> areOfInverted(const Execution& execution, const std::vector<Vector>& unmoved,
  const std::vector<Vector>& moved, const std::vector<SurfaceTriangle>& before,
  const std::vector<SurfaceTriangle>& after)
{
  const std::vector<std::size_t> pieces = piecesOf(execution, before, unmoved.size());
  const std::vector<double> volumes = volumesOf(execution, pieces, unmoved, before);
  const std::vector<double> others = volumesOf(execution, pieces, moved, after);
  return tabulated<char>(execution, pieces.size(),
    [&](std::size_t vertex)
    { return changesSign(volumes[pieces[vertex]], others[pieces[vertex]]); });
}

/// The triangles whose first corner has a mark, or those whose has none.
std::vector<SurfaceTriangle> marked(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<char>& ofVertices, bool mark)
{
  return chosenThat(execution, triangles,
    [&](const SurfaceTriangle& triangle) { return (ofVertices[triangle[0]] != 0) == mark; });
}

/// Triangles of some vertices of two surfaces, numbered one after the other.
std::vector<SurfaceTriangle> joined(
  std::vector<SurfaceTriangle> first, std::vector<SurfaceTriangle> second, std::size_t count)
{
  for (SurfaceTriangle& triangle : second)
  {
    std::for_each(triangle.begin(), triangle.end(), [&](std::size_t& vertex) { vertex += count; });
  }
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

} // namespace

void restoreInvertedPieces(
  const Execution& execution, const MergeableTriangles& exact, CrossingMesh& merged)
{
  const std::vector<std::size_t> before =
    piecesOf(execution, exact.triangles, exact.crossings.size());
  const std::vector<std::size_t> after = piecesOf(execution, merged.triangles, merged.size());
  const std::vector<double> exactVolumes =
    volumesOf(execution, before, exact.crossings, exact.triangles);
  const std::vector<double> volumes =
    volumesOf(execution, after, merged.positions, merged.triangles);
  const auto exactPieceOf = [&](std::size_t vertex) { return before[merged.firstMember(vertex)]; };
  std::vector<char> areInverted(exact.crossings.size(), 0); // exact pieces
  bool isAny = false;
  forEachInOrder(execution, merged.size(),
    [&](std::size_t vertex)
    {
      const std::size_t piece = exactPieceOf(vertex);
      if (after[vertex] == vertex && changesSign(exactVolumes[piece], volumes[vertex]))
      {
        areInverted[piece] = 1;
        isAny = true;
      }
    });
  if (!isAny)
  {
    return;
  }
  const std::vector<char> areKept = tabulated<char>(execution, merged.size(),
    [&](std::size_t vertex) { return areInverted[exactPieceOf(vertex)] == 0; });
  const std::vector<char> areRestored = tabulated<char>(execution, exact.crossings.size(),
    [&](std::size_t vertex) { return areInverted[before[vertex]]; });
  merged.triangles = marked(execution, merged.triangles, areKept, true);
  merged.caps = marked(execution, merged.caps, areKept, true);
  merged = inOrder(execution, merged, markedOf(execution, areKept));
  const std::vector<std::size_t> restored = markedOf(execution, areRestored);
  const std::vector<std::size_t> numbers = inverseOf(execution, restored, areRestored.size());
  const auto append = [&, keptCount = merged.size()](
                        const std::vector<SurfaceTriangle>& exactOnes, auto& triangles)
  {
    triangles = joined(std::move(triangles),
      renumbered(
        execution, marked(execution, exactOnes, areRestored, true), numbers, restored.size()),
      keptCount);
  };
  append(exact.triangles, merged.triangles);
  append(exact.caps, merged.caps);
  for (const std::size_t vertex : restored)
  {
    merged.members.push_back(vertex);
    merged.positions.push_back(exact.crossings[vertex]);
    merged.memberBegins.push_back(merged.members.size());
  }
}

void keepBodiesOriented(const Execution& execution, const std::vector<Vector>& unmoved,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<SurfaceTriangle>& caps,
  std::vector<LocalFit>& fits)
{
  std::vector<Vector> positions = tabulated<Vector>(
    execution, fits.size(), [&](std::size_t vertex) { return fits[vertex].position; });
  const auto revert = [&](std::size_t vertex)
  {
    fits[vertex].order.reset();
    fits[vertex].position = positions[vertex] = unmoved[vertex];
  };
  const auto invertedCaps = [&]()
  {
    return chosenThat(execution, caps,
      [&](const SurfaceTriangle& cap) { return isInverted(unmoved, positions, cap); });
  };
  for (auto inverted = invertedCaps(); !inverted.empty(); inverted = invertedCaps())
  {
    for (const SurfaceTriangle& cap : inverted)
    {
      std::for_each(cap.begin(), cap.end(), revert);
    }
  }
  const std::vector<std::size_t> inverted =
    markedOf(execution, areOfInverted(execution, unmoved, positions, triangles, triangles));
  std::for_each(inverted.begin(), inverted.end(), revert);
}

void revertInvertingFlips(const Execution& execution, const std::vector<Vector>& positions,
  const std::vector<SurfaceTriangle>& before, std::vector<SurfaceTriangle>& triangles)
{
  const std::vector<char> areReverted =
    areOfInverted(execution, positions, positions, before, triangles);
  const std::vector<SurfaceTriangle> reverted = marked(execution, before, areReverted, true);
  if (!reverted.empty())
  {
    triangles = ordered(execution,
      joined(marked(execution, triangles, areReverted, false), reverted, 0), positions.size());
  }
}

} // namespace isopoint
