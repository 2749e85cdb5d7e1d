// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_IsosurfaceExtractor_h
#define isopoint_IsosurfaceExtractor_h

#include "Core/Base/Execution.h"
#include "Core/Base/Team.h"
#include "Core/ExtractionRequest.h"
#include "Core/Neighbors/NeighborhoodCache.h"
#include "Core/Ranks/SharedTree.h"
#include "Core/Ranks/ValueExchange.h"
#include "Core/Tetrahedra/Band.h"
#include "Core/Tree/Loading.h"
#include "Core/Tree/SampleTree.h"

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

/// The samples of one layout, and what has been found out about them.
template <class TSample>
struct SampleCloud
{
  SampleTree<TSample> tree;
  NeighborhoodCache<typename TSample::Id> neighborhoods;
  std::vector<std::uint64_t> begins;    // see SharedTree; of a cloud on ranks
  std::unique_ptr<Band> band = nullptr; // of the last triangles, if it is worth its memory
};

/// What IsosurfaceExtractor::extract() does, for one layout of samples. Each layout is compiled in
/// a file of its own, since that takes long.
/// @param itemCount of all ranks, those left out included
/// @param team null unless the cloud is on ranks
template <class TSample>
ExtractedIsosurface extractFromCloud(const Execution& execution, SampleCloud<TSample>& cloud,
  std::size_t itemCount, Team* team, const ExtractionRequest& request, ExtractedIsosurface* ghosts);

/// The narrowest layout that holds coordinates and values of these types (float or double).
template <class TCoordinate, class TValue>
using SampleFor = std::conditional_t<std::is_same_v<TCoordinate, float>,
  std::conditional_t<std::is_same_v<TValue, float>, FloatSample, FloatSampleOfDouble>,
  std::conditional_t<std::is_same_v<TValue, float>, DoubleSampleOfFloat, WideSample>>;

/// Extracts isosurfaces from one cloud of samples: the one door of the core, whose header brings
/// all types that go through it. The tree, the neighborhoods and, of triangles, the tetrahedrized
/// samples (see IsosurfaceRequest::keepsBand) are kept from one extraction to the next: the first
/// takes O(n) for each level of the tree whose regions are not yet smaller than the surface; a
/// further one only what lies near its own surface. The progress of a load or an extraction rises
/// up to 1.
class IsosurfaceExtractor
{
public:
  /// Loads a cloud of `count` items, with the ids 0 .. count - 1, in place of any former one.
  /// @param read(id, position, value) writes coordinates (three TCoordinate) and value (TValue) of
  /// an item and returns whether it takes part; called from any thread. Its parameters are to be
  /// `auto*` and `auto&`: very large clouds are held in wider types.
  /// @throws std::bad_alloc or Aborted, and then holds no samples
  template <class TCoordinate, class TValue, class Reader>
  void load(const Execution& execution, std::size_t count, const Reader& read)
  {
    this->clear();
    if (isNarrow(count))
    {
      using TSample = SampleFor<TCoordinate, TValue>;
      this->Held = SampleCloud<TSample>{ loadSamples<TSample>(execution, count, read), {}, {} };
    }
    else
    {
      this->Held =
        SampleCloud<WideSample>{ loadSamples<WideSample>(execution, count, read), {}, {} };
    }
    this->ItemCount = count;
    execution.progress(1.0);
  }

  /// Loads this rank's items of a cloud that is distributed over the ranks of a team, which may be
  /// one. Ids are those of the concatenation of all ranks' items, in the order of the ranks.
  /// Collective, and so are extract() and replaceValues() from then on; see Team::together().
  /// @param team must outlive this extractor, or the next load() or clear()
  /// @param count of this rank's items, read as above with local ids from 0 on
  template <class TCoordinate, class TValue, class Reader>
  void load(const Execution& execution, Team& team, std::size_t count, const Reader& read)
  {
    if (team.size() == 1)
    {
      this->load<TCoordinate, TValue>(execution, count, read);
      return;
    }
    this->clear();
    std::vector<std::uint64_t> counts = team.gather(std::uint64_t{ count });
    const std::uint64_t all = std::accumulate(counts.begin(), counts.end(), std::uint64_t{ 0 });
    if (isNarrow(all))
    {
      this->loadShared<SampleFor<TCoordinate, TValue>>(execution, team, counts, all, read);
    }
    else
    {
      this->loadShared<WideSample>(execution, team, counts, all, read);
    }
    this->ItemCount = all;
    this->ItemCounts.swap(counts);
    this->Group = &team;
    execution.progress(1.0);
  }

  /// States the standard error that the values of the loaded samples have at least, as by rounding:
  /// 0 unless this is called after a load(). Fits take no differences below it for details.
  /// @param error finite, not negative
  void setValueError(double error);

  /// Replaces the values, provided that positions, types and the items that take part are those of
  /// the last load(); the tree is kept. Otherwise nothing changes. All ranks have to hold what they
  /// loaded last. A digest stands for positions: others pass for the same once in 2^64 cases.
  /// @returns whether it did
  /// @throws Aborted, the former values kept or all samples dropped; std::bad_alloc, and then holds
  /// no samples
  template <class TCoordinate, class TValue, class Reader>
  bool replaceValues(const Execution& execution, std::size_t count, const Reader& read)
  {
    return isNarrow(this->Group ? this->ItemCount : count)
             ? this->replaceValuesAs<SampleFor<TCoordinate, TValue>>(execution, count, read)
             : this->replaceValuesAs<WideSample>(execution, count, read);
  }

  /// Whether the samples are those of several ranks.
  bool isOnRanks() const { return this->Group != nullptr; }

  /// Drops all samples and frees their memory.
  void clear();

  /// The number of samples that take part, coincident ones counted separately.
  std::size_t sampleCount() const;

  /// The number of items that do not.
  std::size_t skippedCount() const;

  /// The least and the greatest value of the samples that take part, of all ranks; infinity and its
  /// negative without any.
  std::pair<double, double> valueRange() const;

  /// The canonical isosurface and, if requested, its splats: the same for any execution and any
  /// order of calls.
  ///
  /// Of a cloud on ranks, each isopoint is returned on one of them, and so is each triangle, with
  /// its vertices.
  /// @param ghosts null, or receives, with all that is known of them, the isopoints that are on
  /// other ranks, but within some rings around those of this one (see docs/ranks.md); all ranks
  /// ask for them, or none. Nothing with triangles, see ExtractionRequest
  /// @throws std::bad_alloc, Aborted, or std::length_error (see NarrowBand); the next call works as
  /// if this one had not been
  ExtractedIsosurface extract(const Execution& execution, const ExtractionRequest& request,
    ExtractedIsosurface* ghosts = nullptr);

private:
  template <class TSample, class Reader>
  void loadShared(const Execution& execution, Team& team, const std::vector<std::uint64_t>& counts,
    std::uint64_t all, const Reader& read)
  {
    const auto own = counts.begin() + team.rank();
    const auto first = std::accumulate(counts.begin(), own, std::uint64_t{ 0 });
    SampleTree<TSample> loaded = loadSamples<TSample>(
      partOf(execution, 0.0, 0.5), static_cast<std::size_t>(*own), read, first);
    this->Positions = digestOfSamples(execution, loaded.samples, first);
    SharedTree<TSample> shared =
      SharedTreeBuilder<TSample>(team, std::move(loaded), all).build(partOf(execution, 0.5, 1.0));
    this->Held = SampleCloud<TSample>{ std::move(shared.tree), {}, std::move(shared.begins) };
  }

  static bool isNarrow(std::size_t count) { return count < std::size_t{ 1 } << 30; }

  template <class TSample, class Reader>
  bool replaceValuesAs(const Execution& execution, std::size_t count, const Reader& read)
  {
    auto* const cloud = std::get_if<SampleCloud<TSample>>(&this->Held);
    if (!cloud || cloud->tree.isEmpty()) // on all ranks
    {
      return false;
    }
    if (!this->holdsPositions(execution, cloud->tree, count, read))
    {
      return false;
    }
    try
    {
      if (this->Group)
      {
        ValueExchange<TSample>(*this->Group, cloud->tree, cloud->begins, this->ItemCounts)
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

  /// Whether the tree holds exactly the items that take part, at their positions. Collective.
  template <class TSample, class Reader>
  bool holdsPositions(const Execution& execution, const SampleTree<TSample>& tree,
    std::size_t count, const Reader& read)
  {
    const std::size_t loaded = this->Group
                                 ? this->ItemCounts[static_cast<std::size_t>(this->Group->rank())]
                                 : this->ItemCount;
    const std::uint64_t positions =
      this->Group ? this->Positions : digestOfSamples(execution, tree.samples, 0);
    const bool isSame =
      count == loaded && digestOfItems<TSample>(execution, count, read) == positions;
    return this->Group ? !this->Group->isAny(!isSame) : isSame;
  }

  std::variant<SampleCloud<FloatSample>, SampleCloud<FloatSampleOfDouble>,
    SampleCloud<DoubleSampleOfFloat>, SampleCloud<WideSample>>
    Held;
  std::size_t ItemCount = 0; // of all ranks
  // Of a cloud on ranks:
  Team* Group = nullptr;
  std::vector<std::uint64_t> ItemCounts; // of each rank
  std::uint64_t Positions = 0;           // of this rank's items, a digest
};

} // namespace isopoint

#endif
