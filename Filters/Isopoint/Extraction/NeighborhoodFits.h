// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_NeighborhoodFits_h
#define isopoint_NeighborhoodFits_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Fit/DetectionRate.h"
#include "Isopoint/Base/Interpolation.h"
#include "Isopoint/Extraction/Isosurface.h"
#include "Isopoint/Fit/LocalFit.h"
#include "Isopoint/Extraction/SampleGatherer.h"
#include "Isopoint/Extraction/ExtractionContext.h"
#include "Isopoint/Base/SortUnique.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isopoint
{

/// An isopoint and the leaves that its edge connects.
template <class TSample>
struct LocatedIsopoint : Isopoint
{
  typename TSample::Id firstLeaf;
  typename TSample::Id secondLeaf;
};

/// Fits to the samples around edges, one edge at a time. Scratch is kept.
template <class TSample>
class NeighborhoodFitter
{
public:
  NeighborhoodFitter(const SampleTree<TSample>& tree, double isovalue, FitRequest request,
    ExtractionContext<TSample>& shared)
    : Isovalue(isovalue)
    , Request(request)
    , Gatherer(tree, isovalue, shared)
  {
  }

  /// @param point whose parameter is set to where it is moved
  LocalFit fit(LocatedIsopoint<TSample>& point, DetectionRates& tallies)
  {
    this->Gatherer.gather(point.firstLeaf, point.secondLeaf);
    const FitSample first = this->Gatherer.sampleAt(point.firstLeaf);
    const FitSample second = this->Gatherer.sampleAt(point.secondLeaf);
    FitEdge edge;
    for (int axis = 0; axis < 3; ++axis)
    {
      edge.position[axis] =
        interpolate(first.position[axis], second.position[axis], point.parameter);
    }
    const bool rises = first.value < this->Isovalue;
    edge.rising = rises ? difference(second.position, first.position)
                        : difference(first.position, second.position);
    edge.rise = rises ? second.value - first.value : first.value - second.value;
    edge.spacing = this->Gatherer.spacing();
    LocalFit fit = fitAround(
      edge, this->Isovalue, this->Gatherer.samples(),
      [&]() -> const std::vector<FitSample>& { return this->Gatherer.widerSamples(); },
      this->Request.highest, tallies);
    fit.spacing = edge.spacing;
    if (!this->Request.move)
    {
      fit.position = edge.position;
    }
    else if (fit.order != FitOrder::None)
    {
      const Vector along = difference(second.position, first.position);
      const double parameter =
        dot(difference(fit.position, first.position), directionOf(along)) / lengthOf(along);
      point.parameter = std::min(std::max(parameter, 0.0), 1.0);
    }
    return fit;
  }

private:
  const double Isovalue;
  const FitRequest Request;
  SampleGatherer<TSample> Gatherer;
};

/// The place of an isopoint in the tree.
struct TreePlace
{
  std::uint64_t lower; // of its edge's ends among the tree's samples
  std::uint64_t upper;
  std::size_t point;

  bool operator<(const TreePlace& other) const
  {
    return this->lower != other.lower ? this->lower < other.lower : this->upper < other.upper;
  }
  bool operator==(const TreePlace& other) const
  {
    return this->lower == other.lower && this->upper == other.upper;
  }
};

/// Isopoints in the order of the tree, where those that follow each other lie close together,
/// however samples are numbered.
template <class TSample>
std::vector<TreePlace> placesOf(const Execution& execution, const SampleTree<TSample>& tree,
  const std::vector<LocatedIsopoint<TSample>>& points)
{
  const auto beginOf = [&tree](typename TSample::Id nodeIndex) -> std::uint64_t
  { return tree.nodes[static_cast<std::size_t>(nodeIndex)].begin; };
  std::vector<TreePlace> places;
  places.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const auto [lower, upper] =
      std::minmax({ beginOf(points[i].firstLeaf), beginOf(points[i].secondLeaf) });
    places.push_back({ lower, upper, i });
  }
  return sortedUnique(
    execution, places, tree.samples.size(), [](const TreePlace& place) { return place.lower; });
}

/// Fits to the samples around each isopoint: to those of the two cells that its edge connects and
/// of the cells that touch one of them. Where one of the two touches more than 256, its own are
/// left out; where both do, those that are small as seen from it are represented by one. The tree
/// is to be refined for the isovalue. Isopoints are fitted in groups of 256 that follow each other
/// in the tree: what the others tell of detail and creases decides on doubtful ones (see
/// DetectionRate).
/// @param points whose parameters are set to where moved isopoints stand
template <class TSample>
std::vector<LocalFit> fitNeighborhoods(const Execution& execution, const SampleTree<TSample>& tree,
  double isovalue, FitRequest request, ExtractionContext<TSample>& shared,
  std::vector<LocatedIsopoint<TSample>>& points)
{
  std::vector<LocalFit> fits(points.size());
  const std::vector<TreePlace> places = placesOf(execution, tree, points);
  // So many isopoints share tallies. Batches are of few groups: where cells touch hundreds of
  // others, a point takes long.
  constexpr std::size_t groupSize = 256;
  constexpr std::size_t batch = 4;
  forBatches(execution, (places.size() + groupSize - 1) / groupSize, batch, 1,
    [&](std::size_t begin, std::size_t end)
    {
      NeighborhoodFitter<TSample> fitter(tree, isovalue, request, shared);
      for (std::size_t group = begin; group < end; ++group)
      {
        DetectionRates tallies;
        const std::size_t groupEnd = std::min((group + 1) * groupSize, places.size());
        for (std::size_t i = group * groupSize; i < groupEnd; ++i)
        {
          const std::size_t point = places[i].point;
          fits[point] = fitter.fit(points[point], tallies);
        }
      }
    });
  return fits;
}

} // namespace isopoint

#endif
