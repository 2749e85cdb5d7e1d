// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/ExtractionRequest.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

namespace isopoint
{

/// The number of isopoints of all surfaces.
std::size_t countIsopoints(const std::vector<ExtractedIsosurface>& surfaces);

/// The number of triangles of all surfaces.
std::size_t countTriangles(const std::vector<ExtractedIsosurface>& surfaces);

/// Destinations of the computed arrays of isopoints; null pointers skip an array.
struct OutputArrays
{
  float* normals = nullptr; // three per isopoint
  float* radii = nullptr;
  float* splatAxes = nullptr;     // three
  float* splatPolygons = nullptr; // numbersOfSplat
  float* gradients = nullptr;     // three
  std::uint8_t* projectionOrders = nullptr;
};

/// Writes the arrays of a surface.
/// @param isProjected whether fits moved isopoints; otherwise their orders are 0
/// @param first the first tuple to write
void writeArrays(const Execution& execution, const ExtractedIsosurface& extracted, bool isProjected,
  std::size_t first, const OutputArrays& arrays);

/// Writes positions, three coordinates each.
template <class T>
void writePositions(const Execution& execution, const Isosurface& surface, T* coordinates)
{
  forEachIndex(execution, surface.size(),
    [&](std::size_t i)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        coordinates[3 * i + axis] = static_cast<T>(surface.positions[i][axis]);
      }
    });
}

/// Writes triangles, three indices of isopoints each.
/// @param firstPoint the number of isopoints before this surface
template <class T>
void writeTriangles(const Execution& execution, const ExtractedIsosurface& extracted,
  std::size_t firstPoint, T* corners)
{
  forEachIndex(execution, extracted.triangles.size(),
    [&](std::size_t i)
    {
      for (std::size_t corner = 0; corner < 3; ++corner)
      {
        corners[3 * i + corner] =
          static_cast<T>(firstPoint) + static_cast<T>(extracted.triangles[i][corner]);
      }
    });
}

/// Converts a number to an array's type. For integers, it is rounded to nearest and clamped: a
/// 64-bit integer can exceed its range when it is rounded to double.
template <class T>
T toArrayType(double value)
{
  if constexpr (std::is_floating_point<T>::value)
  {
    return static_cast<T>(value);
  }
  else
  {
    const double rounded = std::round(value);
    if (rounded >= static_cast<double>(std::numeric_limits<T>::max()))
    {
      return std::numeric_limits<T>::max();
    }
    if (rounded <= static_cast<double>(std::numeric_limits<T>::lowest()))
    {
      return std::numeric_limits<T>::lowest();
    }
    return static_cast<T>(rounded);
  }
}

/// Calls copy(isopoint, sample) for the vertices of caps at single samples: their attributes are
/// those of the sample, to the last digit.
template <class Copy>
void forEachAtSample(const Execution& execution, const Isosurface& surface, const Copy& copy)
{
  forEachIndex(execution, surface.size(),
    [&](std::size_t i)
    {
      const IsopointEdge& edge = surface.edgeOf(i);
      if (edge.isSample() && !surface.coincidentAt(edge.first))
      {
        copy(i, edge.first);
      }
    });
}

/// Interpolates an attribute of the samples at all isopoints of a surface.
/// @param componentOf(sample, component) as a double
/// @param write(isopoint, component, value) called from any thread
template <class ComponentOf, class Write>
void interpolateComponents(const Execution& execution, const Isosurface& surface,
  int componentCount, const ComponentOf& componentOf, const Write& write)
{
  for (int component = 0; component < componentCount; ++component)
  {
    const CoincidentAttribute attribute(
      surface, [&, component](std::uint64_t sample) { return componentOf(sample, component); });
    forEachIndex(execution, surface.size(),
      [&](std::size_t i)
      {
        const std::size_t begin = surface.edgeBegin(i);
        const std::size_t count = surface.edgeBegin(i + 1) - begin;
        const auto valueAt = [&](const IsopointEdge& edge)
        {
          return edge.isSample() // infinite values have no differences
                   ? attribute(edge.first)
                   : interpolate(attribute(edge.first), attribute(edge.second), edge.parameter);
        };
        const double value = count == 1 ? valueAt(surface.edges[begin])
                                        : meanOf(count, [&](std::size_t k)
                                            { return valueAt(surface.edges[begin + k]); });
        write(i, component, value);
      });
  }
}

} // namespace isopoint
