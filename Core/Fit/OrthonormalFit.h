// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Fit/FrameSamples.h"
#include "Core/Fit/Lanes.h"
#include "Core/Fit/NormalEquations.h"
#include "Core/Fit/PrincipalAxes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace isopoint
{

/// Weighted least squares around a place for any number of arrays: polynomials that are orthonormal
/// over the samples, so that a fit is a few sums of products. Samples near a plane or a line are
/// turned to their principal axes; what they hardly determine fades out.
template <int Degree>
class OrthonormalFit
{
public:
  static constexpr std::size_t most = 64; // samples

  /// The fit to one array.
  struct Result
  {
    Lanes atPlace;  // value and gradient
    double mean;    // weighted mean of the values
    double squares; // weighted sum of the squares of residuals, each sample left out of the fit
  };

  /// O(samples) @param hasGradient whether errors of the gradient are needed
  void prepare(const FrameSamples& samples, const FrameWeights& weights, bool hasGradient)
  {
    this->makeBasis(samples, weights);
    Lanes total = Lanes::Zero();
    Lanes ofValue = Lanes::Zero();
    Lanes ofGradient = Lanes::Zero();
    this->HasLoose = false;
    for (std::size_t g = 0; g < this->Groups; ++g)
    {
      Lanes leverage = Lanes::Zero();
      for (std::size_t j = 0; j < size; ++j)
      {
        leverage += this->Basis[j][g].square();
      }
      const Lanes rest = 1.0 - this->Weights[g] * leverage;
      this->Rests[g] = rest.max(leastRest);
      this->Loose[g] = (leastRest - rest).max(0.0);
      this->HasLoose = this->HasLoose || (this->Loose[g] > 0.0).any();
      total += this->Weights[g];
      ofValue += this->effect(g, 0).square();
      if (hasGradient)
      {
        ofGradient +=
          this->effect(g, 1).square() + this->effect(g, 2).square() + this->effect(g, 3).square();
      }
    }
    this->PerWeight = 1.0 / sumOf(total);
    this->ValueEffect = std::sqrt(sumOf(ofValue));
    this->GradientEffect = sumOf(ofGradient);
  }

  /// Only the weights of samples in the value (0) and the gradient (1 to 3). O(samples)
  void findEffects(const FrameSamples& samples, const FrameWeights& weights,
    std::array<SampleNumbers, laneCount>& effects)
  {
    this->makeBasis(samples, weights);
    for (std::size_t g = 0; g < this->Groups; ++g)
    {
      for (std::size_t k = 0; k < laneCount; ++k)
      {
        effects[k].setGroup(g, this->effect(g, static_cast<Eigen::Index>(k)));
      }
    }
  }

  /// O(samples) @param values 0 behind the last sample
  Result fit(const SampleNumbers& values) const
  {
    const Coefficients coefficients = this->coefficientsOf(values);
    Result result{ Lanes::Zero(), coefficients[0] * this->Basis[0][0][0], 0.0 };
    for (std::size_t j = 0; j < size; ++j)
    {
      result.atPlace += coefficients[j] * this->AtPlace[j];
    }
    Lanes squares = Lanes::Zero();
    for (std::size_t g = 0; g < this->Groups; ++g)
    {
      squares +=
        this->Weights[g] * (this->residual(values, coefficients, g) / this->Rests[g]).square();
    }
    result.squares = sumOf(squares);
    return result;
  }

  /// Adds, for each sample, the square of its value's difference from the fit to the others.
  void addSquaredResiduals(const SampleNumbers& values, SampleNumbers& sums) const
  {
    const Coefficients coefficients = this->coefficientsOf(values);
    for (std::size_t g = 0; g < this->Groups; ++g)
    {
      const Lanes left = this->residual(values, coefficients, g) / this->Rests[g];
      sums.setGroup(g, sums.group(g) + left.square());
    }
  }

  /// The squared error of the value at the place, by which fits are compared: the geometric mean of
  /// the error of a value left out and of the standard error. The first tells fits apart in rough
  /// fields, the second in noise.
  /// @param squares of a Result, or their sum over the components of a vector
  /// @param least variance of the values, such as by rounding
  double valueVariance(double squares, double least) const
  {
    return this->ValueEffect * std::max(this->PerWeight * squares, least);
  }

  /// The squared standard error of the gradient.
  double gradientVariance(double squares, double least) const
  {
    return this->GradientEffect * std::max(this->PerWeight * squares, least);
  }

private:
  using Coefficients = std::array<double, coefficientCount(Degree)>;
  using Numbers = std::array<Lanes, most / laneCount>; // of samples

  void makeBasis(const FrameSamples& samples, const FrameWeights& weights)
  {
    constexpr double thin = 0.02;
    const Moments<2 * Degree> moments(samples, weights);
    const std::optional<PrincipalAxes> axes = thinAxes(covarianceOf(moments), thin);
    if (!axes)
    {
      this->makeBasis(samples, weights, moments, { 1.0, 1.0, 1.0 });
      return;
    }
    this->Turned.clear();
    for (std::size_t i = 0; i < samples.count(); ++i)
    {
      const Vector offset{ samples.x[i], samples.y[i], samples.z[i] };
      this->Turned.add(
        { dot(offset, axes->axes[0]), dot(offset, axes->axes[1]), dot(offset, axes->axes[2]) },
        0.0);
    }
    Vector extents{};
    std::transform(axes->shares.begin(), axes->shares.end(), extents.begin(), extentOf);
    this->makeBasis(this->Turned, weights, Moments<2 * Degree>(this->Turned, weights), extents);
    for (Lanes& atPlace : this->AtPlace)
    {
      Vector gradient{};
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        gradient += atPlace[static_cast<Eigen::Index>(axis) + 1] * axes->axes[axis];
      }
      atPlace.template tail<3>() << gradient[0], gradient[1], gradient[2];
    }
  }

  /// How far samples count that extend little along an axis, from 0 to 1.
  /// @param share of the variance in the greatest
  static double extentOf(double share)
  {
    constexpr double flat = 1e-4;
    constexpr double solid = 1e-3;
    return std::clamp((share - flat) / (solid - flat), 0.0, 1.0);
  }

  static std::array<Vector, 3> covarianceOf(const Moments<2 * Degree>& moments)
  {
    const Vector sums{ moments.at(1, 0, 0), moments.at(0, 1, 0), moments.at(0, 0, 1) };
    const Vector mean = 1.0 / moments.at(0, 0, 0) * sums;
    const double xy = moments.at(1, 1, 0);
    const double xz = moments.at(1, 0, 1);
    const double yz = moments.at(0, 1, 1);
    return { Vector{ moments.at(2, 0, 0), xy, xz } - sums[0] * mean,
      Vector{ xy, moments.at(0, 2, 0), yz } - sums[1] * mean,
      Vector{ xz, yz, moments.at(0, 0, 2) } - sums[2] * mean };
  }

  void makeBasis(const FrameSamples& samples, const FrameWeights& weights,
    const Moments<2 * Degree>& moments, const Vector& extents)
  {
    constexpr double determined = 1e-4;
    const Fading fading{ determined, extents };
    const CholeskyFactor<Degree> factor(moments, &fading);
    this->AtPlace.fill(Lanes::Zero());
    for (std::size_t i = 0; i < laneCount; ++i)
    {
      this->AtPlace[i][static_cast<Eigen::Index>(i)] = 1.0;
    }
    factor.reduce(Degree, this->AtPlace);
    this->Groups = samples.groupCount();
    for (std::size_t g = 0; g < this->Groups; ++g)
    {
      auto reduced = CholeskyFactor<Degree>::products(
        Lanes(samples.x.group(g)), Lanes(samples.y.group(g)), Lanes(samples.z.group(g)));
      factor.reduce(Degree, reduced);
      this->Weights[g] = weights.group(g);
      for (std::size_t j = 0; j < size; ++j)
      {
        this->Basis[j][g] = reduced[j];
      }
    }
  }

  /// Of the values of four samples, on the value (0) or a component of the gradient (1 to 3).
  Lanes effect(std::size_t group, Eigen::Index k) const
  {
    Lanes effect = Lanes::Zero();
    for (std::size_t j = 0; j < size; ++j)
    {
      effect += this->AtPlace[j][k] * this->Basis[j][group];
    }
    return this->Weights[group] * effect;
  }

  Coefficients coefficientsOf(const SampleNumbers& values) const
  {
    Numbers weighted;
    for (std::size_t g = 0; g < this->Groups; ++g)
    {
      weighted[g] = this->Weights[g] * values.group(g);
    }
    Coefficients coefficients;
    for (std::size_t j = 0; j < size; ++j)
    {
      Lanes sum = Lanes::Zero();
      for (std::size_t g = 0; g < this->Groups; ++g)
      {
        sum += this->Basis[j][g] * weighted[g];
      }
      coefficients[j] = sumOf(sum);
    }
    return coefficients;
  }

  /// Of four samples, not yet divided by their rests.
  Lanes residual(
    const SampleNumbers& values, const Coefficients& coefficients, std::size_t group) const
  {
    Lanes residual = values.group(group);
    for (std::size_t j = 0; j < size; ++j)
    {
      residual -= coefficients[j] * this->Basis[j][group];
    }
    if (this->HasLoose)
    {
      const double mean = coefficients[0] * this->Basis[0][0][0];
      residual += this->Loose[group] * (values.group(group) - mean);
    }
    return residual;
  }

  static constexpr std::size_t size = coefficientCount(Degree);
  /// A sample that alone determines a coefficient has leverage 1 and residual 0. Its difference
  /// from the mean replaces residual / rest.
  static constexpr double leastRest = 1e-3;

  FrameSamples Turned; // to the axes of thin samples
  std::size_t Groups = 0;
  std::array<Numbers, size> Basis;
  std::array<Lanes, size> AtPlace; // value and gradient of each polynomial
  Numbers Weights;
  Numbers Rests; // max(rest, leastRest), rest being 1 - leverage
  Numbers Loose; // max(0, leastRest - rest)
  bool HasLoose = false;
  double ValueEffect = 0.0;
  double GradientEffect = 0.0;
  double PerWeight = 0.0;
};

} // namespace isopoint
