// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_IsosurfaceExtractor_h
#define isopoint_IsosurfaceExtractor_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Neighbors/ExtentQuery.h"
#include "Isopoint/Extraction/Isosurface.h"
#include "Isopoint/Tree/Loading.h"
#include "Isopoint/Tree/SampleTree.h"

#include <cstddef>
#include <optional>
#include <type_traits>
#include <variant>

namespace isopoint
{

/// The narrowest layout that holds coordinates and values of these types (float or double).
template <class TCoordinate, class TValue>
using SampleFor = std::conditional_t<std::is_same_v<TCoordinate, float>,
  std::conditional_t<std::is_same_v<TValue, float>, FloatSample, FloatSampleOfDouble>,
  std::conditional_t<std::is_same_v<TValue, float>, DoubleSampleOfFloat, WideSample>>;

/// Extracts isosurfaces from one cloud of samples, and keeps what it learns of the cloud from one
/// extraction to the next. The first costs O(n) for each level of the tree whose regions are not
/// yet smaller than the surface; a further one only what its own band adds.
class IsosurfaceExtractor
{
public:
  /// Takes over a cloud of `count` items, with the ids 0 .. count - 1, in place of any former one.
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
      this->Tree = loadSamples<SampleFor<TCoordinate, TValue>>(execution, count, read);
    }
    else
    {
      this->Tree = loadSamples<WideSample>(execution, count, read);
    }
    this->ItemCount = count;
  }

  /// Takes over new values, where positions, types and the items that take part are those of the
  /// last load(): the tree is kept. Otherwise nothing changes.
  /// @returns whether it did
  /// @throws Aborted, the former values kept; std::bad_alloc, and then holds no samples
  template <class TCoordinate, class TValue, class Reader>
  bool replaceValues(const Execution& execution, std::size_t count, const Reader& read)
  {
    return isNarrow(count)
             ? this->replaceValuesAs<SampleFor<TCoordinate, TValue>>(execution, count, read)
             : this->replaceValuesAs<WideSample>(execution, count, read);
  }

  /// Forgets all samples and frees their memory.
  void clear();

  /// Samples that take part, those of one position counted separately.
  std::size_t sampleCount() const;

  /// Items that do not.
  std::size_t skippedCount() const;

  /// The canonical isosurface: the same for any execution and any order of calls.
  /// @param isovalue any; none is found where no two samples lie on either side of it
  /// @param angle of the angle criterion in degrees, 0 up to 180
  /// @param gapFactor of the gap criterion: 0, which drops nothing, or positive
  /// @param fitRequest what is fitted to the samples around each isopoint (see fitAround); without
  /// it nothing is
  /// @throws std::bad_alloc, Aborted, or std::length_error (see NarrowBand); the next call works as
  /// if this one had not been
  Isosurface extract(const Execution& execution, double isovalue, double angle,
    double gapFactor = 0.0, std::optional<FitRequest> fitRequest = std::nullopt);

  /// What tells how far samples stand ahead of a place (see extentOfSamples), as long as nothing
  /// else of this is called.
  /// @throws std::bad_alloc
  SampleExtents sampleExtents() const;

private:
  static bool isNarrow(std::size_t count) { return count < std::size_t{ 1 } << 30; }

  template <class TSample, class Reader>
  bool replaceValuesAs(const Execution& execution, std::size_t count, const Reader& read)
  {
    auto* const tree = std::get_if<SampleTree<TSample>>(&this->Tree);
    if (!tree || tree->isEmpty() || count != this->ItemCount ||
        !holdsPositions(execution, *tree, count, read))
    {
      return false;
    }
    try
    {
      isopoint::replaceValues(execution, *tree, read);
    }
    catch (...)
    {
      this->clear(); // values and ranges may disagree
      throw;
    }
    return true;
  }

  std::variant<SampleTree<FloatSample>, SampleTree<FloatSampleOfDouble>,
    SampleTree<DoubleSampleOfFloat>, SampleTree<WideSample>>
    Tree;
  std::size_t ItemCount = 0;
};

} // namespace isopoint

#endif
