// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_IsosurfaceExtractor_h
#define isopoint_IsosurfaceExtractor_h

#include "Execution.h"
#include "Isopoint.h"
#include "Loading.h"
#include "SampleTree.h"

#include <cstddef>
#include <cstdint>
#include <limits>
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
  /// an item and returns whether it takes part; called from any thread. The pointers' and the
  /// reference's types are deduced: take them as `auto`.
  /// @throws std::bad_alloc or Aborted, and then holds no samples
  template <class TCoordinate, class TValue, class Reader>
  void load(const Execution& execution, std::size_t count, const Reader& read)
  {
    this->clear();
    if (count < std::numeric_limits<std::uint32_t>::max())
    {
      this->Tree = loadSamples<SampleFor<TCoordinate, TValue>>(execution, count, read);
    }
    else
    {
      this->Tree = loadSamples<WideSample>(execution, count, read);
    }
    this->ItemCount = count;
  }

  /// Gives the samples new values; the tree is kept. To be called only if the same items take part
  /// with the new values, and TValue of load() holds them.
  /// @param valueAt(id) called from any thread
  template <class ValueAt>
  void replaceValues(const Execution& execution, const ValueAt& valueAt)
  {
    std::visit(
      [&](auto& tree) { isopoint::replaceValues(execution, tree, valueAt); }, this->Tree);
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
  /// @throws std::bad_alloc or Aborted; the next call works as if this one had not been
  Isosurface extract(const Execution& execution, double isovalue, double angle);

private:
  std::variant<SampleTree<FloatSample>, SampleTree<FloatSampleOfDouble>,
    SampleTree<DoubleSampleOfFloat>, SampleTree<WideSample>>
    Tree;
  std::size_t ItemCount = 0;
};

} // namespace isopoint

#endif
