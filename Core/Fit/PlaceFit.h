// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"
#include "Core/Fit/FrameSamples.h"
#include "Core/Fit/OrthonormalFit.h"
#include "Core/Fit/PlaceMethod.h"

#include <array>
#include <cstddef>
#include <vector>

namespace isopoint
{

/// Fits polynomials to the samples around places, one place at a time. What depends on positions
/// alone is computed once for all arrays. For one thread.
class PlaceFitter
{
public:
  /// @param hasGradients whether apply() will be asked for gradients
  PlaceFitter(PlaceMethod method, bool hasGradients)
    : Method(method)
    , HasGradients(hasGradients)
  {
  }

  /// Prepares the fits at a place. O(samples)
  /// @param offsets of samples from the place, nearest first: at least one, different ones
  /// @param count how many to fit to, from the first on; up to fittedCount()
  /// @param reach distance at which weights are 0
  void prepare(const std::vector<Vector>& offsets, std::size_t count, double reach);

  /// Prepares the fits from weights() of an earlier time, unless the method is Blend.
  /// @param weights four for each of `count` positions
  void prepareFrom(const double* weights, std::size_t count);

  /// The weights of the samples in the value (0) and in the gradient (1 to 3), unless the method is
  /// Blend.
  const SampleNumbers& weights(std::size_t k) const { return this->Stencil[k]; }

  /// The value, and the gradient, of an array. O(samples)
  /// @param values of the samples, by component; destroyed
  /// @param valueError least standard error of a value
  /// @param value receives each component. @param gradient null, or receives three numbers for each
  void apply(
    std::vector<SampleNumbers>& values, double valueError, double* value, double* gradient);

private:
  void weigh(double squaredReach, bool isSteep);
  template <class Fit>
  void makeStencil(Fit& fit);
  void prepareBlend();
  void applyStencil(const std::vector<SampleNumbers>& values);
  void blend(const std::vector<SampleNumbers>& values, double valueError);
  double resolution(const std::vector<SampleNumbers>& values, double spread) const;
  void limit(const std::vector<SampleNumbers>& values);

  const PlaceMethod Method;
  const bool HasGradients;
  FrameSamples Samples; // in units near the reach
  std::size_t Count = 0;
  double PerUnit = 1.0;
  double SquaredReach = 0.0; // in units
  FrameWeights Weights;
  std::array<SampleNumbers, laneCount> Stencil;

  OrthonormalFit<1> Affine;
  OrthonormalFit<2> Mild;
  OrthonormalFit<2> Steep;
  OrthonormalFit<3> Cubic;
  bool HasQuadratic = false;
  bool HasCubic = false;
  SampleNumbers Limits; // how much of a sample's difference from the mean may be reached

  // Of an array, by component:
  std::vector<double> Bases;
  std::vector<double> Means;
  std::vector<Lanes> Candidates; // after each other
  std::vector<Lanes> Fitted;     // value and gradient
  bool Extends = false;          // beyond the range of the samples
};

} // namespace isopoint
