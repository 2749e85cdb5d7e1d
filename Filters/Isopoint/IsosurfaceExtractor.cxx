// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/IsosurfaceExtractor.h"

#include "Isopoint/Extraction/ExpectedWork.h"
#include "Isopoint/Extraction/ExtractIsosurface.h"
#include "Isopoint/Extraction/IsopointNeighbors.h"
#include "Isopoint/Extraction/Thinning.h"
#include "Isopoint/Neighbors/SampleExtent.h"
#include "Isopoint/Ranks/ExtractOnRanks.h"
#include "Isopoint/Ranks/NodeExchange.h"
#include "Isopoint/Ranks/RankSplats.h"
#include "Isopoint/Ranks/RankSurface.h"
#include "Isopoint/Splat/SplatGeometry.h"
#include "Isopoint/Triangles/ExtractTriangles.h"
#include "Isopoint/Triangles/TriangleGeometry.h"

namespace isopoint
{

void IsosurfaceExtractor::clear()
{
  this->Held = Cloud<FloatSample>();
  this->Ranks.reset();
  this->ItemCount = 0;
}

std::size_t IsosurfaceExtractor::sampleCount() const
{
  return std::visit(
    [](const auto& cloud)
    {
      return cloud.tree.isPartial ? cloud.tree.ownEnd - cloud.tree.ownBegin
                                  : cloud.tree.samples.size();
    },
    this->Held);
}

std::size_t IsosurfaceExtractor::skippedCount() const
{
  return std::visit([](const auto& cloud) { return cloud.tree.skipped; }, this->Held);
}

void IsosurfaceExtractor::setValueError(double error)
{
  std::visit([error](auto& cloud) { cloud.tree.valueError = error; }, this->Held);
}

double IsosurfaceExtractor::loadingWork(std::size_t count)
{
  return work::loading * static_cast<double>(count);
}

double IsosurfaceExtractor::extractionWork(
  std::size_t count, const ExtractionRequest& request, bool isTreeKept)
{
  if (count == 0)
  {
    return 0.0;
  }
  BandForecast forecast(count);
  forecast.observe(0, 1, isTreeKept ? 0.0 : 1.0);
  const double forIsopoint =
    (request.triangles ? work::tetrahedrising : work::finding) + work::placing + work::writing +
    (request.isosurface.fit ? work::fitting : 0.0) + (request.splats ? work::splatting : 0.0);
  return forecast.bandWork(0) + forIsopoint * forecast.isopointCount();
}

ExtractedIsosurface IsosurfaceExtractor::extract(
  const Execution& execution, const ExtractionRequest& request)
{
  return std::visit(
    [&](auto& cloud)
    {
      if (this->Ranks)
      {
        return this->extractOnRanks(execution, cloud, request);
      }
      if (request.triangles)
      {
        return extractTriangles(execution, cloud, request);
      }
      WorkProgress progress(execution);
      const double splatting = request.splats ? work::splatting : 0.0;
      ExtractedIsosurface result;
      result.surface = extractIsosurface(execution, cloud.tree, cloud.neighborhoods,
        this->ItemCount, request.isosurface, progress, splatting + work::writing);
      thin(execution, request.minimumSpacing, result.surface);
      throwIfAborted(execution);
      if (request.splats)
      {
        const Isosurface& surface = result.surface;
        const auto count = static_cast<double>(surface.size());
        const Execution part = progress.part(count * splatting, count * work::writing);
        const IsopointNeighbors neighbors(part, cloud.tree, cloud.neighborhoods, surface.leaves);
        const SampleExtents extents(cloud.tree);
        result.splats =
          computeSplats(part, { surface.positions, surface.decreasingEdges, surface.fits },
            neighbors, &extents, *request.splats);
      }
      result.surface.leaves = {};
      return result;
    },
    this->Held);
}

template <class TSample>
ExtractedIsosurface IsosurfaceExtractor::extractTriangles(
  const Execution& execution, Cloud<TSample>& cloud, const ExtractionRequest& request)
{
  WorkProgress progress(execution);
  TriangleExtraction<TSample> extraction(
    execution, cloud.tree, cloud.neighborhoods, request.isosurface);
  TriangleSurface found = extraction.extract(progress, work::writing);
  throwIfAborted(execution);
  ExtractedIsosurface result;
  result.surface = std::move(found.vertices);
  result.triangles = std::move(found.triangles);
  if (request.splats)
  {
    const Isosurface& surface = result.surface;
    result.splats = vertexNormals({ surface.positions, surface.decreasingEdges, surface.fits },
      result.triangles, request.splats->fieldNormals);
  }
  result.surface.leaves = {};
  return result;
}

template <class TSample>
ExtractedIsosurface IsosurfaceExtractor::extractOnRanks(
  const Execution& execution, Cloud<TSample>& cloud, const ExtractionRequest& request)
{
  WorkProgress progress(execution);
  NodeExchange<TSample> exchange(*this->Ranks, cloud.tree, cloud.begins);
  RankSurface<TSample> ofRank(
    execution, cloud.tree, exchange, cloud.neighborhoods, this->ItemCount);
  const double splatting = request.splats ? work::splatting : 0.0;
  Isosurface surface = ofRank.extract(request.isosurface, progress, splatting + work::writing);
  const bool hasFits = request.isosurface.fit.has_value();
  if (request.minimumSpacing > 0.0 && hasFits)
  {
    keepOnRanks(execution, *this->Ranks, request.minimumSpacing, surface);
  }
  ExtractedIsosurface result;
  std::vector<std::size_t> home;
  std::vector<bool> isHome;
  exchange.together(
    [&]()
    {
      isHome.resize(surface.size(), false);
      for (std::size_t i = 0; i < surface.size(); ++i)
      {
        if (ofRank.isHome(surface.leaves[i]))
        {
          home.push_back(i);
        }
      }
      for (const std::size_t i : home)
      {
        isHome[i] = true;
      }
    });
  if (request.splats && !cloud.tree.isEmpty())
  {
    const auto count = static_cast<double>(surface.size());
    const Execution part = progress.part(count * splatting, count * work::writing);
    std::vector<Splat> splats =
      RankSplats<TSample>(part, exchange, cloud.neighborhoods, *request.splats)
        .compute(surface, isHome, hasFits);
    exchange.together(
      [&]()
      {
        for (const std::size_t i : home)
        {
          result.splats.push_back(splats[i]);
        }
      });
  }
  exchange.together(
    [&]()
    {
      result.surface = chosenIsopoints(surface, home);
      result.surface.coincident = coincidentEnds(cloud.tree, result.surface.leaves);
      result.surface.leaves = {};
    });
  return result;
}

} // namespace isopoint
