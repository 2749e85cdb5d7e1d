// SPDX-License-Identifier: GPL-3.0-or-later
#include "LocalFit.h"

#include "FitNeighborhood.h"

#include <optional>

namespace isopoint
{
namespace
{

// Residuals are roots of mean squares, in units of how much a fit rises over the samples' mean
// distance.

/// Where the polynomial of degree two leaves less than this, nothing else is tried.
constexpr double fineResidual = 0.002;

/// Where that of degree two or three leaves less than this, it is as near to the surface as noise
/// lets it.
constexpr double smoothResidual = 0.03;

/// Where it may leave this: samples too few to tell noise from detail determine no more than a
/// quadratic, and no crease was found.
constexpr double roughResidual = 0.1;

/// Whether detail that the samples resolve thinly leaves the residuals, not noise or creases.
bool tellsOfDetail(FitNeighborhood& wider, DetailTally& tally)
{
  const int degree = wider.bestDegree();
  tally.add(degree == 3);
  return degree == 3 || (degree == 2 && tally.isCommon());
}

/// Takes over the best fit that holds, if one does.
void fitBest(FitNeighborhood& neighborhood, const std::function<FitNeighborhood()>& gatherWider,
  FitOrder highest, DetailTally& tally, LocalFit& fit)
{
  std::optional<FitNeighborhood> known;
  const auto wider = [&]() -> FitNeighborhood&
  { return known ? *known : known.emplace(gatherWider()); };
  if (highest == FitOrder::Linear)
  {
    wider().apply(wider().best(highest), fit);
    return;
  }
  const CandidateFit quadratic = neighborhood.smooth(2);
  const auto applyQuadratic = [&](double most)
  { return quadratic.residual <= most && neighborhood.apply(quadratic, fit); };
  if (applyQuadratic(highest == FitOrder::Quadratic ? smoothResidual : fineResidual))
  {
    return;
  }
  const bool triesCubic = highest != FitOrder::Quadratic;
  std::optional<CandidateFit> knownCubic;
  const auto cubic = [&]() -> const CandidateFit&
  { return knownCubic ? *knownCubic : knownCubic.emplace(wider().smooth(3)); };
  if (triesCubic && quadratic.residual <= roughResidual && cubic().residual <= smoothResidual &&
      wider().apply(cubic(), fit))
  {
    return;
  }
  if (applyQuadratic(smoothResidual))
  {
    return;
  }
  const bool seeksCreases = highest == FitOrder::Crease && !neighborhood.tellsOfNoise();
  CandidateFit best = seeksCreases ? wider().best(highest) : CandidateFit();
  if (best.order == FitOrder::Crease)
  {
    wider().apply(best, fit);
    return;
  }
  const bool mayBeDetail = triesCubic && !neighborhood.mayCrossGap() && tally.isToBeAsked();
  if (mayBeDetail && tellsOfDetail(wider(), tally) && wider().apply(cubic(), fit))
  {
    return;
  }
  // A quadratic that the samples determine is judged by them alone, except beside creases.
  if (!seeksCreases)
  {
    if (highest == FitOrder::Crease || quadratic.isDetermined)
    {
      return;
    }
    best = wider().best(highest);
  }
  if (!(best.residual <= roughResidual) || applyQuadratic(roughResidual))
  {
    return;
  }
  const CandidateFit wide = wider().smooth(2);
  if (wide.residual <= roughResidual)
  {
    wider().apply(wide, fit);
  }
}

} // namespace

LocalFit fitAround(const FitEdge& edge, double isovalue, const std::vector<FitSample>& samples,
  const std::function<const std::vector<FitSample>&()>& widerSamples, FitOrder highest,
  DetailTally& tally)
{
  LocalFit fit{};
  fit.position = edge.position;
  const double length = lengthOf(edge.rising);
  fit.gradient = scaled(edge.rise / length, directionOf(edge.rising));
  if (highest == FitOrder::None)
  {
    return fit;
  }
  double spacing = 0.0;
  for (const FitSample& sample : samples)
  {
    spacing +=
      lengthOf(difference(sample.position, edge.position)) / static_cast<double>(samples.size());
  }
  FitNeighborhood neighborhood(edge, isovalue, samples, spacing);
  if (!neighborhood.isUsable())
  {
    return fit;
  }
  fitBest(
    neighborhood, [&]() { return FitNeighborhood(edge, isovalue, widerSamples(), spacing); },
    highest, tally, fit);
  if (fit.order == FitOrder::None)
  {
    if (const std::optional<Vector> gradient = neighborhood.affineGradient())
    {
      fit.gradient = *gradient;
      fit.isGradientFitted = true;
    }
  }
  return fit;
}

} // namespace isopoint
