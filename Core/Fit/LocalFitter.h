// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Fit/FitFrame.h"
#include "Core/Fit/FrameSamples.h"
#include "Core/Fit/LocalFit.h"
#include "Core/Fit/PolynomialFit.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace isopoint
{

/// Fits polynomials to the samples around edges by weighted least squares, and moves isopoints to
/// their zeros, one edge at a time (docs/algorithm.md, section 10). Memory is kept. For one thread.
class LocalFitter
{
public:
  /// @param highest order to try
  LocalFitter(double isovalue, FitOrder highest)
    : Isovalue(isovalue)
    , Highest(highest)
  {
  }

  /// The isopoint on its edge, with the slope along the edge.
  static LocalFit onEdge(const FitEdge& edge);

  /// Fits a polynomial of degree two, and accepts it if the residuals are negligible: the field is
  /// smooth at the scale of the samples. O(samples)
  /// @param samples of the edge's ends and their neighbors
  /// @returns nothing if more samples are needed
  std::optional<LocalFit> fitNear(const FitEdge& edge, const std::vector<FitSample>& samples);

  /// Fits up to the highest order, after fitNear() of the same edge returned nothing. The isopoint
  /// stays if no fit holds. O(samples)
  /// @param samples all around, including the edge's ends, in canonical order, which affects sums
  /// @param nearCount how many, at the beginning, were passed to fitNear()
  LocalFit fit(const FitEdge& edge, const std::vector<FitSample>& samples, std::size_t nearCount);

private:
  bool isSmooth(const PolynomialFit& found) const;
  std::optional<PolynomialFit> fitHolding(const FrameWeights& weights) const;
  void weighRobustly();
  std::optional<Polynomial> mildPolynomial(int degree) const;
  bool fitLinear(LocalFit& fit);
  bool fitCreases(LocalFit& fit);
  void moveTo(const PolynomialFit& found, LocalFit& fit) const;
  void preferMildGradient(const std::optional<PolynomialFit>& found, LocalFit& fit);

  const double Isovalue;
  const FitOrder Highest;
  FitFrame Frame;
  FrameWeights Steep;   // of the current samples
  FrameWeights Weights; // others
  std::vector<double> Residuals;
};

} // namespace isopoint
