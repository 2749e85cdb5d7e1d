// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_FitNeighborhood_h
#define isopoint_FitNeighborhood_h

#include "Isopoint/Fit/CreaseFit.h"
#include "Isopoint/Fit/LocalFit.h"
#include "Isopoint/Fit/PolynomialFit.h"

#include <Eigen/Core>

#include <array>
#include <limits>
#include <optional>
#include <vector>

namespace isopoint
{

/// A fit in the frame of a neighbourhood, and the place it moves the isopoint to.
struct CandidateFit
{
  std::optional<FitOrder> order;                              // if it holds
  bool isDetermined = false;                                  // by the samples
  double criterion = std::numeric_limits<double>::infinity(); // lower is better
  double residual = std::numeric_limits<double>::infinity();  // relative
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Hessian hessian{};
  std::vector<CreasePlane> creases; // distances in the frame's unit

  bool holds() const { return this->order.has_value(); }
};

/// The samples around an isopoint in a frame of its own, and what can be fitted to them.
class FitNeighborhood
{
public:
  /// @param spacing the unit of length
  FitNeighborhood(
    const FitEdge& edge, double isovalue, const std::vector<FitSample>& samples, double spacing);

  /// Whether lengths and values are finite in the frame; otherwise nothing can be fitted.
  bool isUsable() const;

  /// Whether the edge may cross a gap of the samples, so that those around it stand far apart.
  bool mayCrossGap() const;

  /// The polynomial of a degree, weighted so steeply that it all but interpolates the nearest
  /// samples.
  CandidateFit smooth(int degree);

  /// Whether values vary from sample to sample more than any surface that can be fitted explains.
  bool indicatesNoise() const;

  /// Whether a polynomial of degree two leaves residuals that are alike among samples close to each
  /// other, as beside a crease, rather than independent, as in noise.
  bool leavesPattern() const;

  /// The degree, two or three, of the polynomial that the criterion ranks first among those of
  /// degree one to three and creases; nothing if degree one or a crease ranks first, or if the
  /// samples do not determine all three polynomials.
  std::optional<int> bestDegree() const;

  /// The fit that the criterion ranks first.
  CandidateFit best(FitOrder highest) const;

  /// The gradient of the affine function through the samples, in the units of the field, unless it
  /// explains too little or contradicts the edge.
  std::optional<Vector> affineGradient() const;

  /// Copies a fit to the result if it holds. @returns whether it does
  bool apply(const CandidateFit& candidate, LocalFit& fit) const;

private:
  static double mildWeight(double squaredDistance) { return 1.0 / (1.0 + squaredDistance); }

  template <class Weight>
  void weigh(const Weight& weightOf);

  double unexplainedShare(const Polynomial& polynomial) const;
  double meanSquareOf(const Polynomial& polynomial) const;
  double criterionOf(int degree, double meanSquare) const;
  double criterionOf(const CreaseFit& crease) const;
  bool increasesAlong(const Eigen::Vector3d& gradient) const;
  double farthestMove() const;
  CandidateFit tryPolynomial(const Polynomial& polynomial) const;
  CandidateFit tryCrease(const CreaseFit& fit) const;
  void moveToNearestSheet(const CreaseFit& fit, CandidateFit& candidate) const;

  double Scale;
  double ValueScale = 0.0;
  std::vector<FrameSample> Samples; // mildly weighted
  Eigen::Vector3d Increasing;
  double EndSpacing;
};

} // namespace isopoint

#endif
