// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_LocalFit_h
#define isopoint_LocalFit_h

#include "Core/Base/Vector.h"

#include <cstdint>
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

/// A sample of a neighborhood; coincident samples are one.
struct FitSample
{
  Vector position;
  double value;
};

/// An isopoint on its edge, before anything is fitted.
struct FitEdge
{
  Vector position;         // by linear interpolation
  Vector increasing;       // from the end that is below the isovalue to the one that is not
  double increase;         // of the value along it, positive
  double spacing;          // of the samples around its ends
  double valueError = 0.0; // standard error that each sample's value has at least
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
  /// Of the field there, or that of the affine function through the samples, where that is better
  /// known or no fit held; otherwise the slope along the edge alone.
  Vector gradient;
  bool isGradientFitted;         // to the samples; false for the slope along the edge
  Hessian hessian;               // of the field there, or all 0
  bool isSmooth;                 // whether that of a fit, which describes a smooth surface
  double spacing;                // of the samples there: see SampleGatherer
  std::optional<FitOrder> order; // of the fit that held, if one did
  /// The tangent planes of the other pieces, that of the nearest crease first; empty unless the
  /// order is Crease.
  std::vector<CreasePlane> creases;
};

} // namespace isopoint

#endif
