// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Fit/LocalFit.h"

#include "Isopoint/Fit/FitNeighborhood.h"

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

/// The fits around an isopoint, tried in turn.
class FitAttempts
{
public:
  /// @param fit that is taken over into
  FitAttempts(FitNeighborhood& neighborhood, const std::function<FitNeighborhood()>& gatherWider,
    FitOrder highest, DetectionRates& tallies, LocalFit& fit)
    : Neighborhood(neighborhood)
    , GatherWider(gatherWider)
    , Highest(highest)
    , Tallies(tallies)
    , Fit(fit)
  {
  }

  /// Takes over the best fit that holds, if one does.
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
    // A quadratic that the samples determine is judged by them alone.
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
        !this->Tallies.creases.isWorthTesting())
    {
      return false;
    }
    // Close to a corner, a few samples of a third piece do not determine it.
    const bool isFound =
      this->takeCreaseThrough(this->wider()) || this->takeCreaseThrough(this->Neighborhood);
    this->Tallies.creases.add(isFound);
    return isFound;
  }

  bool takeCreaseThrough(FitNeighborhood& samples)
  {
    const CandidateFit best = samples.best(FitOrder::Crease);
    return best.order == FitOrder::Crease && samples.apply(best, this->Fit);
  }

  /// A cubic that leaves residuals, where detail that the samples resolve thinly is what leaves
  /// them, not noise or creases.
  bool takeDetail()
  {
    if (this->Highest < FitOrder::Cubic || this->Neighborhood.mayCrossGap() ||
        !this->Tallies.detail.isWorthTesting())
    {
      return false;
    }
    const int degree = this->wider().bestDegree();
    this->Tallies.detail.add(degree == 3);
    const bool isDetail = degree == 3 || (degree == 2 && this->Tallies.detail.isCommon());
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
  DetectionRates& Tallies;
  LocalFit& Fit;
  CandidateFit Quadratic;
  std::optional<FitNeighborhood> Wider;
  std::optional<CandidateFit> Cubic;
};

} // namespace

LocalFit fitAround(const FitEdge& edge, double isovalue, const std::vector<FitSample>& samples,
  const std::function<const std::vector<FitSample>&()>& widerSamples, FitOrder highest,
  DetectionRates& tallies)
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
  const std::function<FitNeighborhood()> gatherWider = [&]()
  { return FitNeighborhood(edge, isovalue, widerSamples(), spacing); };
  FitAttempts(neighborhood, gatherWider, highest, tallies, fit).run();
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
