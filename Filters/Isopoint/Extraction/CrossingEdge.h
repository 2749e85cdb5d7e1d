// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_CrossingEdge_h
#define isopoint_CrossingEdge_h

#include <cstdint>

namespace isopoint
{

/// An edge between the samples of two leaves on either side of the isovalue.
template <class TSample>
struct CrossingEdge
{
  std::uint64_t first;  // the id of one sample
  std::uint64_t second; // the id of the other, first < second
  double crossing;      // where linear interpolation has the isovalue: 0 at `first`, 1 at `second`
  typename TSample::Id firstLeaf; // node indices
  typename TSample::Id secondLeaf;

  bool operator<(const CrossingEdge& other) const
  {
    return this->first != other.first ? this->first < other.first : this->second < other.second;
  }
  bool operator==(const CrossingEdge& other) const
  {
    return this->first == other.first && this->second == other.second;
  }
};

} // namespace isopoint

#endif
