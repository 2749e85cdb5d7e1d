// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef ThinningTesting_h
#define ThinningTesting_h

#include "Clouds.h"

#include "Core/Extraction/Thinning.h"
#include "Core/Neighbors/AngleCriterion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

/// Shared by the tests of thinning.
namespace thinningtesting
{

using isopoint::FitOrder;
using isopoint::FitRequest;
using isopoint::Isosurface;
using isopoint::LocalFit;
using isopoint::Vector;

inline Isosurface thinned(Isosurface surface, double minimumSpacing)
{
  isopoint::thin(isopoint::Execution(), minimumSpacing, surface);
  return surface;
}

inline Isosurface extracted(
  const clouds::Cloud& cloud, double isovalue, FitOrder order = FitOrder::Cubic, bool move = true)
{
  const isopoint::Execution execution;
  isopoint::IsosurfaceExtractor extractor;
  extractor.load<double, double>(execution, cloud.size(), clouds::readerOf(cloud));
  return clouds::extractFrom(
    extractor, execution, isovalue, isopoint::defaultAngle, 0.0, FitRequest{ order, move });
}

/// A surface with given fits, on edges of consecutive samples.
inline Isosurface surfaceOf(std::vector<LocalFit> fits)
{
  Isosurface surface;
  for (std::size_t i = 0; i < fits.size(); ++i)
  {
    surface.edges.push_back({ { i, i + 1 }, 0.5 });
    surface.positions.push_back(fits[i].position);
    surface.decreasingEdges.push_back({ 0.0, 0.0, 1.0 });
  }
  surface.fits = std::move(fits);
  return surface;
}

} // namespace thinningtesting

#endif
