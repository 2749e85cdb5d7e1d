// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/ExtractionRequest.h"
#include "Core/Options.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace isopoint
{

class IsosurfaceExtractor;
class ProcessGroup;

/// A message to the user about an extraction.
struct Message
{
  enum Kind
  {
    Warning, // the result is not as requested
    Note     // it is, and there is something to know
  };
  enum Code // as isopoint_message_code
  {
    NoCode = 0, // of filters alone
    SkippedSamples = 1,
    NoSamples = 2,
    ConstantValues = 3,
    IsovalueOutside = 4,
    TooFewSamples = 5,
    AllInGaps = 6,
    NoCrossing = 7,
    PointsWithoutFit = 8,
    SplatsApart = 9,
    BeyondFloat = 10,
    NoIsovalues = 11,
    OnlyAtSamples = 12,
    RoundedPositions = 13,
    DifferentValues = 14,
    IsovalueAtEnd = 15
  };
  std::string cause; // constant in repeated extractions while it lasts
  std::string text;  // the cause, then the remedy, as lists may truncate it
  Kind kind = Warning;
  Code code = NoCode;
};

/// Item counts of a cloud, from its caller.
struct CloudCounts
{
  std::uint64_t items = 0;    // all that were loaded
  std::uint64_t excluded = 0; // left out by the caller
  std::uint64_t unused = 0;   // left out as well: ids without a sample
};

/// Counts of the samples of clouds.
struct SampleCounts
{
  std::uint64_t samples = 0;      // all, including skipped ones
  std::uint64_t notFinite = 0;    // samples with such a coordinate or value
  std::uint64_t excluded = 0;     // samples left out by the caller, such as ghosts
  std::uint64_t withoutArray = 0; // samples of data sets without the chosen array
  std::string array;              // its name, may be empty

  /// Skipped for any reason.
  std::uint64_t skippedCount() const
  {
    return this->notFinite + this->excluded + this->withoutArray;
  }

  /// Counts the samples of a loaded cloud.
  void count(const IsosurfaceExtractor& extractor, const CloudCounts& cloud);

  /// Adds the counts of other ranks. Collective.
  /// @throws std::bad_alloc or FailedElsewhere
  void share(ProcessGroup& processes);
};

/// The message about skipped samples; without a text if only the caller left out any.
/// @param ofNone what follows if all are skipped, @param ofSome otherwise: sentences
Message describeSkipped(
  const SampleCounts& counts, const std::string& ofNone, const std::string& ofSome);

/// Counts of an extraction of isovalues from clouds, and properties needed to assess them.
struct Report : SampleCounts
{
  enum Subject
  {
    Isosurface,
    Slice, // of the values of a cut function, with keepHullSlivers
    Body   // of all samples, with capping at an infinitely low isovalue
  };
  Subject subject = Isosurface;
  std::vector<double> isovalues;        // ascending
  std::vector<std::uint64_t> points;    // by isovalue
  std::vector<std::uint64_t> dropped;   // edges or tetrahedra in gaps, by isovalue
  bool areTriangles = false;            // whether points are connected
  bool areCapped = false;               // whether the surface is that of a body
  bool areProjected = false;            // whether fits were to move points
  bool areSinglePoints = false;         // whether positions become float
  bool contoursBlocks = false;          // whether several blocks are clouds of their own
  bool hadSurface = false;              // whether the same input had points in an earlier update
  std::uint64_t coincident = 0;         // points at the edge of several samples at one position
  std::uint64_t differing = 0;          // those of these with different values
  std::uint64_t unprojectedPoints = 0;  // not moved by a fit
  std::uint64_t innerCorners = 0;       // of splats, see SplatCornerCounts
  std::uint64_t cornersApart = 0;       // corners that meet no others
  std::uint64_t beyondFloat = 0;        // points with a position or radius that float cannot hold
  std::set<std::string> replacedArrays; // input arrays named like a computed one
  bool isPieceOfProcess = false;        // one of several processes without a controller
  bool areNegated = false;              // whether values and isovalues are a user's, negated
  /// The range of the values in use; empty without any.
  double least = std::numeric_limits<double>::infinity();
  double greatest = -std::numeric_limits<double>::infinity();
  /// The least of clouds, see IsosurfaceExtractor::spacingInFloatSteps().
  double spacingInFloatSteps = std::numeric_limits<double>::infinity();

  /// All counts are 0. @throws std::bad_alloc
  Report() = default;
  Report(const Options& options, const std::vector<double>& sortedIsovalues);

  /// Of all isovalues.
  std::uint64_t pointCount() const;
  std::uint64_t droppedCount() const;

  /// Counts the samples of a loaded cloud, and their values.
  void countSamples(const IsosurfaceExtractor& extractor, const CloudCounts& cloud);

  /// Counts the surface of an isovalue, by index, without points of other ranks.
  void countSurface(std::size_t isovalue, const ExtractedIsosurface& surface);

  /// Counts the edges of an isopoint that end at several samples.
  void countCoincident(const ExtractedIsosurface& surface, std::size_t isopoint);

  /// Adds the counts of another block, with the same isovalues and options, contoured separately.
  void add(const Report& other);

  /// Adds the counts of other ranks. Collective.
  /// @throws std::bad_alloc or FailedElsewhere
  void share(ProcessGroup& processes);
};

/// One message for each cause. Samples left out only by the caller cause none, unless these are
/// all.
/// @throws std::bad_alloc
std::vector<Message> describeReport(const Report& report, OptionNaming naming = sameName);

} // namespace isopoint
