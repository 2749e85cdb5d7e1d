// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Extraction/Isosurface.h"
#include "Core/Fit/LocalFit.h"
#include "Core/Neighbors/NeighborSearch.h"
#include "Core/Ranks/ByteBuffer.h"
#include "Core/Tree/SampleTree.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace isopoint
{

/// An end of an edge for all ranks: the tree index of its leaf, and the position there.
struct SentEnd
{
  std::uint64_t treeIndex;
  Vector position;
};

template <class TSample>
SentEnd sentEnd(const SampleTree<TSample>& tree, std::size_t leaf)
{
  const std::size_t begin = tree.nodes[leaf].begin;
  return { begin, positionOf(tree.samples[begin]) };
}

/// The leaf of an end in this rank's tree. O(depth)
/// @throws MissingNode if this rank does not hold it as a leaf
template <class TSample>
std::size_t leafAt(const SampleTree<TSample>& tree, const SentEnd& end)
{
  std::size_t nodeIndex = rootNode;
  while (tree.nodes[nodeIndex].isSplit())
  {
    const Node<TSample>& node = tree.nodes[nodeIndex];
    nodeIndex = tree.child(node, end.treeIndex >= tree.nodes[node.upperNode()].begin);
  }
  requireLeaf(tree, nodeIndex, Region{ end.position, end.position });
  return nodeIndex;
}

struct SentEdge
{
  std::uint64_t first;
  std::uint64_t second;
  double crossing;
  SentEnd ends[2];
};

struct SentIsopoint
{
  IsopointEdge edge;
  Vector position;
  Vector decreasingEdge;
  std::array<SentEnd, 2> ends;
  LocalFit fit;              // if the surface has fits
  EdgeLeaves leaves{ 0, 0 }; // in the tree of the receiving rank
};

inline void appendFit(ByteBuffer& buffer, const LocalFit& fit)
{
  append(buffer, fit.position);
  append(buffer, fit.gradient);
  append(buffer, fit.isGradientFitted);
  append(buffer, fit.hessian);
  append(buffer, fit.isSmooth);
  append(buffer, fit.spacing);
  append(buffer, static_cast<std::uint8_t>(fit.order ? static_cast<int>(*fit.order) : 0));
  append(buffer, static_cast<std::uint64_t>(fit.creases.size()));
  append(buffer, fit.creases.data(), fit.creases.size());
}

inline LocalFit readFit(ByteReader& in)
{
  LocalFit fit{};
  fit.position = in.read<Vector>();
  fit.gradient = in.read<Vector>();
  fit.isGradientFitted = in.read<bool>();
  fit.hessian = in.read<Hessian>();
  fit.isSmooth = in.read<bool>();
  fit.spacing = in.read<double>();
  const auto order = in.read<std::uint8_t>();
  if (order > 0)
  {
    fit.order = static_cast<FitOrder>(order);
  }
  fit.creases.resize(in.read<std::uint64_t>());
  in.read(fit.creases.data(), fit.creases.size());
  return fit;
}

/// Writes an isopoint of a surface with leaves.
template <class TSample>
void appendIsopoint(ByteBuffer& buffer, const SampleTree<TSample>& tree, const Isosurface& surface,
  std::size_t isopoint)
{
  append(buffer, surface.edges[isopoint]);
  append(buffer, surface.positions[isopoint]);
  append(buffer, surface.decreasingEdges[isopoint]);
  for (const std::size_t leaf : { surface.leaves[isopoint].first, surface.leaves[isopoint].second })
  {
    append(buffer, sentEnd(tree, leaf));
  }
  if (!surface.fits.empty())
  {
    appendFit(buffer, surface.fits[isopoint]);
  }
}

inline SentIsopoint readIsopoint(ByteReader& in, bool hasFit)
{
  SentIsopoint isopoint{};
  isopoint.edge = in.read<IsopointEdge>();
  isopoint.position = in.read<Vector>();
  isopoint.decreasingEdge = in.read<Vector>();
  in.read(isopoint.ends.data(), isopoint.ends.size());
  if (hasFit)
  {
    isopoint.fit = readFit(in);
  }
  return isopoint;
}

} // namespace isopoint
