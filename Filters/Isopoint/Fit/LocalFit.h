// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_LocalFit_h
#define isopoint_LocalFit_h

#include "Isopoint/Fit/DetectionRate.h"
#include "Isopoint/Base/Vector.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace isopoint
{

/// What is fitted to the samples around an isopoint's edge; the highest that is tried, or the one
/// that held.
enum class FitOrder : std::uint8_t
{
  None = 0,      // linear interpolation along the edge alone
  Linear = 1,    // an affine function
  Quadratic = 2, // a polynomial of degree two
  Cubic = 3,     // and of degree three
  Crease = 4     // the largest, or the smallest, of two to four of degree one or two
};

/// The largest cosine between the normals on either side of a crease, that of 25 degrees.
constexpr double mostCreaseCosine = 0.906;

/// What is wanted of fits around isopoints.
struct FitRequest
{
  FitOrder highest;
  bool move; // isopoints to the zero of the fit, or leave them on their edges
};

/// A sample of a neighbourhood. Those at one position are one, with the mean of their values.
struct FitSample
{
  Vector position;
  double value;
};

/// An isopoint on its edge, before anything is fitted.
struct FitEdge
{
  Vector position; // by linear interpolation
  Vector rising;   // from the end that is below the isovalue to the one that is not
  double rise;     // by how much the value rises along it, positive
  double spacing;  // of the samples around its ends
};

/// What the samples around an isopoint tell of the field and the surface there.
struct LocalFit
{
  Vector position; // of the isopoint, moved where a fit held
  /// Of the field there. Where no fit held, that of the affine function through the samples, if it
  /// tells of most of their variance, or else, and where none was asked for, the slope along the
  /// edge alone.
  Vector gradient;
  bool isGradientFitted; // to the samples, not the slope along the edge
  /// Second derivatives xx, yy, zz, xy, xz, yz, all 0 where what was fitted is affine.
  std::array<double, 6> hessian;
  double spacing; // of the samples there: see SampleGatherer
  FitOrder order; // that held
};

/// Fits polynomials to the values of the samples around an edge, by least squares weighted with
/// 1 / (0.1 + (d / s)^2)^3, d being a sample's distance from the isopoint and s the mean of those,
/// and moves the isopoint to the zero of one, along gradients (Newton's method). A polynomial of
/// degree two that leaves next to no residuals, weighted with 1 / (1 + (d / s)^2), is taken at
/// once, then one of degree three through the wider neighbourhood, then one of degree two, if they
/// leave but small ones.
///
/// Larger residuals come from noise, from creases, or from detail that the samples resolve thinly,
/// told apart by the corrected Akaike criterion (Hurvich, Tsai, "Regression and time series model
/// selection in small samples", Biometrika 76, 1989). Creases are looked for first, where they are
/// asked for and where residuals of samples close to each other are alike: in the wider
/// neighbourhood and, since a few samples of one more piece do not determine it, in the narrow one.
/// There is one where polynomials that meet at it are better than a single one and leave but small
/// residuals. There is detail where a polynomial of degree three is better than those of a lower
/// degree, by more than noise would let it, and than affine functions that meet at creases. Where
/// this is common among the isopoints around, one of degree two is enough to tell of detail; where
/// next to none do, few others are asked. Where samples are too few for all that, a polynomial of
/// degree two may leave residuals three times as large.
///
/// A fit does not hold if the samples do not determine it, if it falls where the edge rises, or if
/// the isopoint would move farther than half its edge's length; nor is detail looked for on edges
/// so long beside the samples' spacing that they may cross a gap. Where no fit holds the isopoint
/// stays: so it does in noise, and where only an affine function is determined, all places where
/// linear interpolation errs less.
///
/// @param highest order to try: None, Linear (also in noise, with the milder weights), Quadratic,
/// Cubic, or Crease
/// @param tallies of the isopoints around that were fitted before
/// @param widerSamples gives more of them, if there are; asked only where those do not suffice
/// @param samples of the neighbourhood, the edge's ends among them, at least two, in an order that
/// does not depend on how they were found: sums are taken in it
/// Complexity: O(samples.size()), with creases O(samples.size()^2)
LocalFit fitAround(const FitEdge& edge, double isovalue, const std::vector<FitSample>& samples,
  const std::function<const std::vector<FitSample>&()>& widerSamples, FitOrder highest,
  DetectionRates& tallies);

} // namespace isopoint

#endif
