// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Options.h"

#include "Core/Failure.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>

namespace isopoint
{

namespace
{

bool needsSplats(const Options& options)
{
  return options.computeNormals || options.computeSplats;
}

bool hasNormalsFromField(const Options& options)
{
  switch (static_cast<NormalMethod>(options.normalMethod))
  {
    case NormalMethod::Automatic:
      return options.projection != 0 || options.computeGradients;
    case NormalMethod::Field:
      return true;
    default:
      return false;
  }
}

/// The fit that the projection or an output needs, if any. Normals from the field and gradients
/// need a polynomial. Splats and fit orders need only the sample spacing.
std::optional<FitRequest> fitRequestOf(const Options& options)
{
  if (options.projection != 0)
  {
    return FitRequest{ static_cast<FitOrder>(options.projection), true };
  }
  if (options.computeGradients || (needsSplats(options) && hasNormalsFromField(options)))
  {
    return FitRequest{ FitOrder::Cubic, false };
  }
  if (needsSplats(options) || options.computeProjectionOrders)
  {
    return FitRequest{ std::nullopt, false };
  }
  return std::nullopt;
}

} // namespace

void checkOptions(const Options& options, OptionNaming naming)
{
  forAllOptions(
    [&](const auto& option)
    {
      const auto value = options.*option.value;
      if (!(value >= option.least && value <= option.greatest))
      {
        std::ostringstream message;
        message << naming(option.name) << " is " << value
                << ", which is out of range. Set it to a value from " << option.least << " to "
                << option.greatest << ".";
        throw UsageError(message.str(), UsageError::Option);
      }
    });
  const auto refuse = [&](const std::string& lacking, const auto& option, const char* remedy)
  {
    throw UsageError(naming(option::capping.name) + " has no " + lacking + ". Set " +
                       naming(option.name) + " " + remedy + ".",
      UsageError::Option);
  };
  if (!options.triangles || !options.capping)
  {
    return;
  }
  if (options.projection == static_cast<int>(FitOrder::Crease))
  {
    refuse("creases", option::projection, "to the cubic fit, or to a simpler one");
  }
  if (options.computeGradients)
  {
    refuse("gradients", option::computeGradients, "off, and compute gradients at the samples");
  }
  if (options.normalMethod == static_cast<int>(NormalMethod::Field))
  {
    refuse("normals from the field", option::normalMethod, "to planes, or to automatic");
  }
}

std::vector<double> sortedIsovalues(const std::vector<double>& isovalues)
{
  if (std::any_of(
        isovalues.begin(), isovalues.end(), [](double value) { return std::isnan(value); }))
  {
    throw UsageError("An isovalue is not a number. Choose numbers as isovalues.");
  }
  const std::set<double> sorted(isovalues.begin(), isovalues.end());
  return { sorted.begin(), sorted.end() };
}

Options effectiveOptions(const Options& options)
{
  Options effective;
  effective.triangles = options.triangles;
  effective.keepTetrahedra = options.keepTetrahedra;
  effective.computeSplats = !options.triangles;
  forEffectiveOptions(
    options, [&](const auto& option) { effective.*option.value = options.*option.value; });
  return effective;
}

ExtractionRequest requestOf(const Options& options)
{
  ExtractionRequest request;
  request.isosurface.angle = options.angle;
  request.isosurface.dropsGaps = options.dropGaps;
  request.isosurface.fit = fitRequestOf(options);
  request.isosurface.duplicatesCreaseVertices = options.computeNormals;
  request.isosurface.regularizes = options.regularize;
  request.isosurface.keepsHullSlivers = options.keepHullSlivers;
  request.isosurface.caps = options.capping;
  request.isosurface.minimumPieceSize = options.minimumPieceSize;
  request.triangles = options.triangles;
  if (needsSplats(options))
  {
    request.splats = SplatOptions{ options.numberOfNeighbors, hasNormalsFromField(options),
      options.computeSplats };
  }
  return request;
}

} // namespace isopoint
