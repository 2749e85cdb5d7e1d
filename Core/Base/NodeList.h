// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_NodeList_h
#define isopoint_NodeList_h

#include <cstddef>

namespace isopoint
{

/// A part of a list of numbers, as of nodes: mostly the neighbors of a leaf.
template <class TId>
struct NodeList
{
  const TId* first = nullptr;
  std::size_t count = 0;

  bool isEmpty() const { return this->count == 0; }
  const TId* begin() const { return this->first; }
  const TId* end() const { return this->first + this->count; }
  std::size_t operator[](std::size_t i) const { return static_cast<std::size_t>(this->first[i]); }
};

} // namespace isopoint

#endif
