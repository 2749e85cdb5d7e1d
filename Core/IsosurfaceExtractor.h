// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/ProcessGroup.h"
#include "Core/ExtractionRequest.h"
#include "Core/Neighbors/NeighborhoodCache.h"
#include "Core/Ranks/SharedTree.h"
#include "Core/Ranks/ValueExchange.h"
#include "Core/Tetrahedra/KeptTetrahedra.h"
#include "Core/Tree/Loading.h"
#include "Core/Tree/SampleTree.h"
#include "Core/Tree/Scaling.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace isopoint
{

// See Core/Probe.h.
struct Neighborhoods;
struct ProbedArray;
struct ProbeOptions;

/// The samples of one layout, and data kept between extractions.
template <class TSample>
struct SampleCloud
{
  SampleTree<TSample> tree;
  NeighborhoodCache<typename TSample::Id> neighborhoods;
  std::vector<std::uint64_t> begins; // see SharedTree; only on ranks
  /// Of the last triangles, if worth the memory.
  std::unique_ptr<KeptTetrahedra> keptTetrahedra = nullptr;
  /// Positions are those of the input divided by 2^exponent: see scaleExponent(). The same on all
  /// ranks.
  int exponent = 0;
};

/// IsosurfaceExtractor::extract() for one layout, each of which is compiled in its own file.
/// @param itemCount of all ranks, including items left out
/// @param processes null unless the cloud is on ranks
template <class TSample>
ExtractedIsosurface extractFromCloud(const Execution& execution, SampleCloud<TSample>& cloud,
  std::size_t itemCount, ProcessGroup* processes, const ExtractionRequest& request,
  ExtractedIsosurface* ghosts);

/// The narrowest layout for coordinates and values of these types (float or double).
template <class TCoordinate, class TValue>
using SampleFor = std::conditional_t<std::is_same_v<TCoordinate, float>,
  std::conditional_t<std::is_same_v<TValue, float>, FloatSample, FloatSampleOfDouble>,
  std::conditional_t<std::is_same_v<TValue, float>, DoubleSampleOfFloat, WideSample>>;

/// Extracts isosurfaces from a cloud of samples: the facade of the core. Keeps the tree, the
/// neighborhoods and, for triangles, the tetrahedralization (see
/// IsosurfaceRequest::keepsTetrahedra) between extractions. The first extraction takes O(n) for
/// each level of the tree whose regions are not smaller than the surface; others only process the
/// vicinity of their surface. The progress of a load or an extraction rises to 1.
class IsosurfaceExtractor
{
public:
  /// Replaces the cloud by one of `count` items with the ids 0 .. count - 1.
  /// @param read(id, position, value) writes an item's coordinates (three TCoordinate) and value
  /// (TValue); returns false to leave it out. Called from any thread. Parameters must be `auto*`
  /// and `auto&`: very large clouds are held in wider types
  /// @throws std::bad_alloc or Aborted, after which there are no samples
  template <class TCoordinate, class TValue, class Reader>
  void load(const Execution& execution, std::size_t count, const Reader& read)
  {
    this->clear();
    isNarrow(count) ? this->loadAlone<SampleFor<TCoordinate, TValue>>(execution, count, read)
                    : this->loadAlone<WideSample>(execution, count, read);
    this->ItemCount = count;
    execution.progress(1.0);
  }

  /// Loads this rank's items of a cloud that is distributed over a process group, perhaps of one
  /// rank. Ids number the items of all ranks, in rank order. Collective; so are extract() and
  /// replaceValues() afterwards. See ProcessGroup::runCollectively().
  /// @param processes must outlive this extractor, or the next load() or clear()
  /// @param count of this rank's items, read as above by local ids from 0 on
  template <class TCoordinate, class TValue, class Reader>
  void load(
    const Execution& execution, ProcessGroup& processes, std::size_t count, const Reader& read)
  {
    if (processes.size() == 1)
    {
      this->load<TCoordinate, TValue>(execution, count, read);
      return;
    }
    this->clear();
    std::vector<std::uint64_t> counts = processes.gather(std::uint64_t{ count });
    const std::uint64_t all = std::accumulate(counts.begin(), counts.end(), std::uint64_t{ 0 });
    using TSample = SampleFor<TCoordinate, TValue>;
    isNarrow(all) ? this->loadShared<TSample>(execution, processes, counts, all, read)
                  : this->loadShared<WideSample>(execution, processes, counts, all, read);
    this->ItemCount = all;
    this->ItemCounts.swap(counts);
    this->Processes = &processes;
    execution.progress(1.0);
  }

  /// Sets the least standard error of the loaded values, such as a rounding error; 0 after load().
  /// @param error finite, not negative
  void setValueError(double error);

  /// Replaces the values if positions, types and items in use equal those of the last load(), and
  /// keeps the tree; otherwise nothing changes. All ranks must still hold what they loaded.
  /// Positions are compared by a hash: different ones pass with a probability of 2^-64, unless
  /// someone chose them to.
  /// @returns whether values were replaced
  /// @throws Aborted, after which the old values are kept or all samples dropped; std::bad_alloc,
  /// after which there are no samples
  template <class TCoordinate, class TValue, class Reader>
  bool replaceValues(const Execution& execution, std::size_t count, const Reader& read)
  {
    return isNarrow(this->Processes ? this->ItemCount : count)
             ? this->replaceValuesAs<SampleFor<TCoordinate, TValue>>(execution, count, read)
             : this->replaceValuesAs<WideSample>(execution, count, read);
  }

  /// Whether the samples are those of several ranks.
  bool isOnRanks() const { return this->Processes != nullptr; }

  /// Drops all samples and frees their memory.
  void clear();

  /// The number of samples in use; coincident ones count separately.
  std::size_t sampleCount() const;

  /// The number of items left out.
  std::size_t skippedCount() const;

  /// The spacing of the samples on all ranks in steps of float at their coordinates, along the axis
  /// of the coarsest steps: below 1, float32 does not tell neighbors apart. The spacing is that of
  /// as many samples spread evenly in their box, without the sides of it that are shorter than
  /// that. Infinity if positions are not held as float, or all are the same.
  double spacingInFloatSteps() const;

  /// The least and greatest value of the samples in use on all ranks; +infinity, -infinity if none.
  std::pair<double, double> valueRange() const;

  /// The canonical isosurface and, if requested, its splats; independent of execution and former
  /// calls. On ranks, each isopoint, and each triangle with its vertices, is returned on one rank.
  /// @param ghosts null, as for triangles, or receives the isopoints of other ranks within some
  /// rings around this rank's, with all data (docs/ranks.md). The same choice on all ranks
  /// @throws std::bad_alloc, Aborted, TreeTooLarge (see NarrowBand); later calls still work
  ExtractedIsosurface extract(const Execution& execution, const ExtractionRequest& request,
    ExtractedIsosurface* ghosts = nullptr);

  /// Interpolates arrays of the samples at places, and their gradients (docs/algorithm.md, section
  /// 13). Loaded values take no part. On ranks collective: each has its own places, and the arrays'
  /// numbers of its own items. The same result on any number of ranks.
  /// @param kinds null, or receives PlaceKinds for each place
  /// @throws std::bad_alloc, Aborted, TreeTooLarge (see NarrowBand); later calls still work
  void probe(const Execution& execution, const std::vector<Vector>& places,
    const ProbeOptions& options, const std::vector<ProbedArray>& arrays,
    std::uint8_t* kinds = nullptr);

  /// The samples around places, for any number of arrays. Collective; throws as probe().
  Neighborhoods findNeighborhoods(
    const Execution& execution, const std::vector<Vector>& places, const ProbeOptions& options);

  /// Interpolates arrays of the samples at the places of neighborhoods. Collective; throws as
  /// probe().
  void probe(const Execution& execution, const Neighborhoods& neighborhoods,
    const std::vector<ProbedArray>& arrays);

private:
  template <class TSample, class Reader>
  void loadAlone(const Execution& execution, std::size_t count, const Reader& read)
  {
    SampleCloud<TSample> cloud{ loadSamples<TSample>(execution, count, read), {}, {} };
    const double greatest = greatestCoordinate(cloud.tree);
    cloud.exponent =
      isOutOfScale<TSample>(greatest) ? scaleExponent(greatest, countExponents(cloud.tree)) : 0;
    dividePositions(execution, cloud.tree, cloud.exponent);
    this->Cloud = std::move(cloud);
  }

  template <class TSample, class Reader>
  void loadShared(const Execution& execution, ProcessGroup& processes,
    const std::vector<std::uint64_t>& counts, std::uint64_t all, const Reader& read)
  {
    const auto own = counts.begin() + processes.rank();
    const auto first = std::accumulate(counts.begin(), own, std::uint64_t{ 0 });
    SampleTree<TSample> loaded = loadSamples<TSample>(
      partOf(execution, 0.0, 0.5), static_cast<std::size_t>(*own), read, first);
    const int exponent = exponentOfAll(processes, loaded);
    dividePositions(execution, loaded, exponent);
    this->PositionsHash = hashOfSamples(execution, loaded.samples, first);
    SharedTree<TSample> shared = SharedTreeBuilder<TSample>(processes, std::move(loaded), all)
                                   .build(partOf(execution, 0.5, 1.0));
    this->Cloud = SampleCloud<TSample>{ std::move(shared.tree), {}, std::move(shared.begins),
      nullptr, exponent };
  }

  /// The exponent for the samples of all ranks. Collective.
  template <class TSample>
  static int exponentOfAll(ProcessGroup& processes, const SampleTree<TSample>& own)
  {
    if (std::is_same_v<typename TSample::Coordinate, float>)
    {
      return 0;
    }
    const double greatest = fromOrderedKey(processes.maximum(orderedKey(greatestCoordinate(own))));
    if (!isOutOfScale<TSample>(greatest))
    {
      return 0;
    }
    std::vector<std::uint64_t> counts = countExponents(own);
    processes.sum(counts);
    return scaleExponent(greatest, counts);
  }

  static bool isNarrow(std::size_t count) { return count < std::size_t{ 1 } << 30; }

  template <class TSample, class Reader>
  bool replaceValuesAs(const Execution& execution, std::size_t count, const Reader& read)
  {
    auto* const cloud = std::get_if<SampleCloud<TSample>>(&this->Cloud);
    if (!cloud || cloud->tree.isEmpty() || // on all ranks
        !this->holdsPositions(execution, *cloud, count, read))
    {
      return false;
    }
    try
    {
      if (this->Processes)
      {
        ValueExchange<TSample>(*this->Processes, cloud->tree, cloud->begins, this->ItemCounts)
          .replace(execution, read);
      }
      else
      {
        isopoint::replaceValues(execution, cloud->tree, read);
      }
    }
    catch (...)
    {
      this->clear(); // values and ranges may disagree
      throw;
    }
    return true;
  }

  /// Whether the tree holds exactly the items in use, at their positions. Collective.
  template <class TSample, class Reader>
  bool holdsPositions(const Execution& execution, const SampleCloud<TSample>& cloud,
    std::size_t count, const Reader& read)
  {
    const std::size_t loaded =
      this->Processes ? this->ItemCounts[static_cast<std::size_t>(this->Processes->rank())]
                      : this->ItemCount;
    const std::uint64_t positions =
      this->Processes ? this->PositionsHash : hashOfSamples(execution, cloud.tree.samples, 0);
    const bool isSame = count == loaded && hashOfItems<TSample>(execution, count,
                                             dividedReader(read, cloud.exponent)) == positions;
    return this->Processes ? !this->Processes->isAny(!isSame) : isSame;
  }

  std::variant<SampleCloud<FloatSample>, SampleCloud<FloatSampleOfDouble>,
    SampleCloud<DoubleSampleOfFloat>, SampleCloud<WideSample>>
    Cloud;
  std::size_t ItemCount = 0; // of all ranks
  // Only on ranks:
  ProcessGroup* Processes = nullptr;
  std::vector<std::uint64_t> ItemCounts; // by rank
  std::uint64_t PositionsHash = 0;       // hash of this rank's items
};

} // namespace isopoint
