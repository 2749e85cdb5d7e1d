// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatSubset.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace
{

using Splat = vtkIsopointSplatSubset::Splat;
using Vector = std::array<double, 3>;

/// Growth beyond that of an even choice, up to which a splat may cover others.
constexpr double mostGrowth = 2.0;

/// Cosine of the angle between normals up to which splats are of one sheet: 60 degrees.
constexpr double leastCosine = 0.5;

double dot(const float* a, const float* b)
{
  return static_cast<double>(a[0]) * b[0] + static_cast<double>(a[1]) * b[1] +
         static_cast<double>(a[2]) * b[2];
}

struct Place
{
  std::uint64_t Code; // along the curve
  std::uint32_t Index;
  bool operator<(const Place& other) const
  {
    return this->Code != other.Code ? this->Code < other.Code : this->Index < other.Index;
  }
};

/// Spreads 21 bits, two zeros after each.
std::uint64_t spread(std::uint64_t bits)
{
  bits = (bits | bits << 32U) & 0x001f00000000ffffULL;
  bits = (bits | bits << 16U) & 0x001f0000ff0000ffULL;
  bits = (bits | bits << 8U) & 0x100f00f00f00f00fULL;
  bits = (bits | bits << 4U) & 0x10c30c30c30c30c3ULL;
  return (bits | bits << 2U) & 0x1249249249249249ULL;
}

/// The splats that are drawn, in the curve's order.
std::vector<Place> alongCurve(const Splat* splats, std::size_t count)
{
  Vector low;
  Vector high;
  low.fill(std::numeric_limits<double>::max());
  high.fill(std::numeric_limits<double>::lowest());
  std::vector<Place> places;
  places.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    if (!(splats[i].Radius > 0.0f))
    {
      continue;
    }
    places.push_back({ 0, static_cast<std::uint32_t>(i) });
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min(low[axis], static_cast<double>(splats[i].Position[axis]));
      high[axis] = std::max(high[axis], static_cast<double>(splats[i].Position[axis]));
    }
  }
  double size = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    size = std::max(size, high[axis] - low[axis]);
  }
  constexpr double cells = 2097151.0; // 2^21 - 1
  const double scale = size > 0.0 ? cells / size : 0.0;
  vtkSMPTools::For(0, static_cast<vtkIdType>(places.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const float* const position = splats[places[i].Index].Position;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const double cell = (position[axis] - low[axis]) * scale;
          places[i].Code |= spread(static_cast<std::uint64_t>(cell)) << axis;
        }
      }
    });
  vtkSMPTools::Sort(places.begin(), places.end());
  return places;
}

} // namespace

/// A run of splats, of which some cover the others.
class vtkIsopointSplatSubset::Run
{
public:
  Run(const Splat* splats, const float* axes, double limit)
    : Splats(splats)
    , Axes(axes)
    , Limit(limit)
  {
  }

  /// Calls choose(index, growth) for each chosen splat.
  template <class TFunction>
  void Choose(const Place* begin, const Place* end, const TFunction& choose)
  {
    this->Rest.clear();
    for (const Place* place = begin; place != end; ++place)
    {
      this->Rest.push_back(place->Index);
    }
    for (int i = 0; i < mostOfRun && !this->Rest.empty(); ++i)
    {
      const std::uint32_t middle = this->Middle();
      double growth = 1.0;
      const auto isCovered = [&](std::uint32_t index)
      {
        const double needed = index == middle ? 1.0 : this->GrowthFor(middle, index);
        const bool covers = needed <= this->Limit;
        growth = covers ? std::max(growth, needed) : growth;
        return covers;
      };
      this->Rest.erase(
        std::remove_if(this->Rest.begin(), this->Rest.end(), isCovered), this->Rest.end());
      choose(middle, growth);
    }
  }

private:
  /// The splat nearest to the mean of the rest.
  std::uint32_t Middle() const
  {
    Vector mean{};
    for (const std::uint32_t index : this->Rest)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        mean[axis] += this->Splats[index].Position[axis] / static_cast<double>(this->Rest.size());
      }
    }
    const auto distance = [&](std::uint32_t index)
    {
      const float* const position = this->Splats[index].Position;
      return std::hypot(position[0] - mean[0], position[1] - mean[1], position[2] - mean[2]);
    };
    return *std::min_element(this->Rest.begin(), this->Rest.end(),
      [&](std::uint32_t a, std::uint32_t b) { return distance(a) < distance(b); });
  }

  /// The growth with which a splat covers another one; infinite if that is of another sheet.
  double GrowthFor(std::uint32_t coverer, std::uint32_t covered) const
  {
    const Splat& a = this->Splats[coverer];
    const Splat& b = this->Splats[covered];
    const bool haveNormals = dot(a.Normal, a.Normal) > 0.0 && dot(b.Normal, b.Normal) > 0.0;
    if (haveNormals && dot(a.Normal, b.Normal) < leastCosine)
    {
      return std::numeric_limits<double>::infinity();
    }
    float offset[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      offset[axis] = b.Position[axis] - a.Position[axis];
    }
    const float* const ours = this->AxesOf(coverer);
    const float* const theirs = this->AxesOf(covered);
    if (!ours || !theirs)
    {
      return (std::sqrt(dot(offset, offset)) + b.Radius) / a.Radius;
    }
    const double length1 = dot(ours, ours);
    const double length2 = dot(ours + 3, ours + 3);
    const double ratio =
      std::max(dot(theirs, theirs) / length1, dot(theirs + 3, theirs + 3) / length2);
    return std::hypot(dot(offset, ours) / length1, dot(offset, ours + 3) / length2) +
           std::sqrt(ratio);
  }

  /// Null for a disk.
  const float* AxesOf(std::uint32_t index) const
  {
    const float* const axes =
      this->Axes ? this->Axes + 6 * static_cast<std::size_t>(index) : nullptr;
    return axes && dot(axes, axes) > 0.0 && dot(axes + 3, axes + 3) > 0.0 ? axes : nullptr;
  }

  const Splat* const Splats;
  const float* const Axes;
  const double Limit;
  std::vector<std::uint32_t> Rest;
};

//------------------------------------------------------------------------------
vtkIsopointSplatSubset::vtkIsopointSplatSubset(
  const Splat* splats, const float* axes, std::size_t count, int stride)
{
  const std::vector<Place> places = alongCurve(splats, count);
  const auto length = static_cast<std::size_t>(stride);
  this->Growth.assign(count, 1.0f);
  this->Indices.reserve(places.size() / length + 1);
  Run run(splats, axes, mostGrowth * std::sqrt(static_cast<double>(stride)) + 1.0);
  for (std::size_t begin = 0; begin < places.size(); begin += length)
  {
    const std::size_t end = std::min(begin + length, places.size());
    run.Choose(places.data() + begin, places.data() + end,
      [&](std::uint32_t index, double growth)
      {
        this->Indices.push_back(index);
        this->Growth[index] = static_cast<float>(growth);
      });
  }
}
