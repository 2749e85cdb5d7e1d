// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Triangles/CreaseUntangling.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace isopoint
{
namespace
{

/// Merges two vertices of a facet that looks the wrong way, if all others around then look the
/// right way, or are much smaller. Vertices on creases stay on them. @returns whether it did
bool mergeAt(FacetMesh& mesh, std::size_t inverted, std::size_t firstOnCrease)
{
  const Facet facet = mesh.facet(inverted);
  constexpr double share = 0.1;
  const double least = share * mesh.signedArea(facet);
  for (std::size_t i = 0; i < 6; ++i)
  {
    const std::size_t vertex = facet.corners[i % 3];
    const std::size_t neighbor = facet.corners[(i % 3 + 1 + i / 3) % 3];
    const bool staysOnCrease = vertex < firstOnCrease || neighbor >= firstOnCrease;
    if (staysOnCrease && mesh.collapse(vertex, neighbor,
                           [&](const Facet& moved) { return mesh.signedArea(moved) >= least; }))
    {
      return true;
    }
  }
  return false;
}

/// Moves a vertex of a facet that looks the wrong way halfway between its neighbors along the
/// crease, if that makes less around it look the wrong way. @returns whether it did
bool slideAt(
  CreaseSurface& whole, const FacetMesh& mesh, std::size_t inverted, std::size_t firstOnCrease)
{
  for (const std::size_t vertex : mesh.facet(inverted).corners)
  {
    std::vector<std::size_t> along = mesh.neighborsOf(vertex);
    along.erase(std::remove_if(along.begin(), along.end(),
                  [firstOnCrease](std::size_t neighbor) { return neighbor < firstOnCrease; }),
      along.end());
    if (vertex < firstOnCrease || along.size() != 2)
    {
      continue;
    }
    Vector& position = whole.surface.positions[vertex];
    const Vector former = position;
    const double formerArea = mesh.invertedAreaAround(vertex);
    position =
      scaled(0.5, sum(whole.surface.positions[along[0]], 1.0, whole.surface.positions[along[1]]));
    if (mesh.invertedAreaAround(vertex) < formerArea)
    {
      whole.surface.fits[vertex].position = position;
      return true;
    }
    position = former;
  }
  return false;
}

} // namespace

std::vector<Facet> untangleFacets(const Execution& execution, CreaseSurface& whole,
  std::vector<Facet> facets, std::size_t firstOnCrease)
{
  FacetMesh mesh(whole.surface.positions, whole.isInner, std::move(facets));
  constexpr int mostRounds = 5;
  bool isAnyMerged = true;
  mesh.untangle();
  for (int round = 0; round < mostRounds && isAnyMerged; ++round)
  {
    isAnyMerged = false;
    for (const std::size_t facet : mesh.invertedFacets())
    {
      throwIfAborted(execution);
      if (mesh.isInverted(facet)) // still
      {
        isAnyMerged = mergeAt(mesh, facet, firstOnCrease) ||
                      slideAt(whole, mesh, facet, firstOnCrease) || isAnyMerged;
      }
    }
    mesh.untangle();
  }
  return mesh.facets();
}

} // namespace isopoint
