// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/BodyOrientation.h"

#include "Core/Base/Lists.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Triangles/SurfacePieces.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace isopoint
{
namespace
{

bool isInverted(double before, double after)
{
  return (before > 0.0 && !(after > 0.0)) || (before < 0.0 && !(after < 0.0));
}

/// The triangles whose first corner has a mark.
std::vector<SurfaceTriangle> marked(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<char>& ofVertices)
{
  return chosenOf(execution, triangles,
    itemsThat(execution, triangles.size(),
      [&](std::size_t i) { return ofVertices[triangles[i][0]] != 0; }));
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

void revert(const Vector& unmoved, LocalFit& fit)
{
  fit.order.reset();
  fit.position = unmoved;
}

} // namespace

void restoreInvertedPieces(
  const Execution& execution, const MergeableTriangles& exact, MergedTriangles& merged)
{
  const SurfacePieces before(execution, exact.triangles, exact.crossings.size());
  const SurfacePieces after(execution, merged.triangles, merged.size());
  const std::vector<double> exactVolumes =
    volumesOf(execution, before, exact.crossings, exact.triangles);
  const std::vector<double> volumes =
    volumesOf(execution, after, merged.positions, merged.triangles);
  const auto exactPieceOf = [&](std::size_t vertex)
  { return before.pieceOf[merged.members[merged.memberBegins[vertex]]]; };
  std::vector<char> areInverted(exact.crossings.size(), 0); // exact pieces
  bool isAny = false;
  forEachInOrder(execution, merged.size(),
    [&](std::size_t vertex)
    {
      const std::size_t piece = exactPieceOf(vertex);
      if (after.pieceOf[vertex] == vertex && isInverted(exactVolumes[piece], volumes[vertex]))
      {
        areInverted[piece] = 1;
        isAny = true;
      }
    });
  if (!isAny)
  {
    return;
  }
  std::vector<char> areKept(merged.size());
  forEachIndex(execution, areKept.size(),
    [&](std::size_t vertex) { areKept[vertex] = areInverted[exactPieceOf(vertex)] == 0 ? 1 : 0; });
  std::vector<char> areRestored(exact.crossings.size());
  forEachIndex(execution, areRestored.size(),
    [&](std::size_t vertex) { areRestored[vertex] = areInverted[before.pieceOf[vertex]]; });
  const std::vector<std::size_t> kept = markedOf(execution, areKept);
  const std::vector<std::size_t> restored = markedOf(execution, areRestored);
  const auto join =
    [&](const std::vector<SurfaceTriangle>& ofMerged, const std::vector<SurfaceTriangle>& ofExact)
  {
    return joined(renumbered(execution, marked(execution, ofMerged, areKept), kept, merged.size()),
      renumbered(execution, marked(execution, ofExact, areRestored), restored, areRestored.size()),
      kept.size());
  };
  merged.triangles = join(merged.triangles, exact.triangles);
  merged.caps = join(merged.caps, exact.caps);
  std::vector<std::size_t> members;
  std::vector<std::size_t> begins = chosenLists(execution, merged.memberBegins, kept, members);
  merged.members = chosenOf(execution, merged.members, members);
  merged.positions = chosenOf(execution, merged.positions, kept);
  for (const std::size_t vertex : restored)
  {
    merged.members.push_back(vertex);
    merged.positions.push_back(exact.crossings[vertex]);
    begins.push_back(merged.members.size());
  }
  merged.memberBegins = std::move(begins);
}

void keepBodiesOriented(const Execution& execution, const std::vector<Vector>& unmoved,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<SurfaceTriangle>& caps,
  std::vector<LocalFit>& fits)
{
  const auto isTurned = [&](std::size_t i)
  {
    const auto& [a, b, c] = caps[i];
    const auto positionOf = [&](std::size_t vertex) { return fits[vertex].position; };
    return dot(cross(unmoved[b] - unmoved[a], unmoved[c] - unmoved[a]),
             cross(positionOf(b) - positionOf(a), positionOf(c) - positionOf(a))) < 0.0;
  };
  for (std::vector<std::size_t> turned = itemsThat(execution, caps.size(), isTurned);
       !turned.empty(); turned = itemsThat(execution, caps.size(), isTurned))
  {
    for (const std::size_t cap : turned)
    {
      for (const std::size_t vertex : caps[cap])
      {
        revert(unmoved[vertex], fits[vertex]);
      }
    }
  }
  std::vector<Vector> positions(fits.size());
  forEachIndex(
    execution, fits.size(), [&](std::size_t vertex) { positions[vertex] = fits[vertex].position; });
  const SurfacePieces pieces(execution, triangles, fits.size());
  const std::vector<double> before = volumesOf(execution, pieces, unmoved, triangles);
  const std::vector<double> after = volumesOf(execution, pieces, positions, triangles);
  forEachIndex(execution, fits.size(),
    [&](std::size_t vertex)
    {
      const std::size_t piece = pieces.pieceOf[vertex];
      if (isInverted(before[piece], after[piece]))
      {
        revert(unmoved[vertex], fits[vertex]);
      }
    });
}

void revertInvertingFlips(const Execution& execution, const std::vector<Vector>& positions,
  const std::vector<SurfaceTriangle>& before, std::vector<SurfaceTriangle>& triangles)
{
  const SurfacePieces pieces(execution, before, positions.size());
  const std::vector<double> volumes = volumesOf(execution, pieces, positions, before);
  const std::vector<double> flipped = volumesOf(execution, pieces, positions, triangles);
  std::vector<char> areReverted(positions.size());
  forEachIndex(execution, areReverted.size(),
    [&](std::size_t vertex)
    {
      const std::size_t piece = pieces.pieceOf[vertex];
      areReverted[vertex] = isInverted(volumes[piece], flipped[piece]) ? 1 : 0;
    });
  const std::vector<SurfaceTriangle> reverted = marked(execution, before, areReverted);
  if (!reverted.empty())
  {
    forEachIndex(execution, areReverted.size(),
      [&](std::size_t vertex) { areReverted[vertex] = areReverted[vertex] == 0 ? 1 : 0; });
    triangles = ordered(
      execution, joined(marked(execution, triangles, areReverted), reverted, 0), positions.size());
  }
}

} // namespace isopoint
