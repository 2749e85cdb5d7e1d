// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_CrossingEdge_h
#define isopoint_CrossingEdge_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

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

/// The leaves at the ends of edges, ordered, each once.
template <class TSample>
std::vector<std::size_t> leavesOf(const std::vector<CrossingEdge<TSample>>& edges)
{
  std::vector<std::size_t> leaves;
  leaves.reserve(2 * edges.size());
  for (const CrossingEdge<TSample>& edge : edges)
  {
    leaves.push_back(static_cast<std::size_t>(edge.firstLeaf));
    leaves.push_back(static_cast<std::size_t>(edge.secondLeaf));
  }
  std::sort(leaves.begin(), leaves.end());
  leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  return leaves;
}

} // namespace isopoint

#endif
