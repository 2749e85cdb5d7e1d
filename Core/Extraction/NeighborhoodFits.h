// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Sorting.h"
#include "Core/Base/Vector.h"
#include "Core/Extraction/ExtractionContext.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Extraction/SampleGatherer.h"
#include "Core/Fit/LocalFit.h"
#include "Core/Fit/LocalFitter.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace isopoint
{

/// Fits to the samples around edges, one edge at a time. Memory is kept. For one thread.
template <class TSample>
class NeighborhoodFitter
{
public:
  NeighborhoodFitter(ExtractionContext<TSample>& context, FitRequest request)
    : Isovalue(context.isovalue)
    , ValueError(context.tree.valueError)
    , Request(request)
    , Gatherer(context)
    , Fitter(context.isovalue, request.highest.value_or(FitOrder::Linear))
  {
  }

  /// @param start the isopoint before it is moved; null for linear interpolation
  LocalFit fit(const CrossingEdge<TSample>& crossing, const Vector* start)
  {
    this->Gatherer.gather(crossing.firstLeaf, crossing.secondLeaf);
    FitEdge edge = this->edgeOf(crossing);
    edge.position = start ? *start : edge.position;
    if (!this->Request.highest)
    {
      return LocalFitter::onEdge(edge);
    }
    std::optional<LocalFit> fit = this->Fitter.fitNear(edge, this->Gatherer.samples());
    if (!fit)
    {
      const std::size_t nearCount = this->Gatherer.samples().size();
      this->Gatherer.widen();
      fit = this->Fitter.fit(edge, this->Gatherer.samples(), nearCount);
    }
    if (!this->Request.move)
    {
      fit->position = edge.position;
    }
    return *fit;
  }

private:
  FitEdge edgeOf(const CrossingEdge<TSample>& crossing)
  {
    const FitSample first = this->Gatherer.sampleAt(crossing.firstLeaf);
    const FitSample second = this->Gatherer.sampleAt(crossing.secondLeaf);
    const bool increases = first.value < this->Isovalue;
    FitEdge edge;
    edge.position = interpolate(first.position, second.position, crossing.crossing);
    edge.increasing =
      increases ? second.position - first.position : first.position - second.position;
    edge.increase = increases ? second.value - first.value : first.value - second.value;
    edge.spacing = this->Gatherer.spacing();
    edge.valueError = this->ValueError;
    return edge;
  }

  const double Isovalue;
  const double ValueError;
  const FitRequest Request;
  SampleGatherer<TSample> Gatherer;
  LocalFitter Fitter;
};

/// The order of edges in the tree: consecutive ones are close, whatever the samples' ids.
template <class TSample>
std::vector<std::size_t> orderInTree(const Execution& execution, const SampleTree<TSample>& tree,
  const std::vector<CrossingEdge<TSample>>& edges)
{
  const auto beginOf = [&tree](typename TSample::Id leaf) -> std::uint64_t
  { return tree.nodes[leaf].begin; };
  using TreeIndices = std::pair<std::uint64_t, std::uint64_t>; // of both ends, ascending
  return orderByKeys(
    execution, edges.size(), tree.samples.size(),
    [&](std::size_t i) -> TreeIndices {
      return std::minmax({ beginOf(edges[i].firstLeaf), beginOf(edges[i].secondLeaf) });
    },
    [](const TreeIndices& indices) { return indices.first; });
}

/// Fits to the samples around some edges (see SampleGatherer and LocalFitter). Fastest in tree
/// order, since consecutive edges share samples. Collective.
/// @param ranks SingleRank or SharedRanks
/// @param starts the edges' isopoints before they are moved; empty for linear interpolation
/// @param wanted the indices of the edges
/// @param fits one per edge; the wanted ones are set, each from its samples alone
/// @throws Aborted, std::bad_alloc
template <class TSample, class TRanks>
void fitAt(const Execution& execution, ExtractionContext<TSample>& context, TRanks& ranks,
  FitRequest request, const std::vector<CrossingEdge<TSample>>& edges,
  const std::vector<Vector>& starts, const std::vector<std::size_t>& wanted,
  std::vector<LocalFit>& fits)
{
  // Small batches: fits are slow where cells touch hundreds of others, and those with creases.
  const std::size_t grain = request.highest == FitOrder::Crease ? 16 : 256;
  ranks.forEach(
    execution, { wanted.size(), 4 * grain, grain },
    [&]() { return NeighborhoodFitter<TSample>(context, request); },
    [&](NeighborhoodFitter<TSample>& fitter, std::size_t i)
    {
      const std::size_t edge = wanted[i];
      fits[edge] = fitter.fit(edges[edge], starts.empty() ? nullptr : &starts[edge]);
    },
    execution.progress);
}

/// One fit for each edge; see fitAt().
template <class TSample, class TRanks>
std::vector<LocalFit> fitNeighborhoods(const Execution& execution,
  ExtractionContext<TSample>& context, TRanks& ranks, FitRequest request,
  const std::vector<CrossingEdge<TSample>>& edges, const std::vector<Vector>& starts)
{
  std::vector<LocalFit> fits(edges.size());
  fitAt(execution, context, ranks, request, edges, starts,
    orderInTree(execution, context.tree, edges), fits);
  return fits;
}

} // namespace isopoint
