// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Fit/LocalFit.h"

#include "Isopoint/Fit/FitNeighborhood.h"

#include <optional>

namespace isopoint
{
namespace
{

// Residuals are roots of mean squares, in units of the fit's increase over the samples' mean
// distance.

/// If the polynomial of degree two leaves less than this, nothing else is tried.
constexpr double fineResidual = 0.002;

/// If that of degree two or three leaves less than this, it is as close to the surface as noise
/// permits.
constexpr double smoothResidual = 0.03;

/// The largest residual where the samples determine no more than a quadratic, too few to
/// distinguish noise from detail, and no crease was found.
constexpr double roughResidual = 0.1;

/// The fits around an isopoint, tried in turn.
class FitAttempts
{
public:
  /// @param fit receives the fit that holds
  FitAttempts(FitNeighborhood& neighborhood, const std::function<FitNeighborhood()>& gatherWider,
    FitOrder highest, DetectionRates& rates, LocalFit& fit)
    : Neighborhood(neighborhood)
    , GatherWider(gatherWider)
    , Highest(highest)
    , Rates(rates)
    , Fit(fit)
  {
  }

  /// Applies the best fit that holds, if one does.
  void run()
  {
    if (this->Highest == FitOrder::Linear)
    {
      this->wider().apply(this->wider().best(this->Highest), this->Fit);
      return;
    }
    this->Quadratic = this->Neighborhood.smooth(2);
    const bool isDone = this->takeQuadratic(fineResidual) || this->takeCrease() ||
                        this->takeCubic(smoothResidual) || this->takeQuadratic(smoothResidual) ||
                        this->takeDetail();
    // A quadratic that the samples determine was judged above.
    if (!isDone && !this->Quadratic.isDetermined)
    {
      this->takeRough();
    }
  }

private:
  bool takeQuadratic(double mostResidual)
  {
    return this->Quadratic.residual <= mostResidual &&
           this->Neighborhood.apply(this->Quadratic, this->Fit);
  }

  bool takeCubic(double mostResidual)
  {
    return this->Highest >= FitOrder::Cubic && this->Quadratic.residual <= roughResidual &&
           this->cubic().residual <= mostResidual && this->wider().apply(this->cubic(), this->Fit);
  }

  bool takeCrease()
  {
    if (this->Highest != FitOrder::Crease)
    {
      return false;
    }
    // A steeply weighted fit leaves small residuals beside a crease, too.
    if (this->takeCubic(fineResidual))
    {
      return true;
    }
    if (this->Neighborhood.indicatesNoise() || !this->wider().leavesPattern() ||
        !this->Rates.creases.isWorthTesting())
    {
      return false;
    }
    // Close to a corner, a few samples of a third piece do not determine it.
    const bool isFound =
      this->takeCreaseThrough(this->wider()) || this->takeCreaseThrough(this->Neighborhood);
    this->Rates.creases.add(isFound);
    return isFound;
  }

  bool takeCreaseThrough(FitNeighborhood& samples)
  {
    const CandidateFit best = samples.best(FitOrder::Crease);
    return best.order == FitOrder::Crease && samples.apply(best, this->Fit);
  }

  /// A cubic that leaves residuals because of detail that the samples hardly resolve, not because
  /// of noise or creases.
  bool takeDetail()
  {
    if (this->Highest < FitOrder::Cubic || this->Neighborhood.mayCrossGap() ||
        !this->Rates.detail.isWorthTesting())
    {
      return false;
    }
    const std::optional<int> degree = this->wider().bestDegree();
    this->Rates.detail.add(degree == 3);
    const bool isDetail = degree == 3 || (degree == 2 && this->Rates.detail.isCommon());
    return isDetail && this->wider().apply(this->cubic(), this->Fit);
  }

  void takeRough()
  {
    if (this->wider().best(FitOrder::Quadratic).residual <= roughResidual)
    {
      const CandidateFit quadratic = this->wider().smooth(2);
      if (quadratic.residual <= roughResidual)
      {
        this->wider().apply(quadratic, this->Fit);
      }
    }
  }

  FitNeighborhood& wider()
  {
    return this->Wider ? *this->Wider : this->Wider.emplace(this->GatherWider());
  }

  const CandidateFit& cubic()
  {
    return this->Cubic ? *this->Cubic : this->Cubic.emplace(this->wider().smooth(3));
  }

  FitNeighborhood& Neighborhood;
  const std::function<FitNeighborhood()>& GatherWider;
  FitOrder Highest;
  DetectionRates& Rates;
  LocalFit& Fit;
  CandidateFit Quadratic;
  std::optional<FitNeighborhood> Wider;
  std::optional<CandidateFit> Cubic;
};

} // namespace

LocalFit fitAround(const FitEdge& edge, double isovalue, const std::vector<FitSample>& samples,
  const std::function<const std::vector<FitSample>&()>& widerSamples,
  std::optional<FitOrder> highest, DetectionRates& rates)
{
  LocalFit fit{};
  fit.position = edge.position;
  const double length = lengthOf(edge.increasing);
  fit.gradient = scaled(edge.increase / length, directionOf(edge.increasing));
  if (!highest)
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
  const std::function<FitNeighborhood()> gatherWider = [&]()
  { return FitNeighborhood(edge, isovalue, widerSamples(), spacing); };
  FitAttempts(neighborhood, gatherWider, *highest, rates, fit).run();
  if (!fit.order)
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
