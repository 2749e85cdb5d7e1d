// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Isosurface_h
#define isopoint_Isosurface_h

#include "Isopoint/Fit/LocalFit.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isopoint
{

/// A point of the isosurface on the edge between two samples, at
/// p_first + parameter * (p_second - p_first).
struct Isopoint
{
  std::uint64_t first;  // a sample's id
  std::uint64_t second; // that of another, first < second
  double parameter;     // 0 .. 1

  bool operator<(const Isopoint& other) const
  {
    return this->first != other.first ? this->first < other.first : this->second < other.second;
  }
  bool operator==(const Isopoint& other) const
  {
    return this->first == other.first && this->second == other.second;
  }
};

/// Samples of exactly one position, which count as one: it bears the lowest id, and the mean of
/// their values and other attributes.
struct CoincidentSamples
{
  std::vector<std::uint64_t> ids; // ascending, at least two
};

/// The isopoints of one isovalue, each edge once, ordered by (first, second), the merged samples
/// among their ends, ordered by lowest id, and, where asked for, what was fitted around each
/// isopoint. The parameter of one that was moved is that of the nearest place on its edge.
struct Isosurface
{
  std::vector<Isopoint> points;
  std::vector<CoincidentSamples> merged;
  std::vector<LocalFit> fits; // one for each point, or none

  /// The samples that count as the one of this id, or null if it is a sample of its own.
  /// O(log merged.size())
  const CoincidentSamples* coincidentAt(std::uint64_t id) const
  {
    const auto found = std::lower_bound(this->merged.begin(), this->merged.end(), id,
      [](const CoincidentSamples& group, std::uint64_t wanted) { return group.ids.front() < wanted; });
    return found != this->merged.end() && found->ids.front() == id ? &*found : nullptr;
  }
};

/// The mean of values that count as one, in the order of their ids and kept within their range,
/// which the rounding of a sum may leave by a bit. @param count at least 1
/// @param valueAt the i-th value, as a double
template <class ValueAt>
double meanOf(std::size_t count, const ValueAt& valueAt)
{
  double sum = 0.0;
  double minimum = valueAt(0);
  double maximum = minimum;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double value = valueAt(i);
    sum += value;
    minimum = std::min(minimum, value);
    maximum = std::max(maximum, value);
  }
  return std::min(std::max(sum / static_cast<double>(count), minimum), maximum);
}

/// What samples have of an attribute: their own, or the mean over those that count as one, computed
/// once for each surface however many points end there.
template <class AttributeAt>
class CoincidentAttribute
{
public:
  /// @param attributeAt(id) the attribute of a sample by itself, as a double
  CoincidentAttribute(const Isosurface& surface, const AttributeAt& attributeAt)
    : Surface(surface)
    , Own(attributeAt)
  {
    this->Means.reserve(surface.merged.size());
    for (const CoincidentSamples& group : surface.merged)
    {
      this->Means.push_back(meanOf(group.ids.size(),
        [&](std::size_t i) { return static_cast<double>(this->Own(group.ids[i])); }));
    }
  }

  /// O(log merged samples)
  double operator()(std::uint64_t id) const
  {
    const CoincidentSamples* const group = this->Surface.coincidentAt(id);
    return group ? this->Means[static_cast<std::size_t>(group - this->Surface.merged.data())]
                 : this->Own(id);
  }

private:
  const Isosurface& Surface;
  AttributeAt Own;
  std::vector<double> Means; // of the surface's groups
};

} // namespace isopoint

#endif
