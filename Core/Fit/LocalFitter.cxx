// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Fit/LocalFitter.h"

#include "Core/Fit/CreaseFit.h"
#include "Core/Fit/Polynomial.h"
#include "Core/Fit/Selection.h"

#include <cmath>
#include <cstddef>

namespace isopoint
{
namespace
{

/// A field is smooth up to this residual, over the mean rise within the mean sample distance.
constexpr double smoothResidual = 0.0002;

/// Steep weights: a fit nearly interpolates the nearest samples.
void weighSteeply(const FitFrame& frame, FrameWeights& weights)
{
  weigh<3>(frame.samples(), 0.1, weights);
}

/// Mild weights: far samples count as well, as needed in noise.
void weighMildly(const FitFrame& frame, FrameWeights& weights)
{
  weigh<1>(frame.samples(), 1.0, weights);
}

} // namespace

LocalFit LocalFitter::onEdge(const FitEdge& edge)
{
  LocalFit fit{};
  fit.position = edge.position;
  fit.spacing = edge.spacing;
  const double length = lengthOf(edge.increasing);
  fit.gradient = edge.increase / length / length * edge.increasing;
  return fit;
}

std::optional<LocalFit> LocalFitter::fitNear(
  const FitEdge& edge, const std::vector<FitSample>& samples)
{
  this->Frame.enter(edge, this->Isovalue);
  if (!this->Frame.isUsable())
  {
    return std::nullopt;
  }
  this->Frame.add(samples.data(), samples.data() + samples.size());
  if (this->Highest == FitOrder::Linear)
  {
    return std::nullopt;
  }
  weighSteeply(this->Frame, this->Steep);
  const std::optional<PolynomialFit> found =
    fitPolynomial(this->Frame.samples(), this->Steep, this->Frame.increasing(), 2);
  if (!found)
  {
    return std::nullopt;
  }
  LocalFit fit = onEdge(edge);
  if (this->isSmooth(*found))
  {
    if (!found->zero)
    {
      return std::nullopt;
    }
    this->moveTo(*found, fit);
    return fit;
  }
  constexpr double maxDirectionError = 1.0;
  if (!(found->directionError > maxDirectionError))
  {
    return std::nullopt;
  }
  this->preferMildGradient(std::nullopt, fit);
  return fit;
}

LocalFit LocalFitter::fit(
  const FitEdge& edge, const std::vector<FitSample>& samples, std::size_t nearCount)
{
  LocalFit fit = onEdge(edge);
  if (!this->Frame.isUsable())
  {
    return fit;
  }
  const FitSample* const begin = samples.data();
  const FitSample* const farther = begin + nearCount;
  const FitSample* const end = begin + samples.size();
  this->Frame.add(farther, end);
  if (this->Highest == FitOrder::Linear)
  {
    this->fitLinear(fit);
    return fit;
  }
  weighSteeply(this->Frame, this->Steep);
  this->weighRobustly();
  std::optional<PolynomialFit> found = this->fitHolding(this->Weights);
  if (!found)
  {
    found = this->fitHolding(this->Steep);
  }
  if (this->Highest == FitOrder::Crease && !(found && this->isSmooth(*found)))
  {
    if (this->fitCreases(fit))
    {
      return fit;
    }
    // Try the near samples alone: close to a corner, a piece with few samples is lost among many.
    this->Frame.enter(edge, this->Isovalue);
    this->Frame.add(begin, farther);
    if (this->fitCreases(fit))
    {
      return fit;
    }
    this->Frame.add(farther, end);
  }
  if (found)
  {
    this->moveTo(*found, fit);
  }
  this->preferMildGradient(found, fit);
  return fit;
}

bool LocalFitter::isSmooth(const PolynomialFit& found) const
{
  return found.relativeResidual <= smoothResidual * this->Frame.samples().meanDistance();
}

/// The polynomial of the highest degree, at least two, that holds.
std::optional<PolynomialFit> LocalFitter::fitHolding(const FrameWeights& weights) const
{
  for (int degree = this->Highest == FitOrder::Quadratic ? 2 : 3; degree > 1; --degree)
  {
    const std::optional<PolynomialFit> found =
      fitPolynomial(this->Frame.samples(), weights, this->Frame.increasing(), degree);
    if (found && found->zero)
    {
      return found;
    }
  }
  return std::nullopt;
}

/// Reduces the steep weights of samples far off an affine fit, iteratively: near a crease or step,
/// the samples of one side remain.
void LocalFitter::weighRobustly()
{
  const FrameSamples& samples = this->Frame.samples();
  copyWeights(samples, this->Steep, this->Weights);
  constexpr int rounds = 2;
  for (int round = 0; round < rounds; ++round)
  {
    const std::optional<Polynomial> affine = leastSquares(samples, this->Weights, 1);
    if (!affine)
    {
      return;
    }
    SampleNumbers residuals;
    const std::size_t groups = samples.groupCount();
    for (std::size_t i = 0; i < groups; ++i)
    {
      residuals.setGroup(i, samples.value.group(i) - affine->valueAt(samples.x.group(i),
                                                       samples.y.group(i), samples.z.group(i)));
    }
    std::vector<double>& all = this->Residuals;
    all.resize(samples.count());
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      all[i] = std::abs(residuals[i]);
    }
    const double middle = selectNth(all.data(), all.size(), all.size() / 2);
    if (!(middle > 0.0))
    {
      return;
    }
    const double scale = 1.0 / middle;
    for (std::size_t i = 0; i < groups; ++i)
    {
      const Lanes relative = scale * residuals.group(i);
      const Lanes factor = 1.0 + relative * relative;
      this->Weights.setGroup(i, this->Steep.group(i) / (factor * factor));
    }
  }
}

/// The polynomial with the current weights, if its gradient agrees with the edge.
std::optional<Polynomial> LocalFitter::mildPolynomial(int degree) const
{
  const std::optional<Polynomial> mild = leastSquares(this->Frame.samples(), this->Weights, degree);
  return mild && increasesAlong(this->Frame.increasing(), mild->gradientAt({})) ? mild
                                                                                : std::nullopt;
}

/// Sets the fit to the affine function with mild weights. @returns whether it holds
bool LocalFitter::fitLinear(LocalFit& fit)
{
  weighMildly(this->Frame, this->Weights);
  const std::optional<Polynomial> affine = this->mildPolynomial(1);
  if (!affine)
  {
    return false;
  }
  fit.gradient = this->Frame.gradientOf(affine->gradientAt({}));
  fit.isGradientFitted = true;
  const std::optional<Vector> zero = zeroNear(*affine, 0.5 * lengthOf(this->Frame.increasing()));
  if (!zero)
  {
    return false;
  }
  fit.position = this->Frame.positionAt(*zero);
  fit.order = FitOrder::Linear;
  return true;
}

/// Sets the fit to pieces that meet at creases. @returns whether they describe the samples well,
/// and far better than a polynomial
bool LocalFitter::fitCreases(LocalFit& fit)
{
  constexpr double maxResidual = 0.03; // larger ones come from noise
  // Pieces adapt to the samples: even in noise their residuals are somewhat lower.
  constexpr double maxResidualShare = 0.5;
  const FrameSamples& samples = this->Frame.samples();
  weighMildly(this->Frame, this->Weights);
  const std::optional<CreaseFit> crease = fitCrease(samples, this->Weights);
  if (!crease || !crease->isSharp() ||
      !(crease->residual <=
        maxResidual * crease->minSlope() * this->Frame.samples().meanDistance()) ||
      !(crease->residual < maxResidualShare * polynomialResidual(samples, this->Weights)))
  {
    return false;
  }
  const std::optional<CreasePoint> point =
    zeroNear(*crease, 0.5 * lengthOf(this->Frame.increasing()));
  if (!point)
  {
    return false;
  }
  fit.position = this->Frame.positionAt(point->zero);
  fit.gradient = this->Frame.gradientOf(point->gradient);
  fit.hessian = this->Frame.hessianOf(point->hessian);
  fit.isSmooth = true;
  fit.creases = this->Frame.planesOf(point->creases);
  fit.isGradientFitted = true;
  fit.order = FitOrder::Crease;
  return true;
}

/// Moves the isopoint to the polynomial's zero, or less far if the zero's error is comparable.
void LocalFitter::moveTo(const PolynomialFit& found, LocalFit& fit) const
{
  constexpr double doubt = 0.1;
  const double squaredMove = dot(*found.zero, *found.zero);
  const double share = squaredMove > 0.0
                         ? squaredMove / (squaredMove + doubt * found.zeroError * found.zeroError)
                         : 1.0;
  fit.position = this->Frame.positionAt(share * *found.zero);
  fit.order = static_cast<FitOrder>(found.polynomial.degree);
  fit.gradient = this->Frame.gradientOf(found.polynomial.gradientAt(*found.zero));
  fit.isGradientFitted = true;
  fit.hessian = this->Frame.hessianOf(found.polynomial.hessianAt(*found.zero));
  fit.isSmooth = true;
}

/// Replaces the gradient by a more certain one: that of the mild polynomial of the lowest degree
/// that does not differ significantly, or the affine one if nothing was found.
void LocalFitter::preferMildGradient(const std::optional<PolynomialFit>& found, LocalFit& fit)
{
  constexpr double maxErrors = 2.0; // standard errors between directions that may be equal
  const Vector direction = directionOf(fit.gradient);
  weighMildly(this->Frame, this->Weights);
  for (int degree = 1; degree <= (found ? 2 : 1); ++degree)
  {
    const std::optional<Polynomial> mild = this->mildPolynomial(degree);
    const Vector gradient = mild ? mild->gradientAt({}) : Vector{};
    if (mild &&
        (!found || lengthOf(directionOf(gradient) - direction) < maxErrors * found->directionError))
    {
      fit.gradient = this->Frame.gradientOf(gradient);
      fit.isGradientFitted = true;
      fit.hessian = this->Frame.hessianOf(mild->hessianAt({}));
      fit.isSmooth = degree > 1;
      return;
    }
  }
}

} // namespace isopoint
