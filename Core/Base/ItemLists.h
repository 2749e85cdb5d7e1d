// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_ItemLists_h
#define isopoint_ItemLists_h

#include "Core/Base/NodeList.h"

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace isopoint
{

/// The items at each of a number of places, such as the triangles at each vertex: one list after
/// the other in memory, each ascending.
class ItemLists
{
public:
  /// @param placesOf(item) the places of an item, each once and below placeCount; called twice
  /// @throws std::bad_alloc
  /// Complexity: O(places + items)
  template <class PlacesOf>
  ItemLists(std::size_t placeCount, std::size_t itemCount, const PlacesOf& placesOf)
    : Begins(placeCount + 1)
  {
    for (std::size_t item = 0; item < itemCount; ++item)
    {
      for (const auto place : placesOf(item))
      {
        ++this->Begins[static_cast<std::size_t>(place)];
      }
    }
    std::partial_sum(this->Begins.begin(), this->Begins.end(), this->Begins.begin());
    this->Items.resize(this->Begins.back());
    for (std::size_t item = itemCount; item-- > 0;)
    {
      for (const auto place : placesOf(item))
      {
        this->Items[--this->Begins[static_cast<std::size_t>(place)]] = item;
      }
    }
  }

  NodeList<std::size_t> at(std::size_t place) const
  {
    const std::size_t begin = this->Begins[place];
    return { this->Items.data() + begin, this->Begins[place + 1] - begin };
  }

  /// The lists of all places, one after the other.
  std::vector<std::size_t> all() && { return std::move(this->Items); }

private:
  std::vector<std::size_t> Begins; // by place, and the end of the last list
  std::vector<std::size_t> Items;
};

} // namespace isopoint

#endif
