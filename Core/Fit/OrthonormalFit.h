// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Fit/FrameSamples.h"
#include "Core/Fit/Lanes.h"
#include "Core/Fit/NormalEquations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace isopoint
{

/// How far samples determine a coefficient, from 0 to 1: results are continuous where samples begin
/// to determine it.
/// @param pivotShare see CholeskyFactor
inline double determination(double pivotShare)
{
  constexpr double determined = 1e-5;
  return std::clamp((pivotShare - minPivot) / (determined - minPivot), 0.0, 1.0);
}

/// Weighted least squares around a place for any number of arrays: polynomials that are orthonormal
/// over the samples, so that a fit is a few sums of products. Coefficients that samples hardly
/// determine fade out; see determination().
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
    const CholeskyFactor<Degree> factor(samples, weights);
    std::array<Lanes, size> units;
    units.fill(Lanes::Zero());
    for (std::size_t i = 0; i < laneCount; ++i)
    {
      units[i][static_cast<Eigen::Index>(i)] = 1.0;
    }
    factor.reduce(Degree, units);
    for (std::size_t j = 0; j < size; ++j)
    {
      this->Shares[j] = determination(factor.pivotShare(j));
      this->AtPlace[j] = this->Shares[j] * units[j];
    }
    this->Groups = samples.groupCount();
    Lanes total = Lanes::Zero();
    Lanes ofValue = Lanes::Zero();
    Lanes ofGradient = Lanes::Zero();
    this->HasLoose = false;
    for (std::size_t g = 0; g < this->Groups; ++g)
    {
      auto reduced = CholeskyFactor<Degree>::products(
        Lanes(samples.x.group(g)), Lanes(samples.y.group(g)), Lanes(samples.z.group(g)));
      factor.reduce(Degree, reduced);
      const Lanes weight = weights.group(g);
      Lanes leverage = Lanes::Zero();
      for (std::size_t j = 0; j < size; ++j)
      {
        this->Basis[j][g] = reduced[j];
        leverage += this->Shares[j] * reduced[j] * reduced[j];
      }
      const auto squaredEffect = [&](Eigen::Index k)
      {
        Lanes effect = Lanes::Zero();
        for (std::size_t j = 0; j < size; ++j)
        {
          effect += this->AtPlace[j][k] * reduced[j];
        }
        return Lanes((weight * effect).square());
      };
      const Lanes rest = 1.0 - weight * leverage;
      this->Weights[g] = weight;
      this->Rests[g] = rest.max(leastRest);
      this->Loose[g] = (leastRest - rest).max(0.0);
      this->HasLoose = this->HasLoose || (this->Loose[g] > 0.0).any();
      total += weight;
      ofValue += squaredEffect(0);
      if (hasGradient)
      {
        ofGradient += squaredEffect(1) + squaredEffect(2) + squaredEffect(3);
      }
    }
    this->PerWeight = 1.0 / sumOf(total);
    this->ValueEffect = std::sqrt(sumOf(ofValue));
    this->GradientEffect = sumOf(ofGradient);
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
      residual -= this->Shares[j] * coefficients[j] * this->Basis[j][group];
    }
    if (this->HasLoose)
    {
      const double mean = coefficients[0] * this->Basis[0][0][0];
      residual += this->Loose[group] * (values.group(group) - mean);
    }
    return residual;
  }

  static constexpr std::size_t size = coefficientCount(Degree);
  /// A sample that alone determines a coefficient has no residual: its difference from the mean
  /// replaces it.
  static constexpr double leastRest = 1e-3;

  std::size_t Groups = 0;
  std::array<Numbers, size> Basis;
  std::array<double, size> Shares;
  std::array<Lanes, size> AtPlace; // value and gradient of each polynomial, faded
  Numbers Weights;
  Numbers Rests; // 1 less the share of a sample in its own fit
  Numbers Loose; // what that lacks to the least one
  bool HasLoose = false;
  double ValueEffect = 0.0;
  double GradientEffect = 0.0;
  double PerWeight = 0.0;
};

} // namespace isopoint
