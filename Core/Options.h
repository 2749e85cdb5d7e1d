// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/ExtractionRequest.h"

#include <string>
#include <tuple>
#include <vector>

namespace isopoint
{

/// Source of normals: the fits' gradients, or planes through the nearest isopoints.
enum class NormalMethod
{
  Automatic = -1, // the field if anything is fitted, else planes
  Field = 0,
  Planes = 1
};

/// The type of the output's positions.
enum class Precision
{
  Single = 0,
  Double = 1,
  Default = 2 // single if the samples' positions are float
};

/// A user's options of an extraction, with defaults. docs/properties.md describes them; namespace
/// option has their names and ranges.
struct Options
{
  bool triangles = false;                             // or only points
  int projection = static_cast<int>(FitOrder::Cubic); // a FitOrder; 0: none
  int normalMethod = static_cast<int>(NormalMethod::Automatic);
  bool dropGaps = true;
  bool computeNormals = true;
  bool computeGradients = false;
  bool computeProjectionOrders = false;
  int outputPointsPrecision = static_cast<int>(Precision::Default);

  // Only for points:
  double angle = defaultAngle;
  int numberOfNeighbors = defaultNeighborCount;
  bool computeSplats = true;

  // Only for triangles:
  bool regularize = true;        // see IsosurfaceRequest::regularizes
  bool keepHullSlivers = false;  // see IsosurfaceRequest::keepsHullSlivers
  bool capping = false;          // see IsosurfaceRequest::caps
  double minimumPieceSize = 0.0; // see IsosurfaceRequest::minimumPieceSize

  /// See IsosurfaceRequest::keepsTetrahedra.
  bool keepTetrahedra = true;
};

/// An option's name in messages, and its range, including both ends.
template <class T>
struct Option
{
  enum Surface
  {
    Any,
    Points,
    Triangles
  };

  const char* name;
  T Options::*value;
  T least;
  T greatest;
  Surface of = Any; // the surfaces that the option affects

  constexpr bool concerns(bool triangles) const
  {
    return this->of == Any || (this->of == Triangles) == triangles;
  }
};

namespace option
{

using Number = Option<double>;
using Choice = Option<int>;
using Switch = Option<bool>;

inline constexpr Choice projection{ "Projection", &Options::projection, 0,
  static_cast<int>(FitOrder::Crease) };
inline constexpr Choice normalMethod{ "NormalMethod", &Options::normalMethod,
  static_cast<int>(NormalMethod::Automatic), static_cast<int>(NormalMethod::Planes) };
inline constexpr Switch dropGaps{ "DropGaps", &Options::dropGaps, false, true };
inline constexpr Switch computeNormals{ "ComputeNormals", &Options::computeNormals, false, true };
inline constexpr Switch computeGradients{ "ComputeGradients", &Options::computeGradients, false,
  true };
inline constexpr Switch computeProjectionOrders{ "ComputeProjectionOrders",
  &Options::computeProjectionOrders, false, true };
inline constexpr Choice outputPointsPrecision{ "OutputPointsPrecision",
  &Options::outputPointsPrecision, static_cast<int>(Precision::Single),
  static_cast<int>(Precision::Default) };
inline constexpr Number angle{ "Angle", &Options::angle, 0.0, 180.0, Number::Points }; // degrees
inline constexpr Choice numberOfNeighbors{ "NumberOfNeighbors", &Options::numberOfNeighbors, 3,
  1000, Choice::Points };
inline constexpr Switch computeSplats{ "ComputeSplats", &Options::computeSplats, false, true,
  Switch::Points };
inline constexpr Switch regularize{ "Regularize", &Options::regularize, false, true,
  Switch::Triangles };
inline constexpr Switch keepHullSlivers{ "KeepHullSlivers", &Options::keepHullSlivers, false, true,
  Switch::Triangles };
inline constexpr Switch capping{ "Capping", &Options::capping, false, true, Switch::Triangles };
inline constexpr Number minimumPieceSize{ "MinimumPieceSize", &Options::minimumPieceSize, 0.0, 1.0,
  Number::Triangles };

inline constexpr auto all = std::make_tuple(projection, normalMethod, dropGaps, computeNormals,
  computeGradients, computeProjectionOrders, outputPointsPrecision, angle, numberOfNeighbors,
  computeSplats, regularize, keepHullSlivers, capping, minimumPieceSize);

} // namespace option

/// Calls visit(option) for all options.
template <class Visitor>
void forAllOptions(const Visitor& visit)
{
  std::apply([&](const auto&... each) { (visit(each), ...); }, option::all);
}

/// Calls visit(option) for each option that has an effect.
template <class Visitor>
void forEffectiveOptions(const Options& options, const Visitor& visit)
{
  forAllOptions(
    [&](const auto& option)
    {
      if (option.concerns(options.triangles))
      {
        visit(option);
      }
    });
}

/// Translates an option's name above to its name in the program that uses the core.
using OptionNaming = std::string (*)(const char* name);

inline std::string sameName(const char* name)
{
  return name;
}

/// @throws UsageError if an option is out of range, even one without an effect, or does not go with
/// another one
void checkOptions(const Options& options, OptionNaming naming = sameName);

/// Each isovalue once, ascending. @throws UsageError if one is NaN
std::vector<double> sortedIsovalues(const std::vector<double>& isovalues);

/// The options that take effect: those only for triangles, or only for points, are reset for the
/// other kind of surface, and triangles have no splats.
Options effectiveOptions(const Options& options);

/// Whether the output's positions are float. @param areFloatPositions of all samples
inline bool isSinglePrecision(const Options& options, bool areFloatPositions)
{
  const auto precision = static_cast<Precision>(options.outputPointsPrecision);
  return precision == Precision::Single || (precision == Precision::Default && areFloatPositions);
}

/// The request of the core, without an isovalue. @param options effective ones
ExtractionRequest requestOf(const Options& options);

} // namespace isopoint
