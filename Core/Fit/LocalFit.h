// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace isopoint
{

/// The function fitted to the samples around an isopoint's edge.
enum class FitOrder : std::uint8_t
{
  Linear = 1,    // affine
  Quadratic = 2, // polynomial of degree two
  Cubic = 3,     // polynomial of degree three
  Crease = 4     // largest or smallest of two to four polynomials of degree one or two
};

/// The greatest cosine between the normals on both sides of a crease: 25 degrees.
constexpr double maxCreaseCosine = 0.906;

/// What to compute around each isopoint; the samples' spacing in any case.
struct FitRequest
{
  std::optional<FitOrder> highest; // highest order to try; none: no fit
  bool move;                       // whether isopoints move to the zero of the fit
};

/// A sample of a neighborhood; coincident samples are one.
struct FitSample
{
  Vector position;
  double value;
};

/// An isopoint on its edge, before fits.
struct FitEdge
{
  Vector position;         // by linear interpolation
  Vector increasing;       // from the end below the isovalue to the other
  double increase;         // of the value along it, positive
  double spacing;          // of the samples around its ends
  double valueError = 0.0; // least standard error of each sample's value
};

/// The tangent plane of another piece of a crease fit, as seen from an isopoint q: only places p
/// with inward . (p - q) + distance >= 0 belong to the isopoint's own piece.
struct CreasePlane
{
  Vector inward;   // normal to the plane, of length 1
  double distance; // of q from the plane, not negative
  double turn;     // 1: the surface turns to decreasing values, -1: to increasing ones
};

/// Result of the fits around an isopoint.
struct LocalFit
{
  Vector position; // of the isopoint; moved if requested and a fit holds
  /// The gradient of the fit there. A polynomial of degree one or two with mild weights replaces it
  /// if both agree within their errors; an affine one also if no fit holds. Else the slope along
  /// the edge.
  Vector gradient;
  bool isGradientFitted;         // false for the slope along the edge
  Hessian hessian;               // of the field there, or all 0
  bool isSmooth;                 // whether the Hessian is that of a smooth fit
  double spacing;                // of the samples there: see SampleGatherer
  std::optional<FitOrder> order; // of the fit that holds, if any
  /// Tangent planes of the other pieces, nearest crease first; empty unless the order is Crease.
  std::vector<CreasePlane> creases;
};

} // namespace isopoint
