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

  /// Goes to a place. O(samples)
  /// @param offsets of samples from the place, nearest first: at least one, different ones
  /// @param count how many to fit to, from the first on; up to fittedCount()
  /// @param reach distance at which weights are 0
  void enter(const std::vector<Vector>& offsets, std::size_t count, double reach);

  /// Whether the samples are in a plane, on a line or at one place: then the fit is that in the
  /// plane, at the nearest point to the place, and the gradient has no part across.
  bool isFlat() const { return this->Dimensions < 3; }

  /// Whether the place is outside the samples: they are all on one side, or far.
  bool isOutside() const;

  /// Prepares fits at the place. O(samples)
  void prepare();

  /// The same from weights() of an earlier time, without enter(); unless the method is Blend.
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
  void add(const std::vector<Vector>& offsets);
  void turn(const std::vector<Vector>& offsets);
  void weigh(double squaredReach, bool isSteep);
  template <class Fit>
  void makeStencil(Fit& fit);
  void prepareBlend();
  void applyStencil(const std::vector<SampleNumbers>& values);
  void blend(const std::vector<SampleNumbers>& values, double valueError);
  double resolution(const std::vector<SampleNumbers>& values, double spread) const;
  void limit(const std::vector<SampleNumbers>& values);
  Vector inSpace(const Vector& gradient) const;

  const PlaceMethod Method;
  const bool HasGradients;
  FrameSamples Samples; // in units near the reach
  std::size_t Count = 0;
  std::size_t AllCount = 0;
  double PerUnit = 1.0;
  double SquaredReach = 0.0; // in units
  bool IsTurned = false;
  std::array<Vector, 3> Axes{};  // of turned samples
  Vector Mean{};                 // of these, along the axes
  std::ptrdiff_t Dimensions = 3; // in which samples differ
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
