// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_LocalFit_h
#define isopoint_LocalFit_h

#include "Isopoint/Base/Vector.h"
#include "Isopoint/Fit/DetectionRate.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace isopoint
{

/// What is fitted to the samples around an isopoint's edge.
enum class FitOrder : std::uint8_t
{
  Linear = 1,    // an affine function
  Quadratic = 2, // a polynomial of degree two
  Cubic = 3,     // and of degree three
  Crease = 4     // the largest, or the smallest, of two to four of degree one or two
};

/// The largest cosine between the normals on either side of a crease, that of 25 degrees.
constexpr double mostCreaseCosine = 0.906;

/// What is computed around each isopoint: the samples' spacing in any case.
struct FitRequest
{
  std::optional<FitOrder> highest; // the highest order that is tried, if anything is fitted
  bool move;                       // isopoints to the zero of the fit, or leave them on their edges
};

/// A sample of a neighbourhood; coincident samples are one.
struct FitSample
{
  Vector position;
  double value;
};

/// An isopoint on its edge, before anything is fitted.
struct FitEdge
{
  Vector position;   // by linear interpolation
  Vector increasing; // from the end that is below the isovalue to the one that is not
  double increase;   // of the value along it, positive
  double spacing;    // of the samples around its ends
};

/// The tangent plane of another piece of a fit with a crease, as seen from an isopoint q on its own
/// piece: only the places p with inward . (p - q) + distance >= 0 belong to that.
struct CreasePlane
{
  Vector inward;   // normal to the plane, of length 1
  double distance; // of q from it, not negative
  double turn; // to which side the surface turns there: 1 to that of decreasing values, -1 to the
               // other one
};

/// What was fitted around an isopoint.
struct LocalFit
{
  Vector position; // of the isopoint, moved if a fit held and moving was requested
  /// Of the field there. If no fit held, that of the affine function through the samples, provided
  /// that it explains most of their variance; otherwise, and if no fit was requested, the slope
  /// along the edge alone.
  Vector gradient;
  bool isGradientFitted;         // to the samples; false for the slope along the edge
  Hessian hessian;               // of the field there, all 0 if what was fitted is affine
  double spacing;                // of the samples there: see SampleGatherer
  std::optional<FitOrder> order; // of the fit that held, if one did
  /// The tangent planes of the other pieces, that of the nearest crease first; empty unless the
  /// order is Crease.
  std::vector<CreasePlane> creases;
};

/// Fits polynomials to the values of the samples around an edge, by least squares weighted with
/// 1 / (0.1 + (d / s)^2)^3, d being a sample's distance from the isopoint and s the mean of those,
/// and moves the isopoint to the zero of one, along gradients (Newton's method). A polynomial of
/// degree two that leaves next to no residuals, weighted with 1 / (1 + (d / s)^2), is accepted at
/// once; then one of degree three through the wider neighbourhood, then one of degree two, if they
/// leave small ones.
///
/// Larger residuals come from noise, from creases, or from detail that the samples hardly resolve.
/// The corrected Akaike criterion [HT89] distinguishes these. Creases are tested for first, where
/// they are requested and residuals of samples close to each other are alike: in the wider
/// neighbourhood and, since a few samples of one more piece do not determine it, in the narrow one.
/// There is a crease where polynomials that meet at it are better than a single one and leave small
/// residuals. There is detail where a polynomial of degree three is better than those of a lower
/// degree, by more than noise would make it, and better than affine functions that meet at creases.
/// If detail is common among the isopoints around, a better polynomial of degree two suffices; if
/// it is rare, only a few of the others are tested. Where samples are too few for all that, a
/// polynomial of degree two may leave residuals three times as large.
///
/// A fit does not hold if the samples do not determine it, if it decreases along the edge where the
/// values increase, or if the isopoint would move farther than half its edge's length. Detail is
/// not tested for on edges so long, compared with the samples' spacing, that they may cross a gap.
/// Where no fit holds the isopoint stays: in noise, and where only an affine function is
/// determined, linear interpolation errs less.
///
/// @param highest order to try, Linear with milder weights and in noise as well; nothing: no fit
/// @param rates of detection among the isopoints around that were fitted before; updated
/// @param widerSamples returns more samples, if there are; called only where `samples` do not
/// suffice
/// @param samples of the neighbourhood, the edge's ends among them, at least two, in an order that
/// does not depend on how they were found: sums are taken in this order
/// Complexity: O(samples.size()), with creases O(samples.size()^2)
LocalFit fitAround(const FitEdge& edge, double isovalue, const std::vector<FitSample>& samples,
  const std::function<const std::vector<FitSample>&()>& widerSamples,
  std::optional<FitOrder> highest, DetectionRates& rates);

} // namespace isopoint

#endif
