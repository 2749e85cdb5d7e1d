// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_LocalFitter_h
#define isopoint_LocalFitter_h

#include "Core/Fit/FitFrame.h"
#include "Core/Fit/FrameSamples.h"
#include "Core/Fit/LocalFit.h"
#include "Core/Fit/PolynomialFit.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace isopoint
{

/// Fits polynomials to the values of the samples around edges, by weighted least squares, and moves
/// isopoints to their zeros; one edge at a time (docs/algorithm.md, section 10). Memory is kept.
/// For one thread.
class LocalFitter
{
public:
  /// @param highest order that is tried
  LocalFitter(double isovalue, FitOrder highest)
    : Isovalue(isovalue)
    , Highest(highest)
  {
  }

  /// The isopoint on its edge, with the slope along the edge.
  static LocalFit onEdge(const FitEdge& edge);

  /// Fits a polynomial of degree two, and accepts it where it leaves next to no residuals: the
  /// field is smooth at the scale of the samples.
  /// @param samples those next to the edge's ends suffice; the ends are among them
  /// @returns nothing if more samples are to be tried. Complexity: O(samples)
  std::optional<LocalFit> fitNear(const FitEdge& edge, const std::vector<FitSample>& samples);

  /// Fits what the samples determine, up to the highest order, where fitNear() of the same edge did
  /// not. Where no fit holds, the isopoint stays.
  /// @param samples all around, the edge's ends among them, in an order that does not depend on how
  /// they were found: sums are taken in this order
  /// @param nearCount how many of them, the first ones, were those of fitNear()
  /// Complexity: O(samples)
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
  FrameWeights Steep;   // of the present samples
  FrameWeights Weights; // others
  std::vector<double> Residuals;
};

} // namespace isopoint

#endif
