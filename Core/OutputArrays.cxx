// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/OutputArrays.h"

#include <algorithm>
#include <numeric>

namespace isopoint
{

namespace
{

/// Writes a vector as a tuple, unless the array is null.
void write(const Vector& vector, std::size_t tuple, float* array)
{
  if (array)
  {
    std::transform(vector.begin(), vector.end(), array + 3 * tuple,
      [](double coordinate) { return static_cast<float>(coordinate); });
  }
}

void writeSplat(const Splat& splat, std::size_t tuple, const OutputArrays& arrays)
{
  write(splat.normal, tuple, arrays.normals);
  write(splat.axis, tuple, arrays.splatAxes);
  if (arrays.radii)
  {
    arrays.radii[tuple] = radiusNumber(splat.radius);
  }
  if (arrays.splatPolygons)
  {
    const SplatNumbers numbers = numbersOf(splat.corners);
    std::transform(numbers.begin(), numbers.end(), arrays.splatPolygons + numbersOfSplat * tuple,
      [](double number) { return static_cast<float>(number); });
  }
}

} // namespace

std::size_t countIsopoints(const std::vector<ExtractedIsosurface>& surfaces)
{
  return std::accumulate(surfaces.begin(), surfaces.end(), std::size_t{ 0 },
    [](std::size_t sum, const ExtractedIsosurface& each) { return sum + each.surface.size(); });
}

std::size_t countTriangles(const std::vector<ExtractedIsosurface>& surfaces)
{
  return std::accumulate(surfaces.begin(), surfaces.end(), std::size_t{ 0 },
    [](std::size_t sum, const ExtractedIsosurface& each) { return sum + each.triangles.size(); });
}

void writeArrays(const Execution& execution, const ExtractedIsosurface& extracted, bool isProjected,
  std::size_t first, const OutputArrays& arrays)
{
  const std::vector<LocalFit>& fits = extracted.surface.fits;
  forEachIndex(execution, extracted.surface.size(),
    [&](std::size_t i)
    {
      const std::size_t tuple = first + i;
      if (!extracted.splats.empty())
      {
        writeSplat(extracted.splats[i], tuple, arrays);
      }
      if (!extracted.normals.empty())
      {
        write(extracted.normals[i], tuple, arrays.normals);
      }
      if (!fits.empty())
      {
        write(fits[i].gradient, tuple, arrays.gradients);
        if (arrays.projectionOrders)
        {
          arrays.projectionOrders[tuple] =
            isProjected && fits[i].order ? static_cast<std::uint8_t>(*fits[i].order) : 0;
        }
      }
    });
}

} // namespace isopoint
