// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_CrossingFacets_h
#define isopoint_CrossingFacets_h

#include "Isopoint/Tetrahedra/BandTriangulation.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace isopoint
{

/// Which crossing tetrahedra have a crossing facet in common.
class CrossingFacets
{
public:
  /// @param tetrahedra all that are crossing
  /// @throws std::bad_alloc
  /// Complexity: O(n log n)
  template <class TId>
  explicit CrossingFacets(const std::vector<CrossingTetrahedron<TId>>& tetrahedra)
    : Neighbors(tetrahedra.size(), { none, none, none, none })
  {
    std::vector<Facet<TId>> facets;
    facets.reserve(4 * tetrahedra.size());
    for (std::size_t i = 0; i < tetrahedra.size(); ++i)
    {
      addFacets(tetrahedra[i], i, facets);
    }
    std::sort(facets.begin(), facets.end(),
      [](const Facet<TId>& a, const Facet<TId>& b) { return a.corners < b.corners; });
    for (std::size_t i = 1; i < facets.size(); ++i)
    {
      if (facets[i - 1].corners == facets[i].corners)
      {
        this->addNeighbor(facets[i - 1].tetrahedron, facets[i].tetrahedron);
        this->addNeighbor(facets[i].tetrahedron, facets[i - 1].tetrahedron);
      }
    }
  }

  /// Visits the numbers of the tetrahedra that have a crossing facet in common with one.
  template <class Visit>
  void forEachNeighbor(std::size_t tetrahedron, const Visit& visit) const
  {
    for (const std::size_t neighbor : this->Neighbors[tetrahedron])
    {
      if (neighbor != none)
      {
        visit(neighbor);
      }
    }
  }

private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  template <class TId>
  struct Facet
  {
    std::array<TId, 3> corners; // ascending
    std::size_t tetrahedron;
  };

  template <class TId>
  static void addFacets(const CrossingTetrahedron<TId>& tetrahedron, std::size_t number,
    std::vector<Facet<TId>>& facets)
  {
    for (std::size_t opposite = 0; opposite < 4; ++opposite)
    {
      const bool isBelow = opposite < tetrahedron.belowCount;
      if (tetrahedron.belowCount == (isBelow ? 1 : 3))
      {
        continue; // all corners of the facet are on one side
      }
      Facet<TId> facet{ {}, number };
      std::size_t place = 0;
      for (std::size_t corner = 0; corner < 4; ++corner)
      {
        if (corner != opposite)
        {
          facet.corners[place++] = tetrahedron.corners[corner];
        }
      }
      std::sort(facet.corners.begin(), facet.corners.end());
      facets.push_back(facet);
    }
  }

  void addNeighbor(std::size_t tetrahedron, std::size_t neighbor)
  {
    std::array<std::size_t, 4>& all = this->Neighbors[tetrahedron];
    *std::find(all.begin(), all.end(), none) = neighbor;
  }

  std::vector<std::array<std::size_t, 4>> Neighbors; // as many as there are, then none
};

} // namespace isopoint

#endif
