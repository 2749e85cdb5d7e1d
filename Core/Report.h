// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Report_h
#define isopoint_Report_h

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
class Team;

/// What the user is told of an extraction.
struct Message
{
  enum Kinds
  {
    Warning, // the result is not what was asked for
    Note     // the result is, and something is worth knowing
  };
  std::string cause; // the same in each extraction as long as it lasts
  std::string text;  // the cause, then the remedy; lists of messages cut it at the end
  Kinds kind = Warning;
};

/// The items of a cloud, as its caller knows them.
struct CloudCounts
{
  std::uint64_t items = 0;    // all that were loaded
  std::uint64_t excluded = 0; // that the caller left out
  std::uint64_t unused = 0;   // left out as well: ids without a sample
};

/// Counts of an extraction of one or more isovalues from one or more clouds, and what they are
/// judged by.
struct Report
{
  std::vector<double> isovalues;              // ascending
  std::vector<std::uint64_t> points;          // of each isovalue
  bool areTriangles = false;                  // whether points are connected
  bool dropsGaps = false;                     // whether what lies in gaps is left out
  bool areProjected = false;                  // whether fits were to move points
  bool contoursBlocks = false;                // whether each block is a cloud of its own
  std::uint64_t unprojectedPoints = 0;        // that no fit moved
  std::uint64_t innerCorners = 0;             // of splats, see SplatCornerCounts
  std::uint64_t cornersApart = 0;             // of these, the ones that meet no others
  std::uint64_t droppedInGaps = 0;            // edges, or tetrahedra, that were left out
  std::uint64_t samples = 0;                  // all, including skipped ones
  std::uint64_t notFinite = 0;                // samples with such a coordinate or value
  std::uint64_t excluded = 0;                 // samples that the caller left out, such as ghosts
  std::uint64_t withoutArray = 0;             // samples of data sets without the contoured array
  std::string array;                          // its name, perhaps empty
  std::string excludedAs = "ghost or hidden"; // what the caller calls samples that it left out
  std::set<std::string> replacedArrays;       // input arrays with the name of a computed one
  bool isPieceOfProcess = false; // one of several processes, without a controller, yields a piece
  /// The range of the samples that take part, empty without any.
  double least = std::numeric_limits<double>::infinity();
  double greatest = -std::numeric_limits<double>::infinity();

  /// Nothing is counted yet. @throws std::bad_alloc
  Report() = default;
  Report(const Options& options, const std::vector<double>& sortedIsovalues);

  /// Of all isovalues.
  std::uint64_t pointCount() const;

  /// Samples that were skipped, for any reason.
  std::uint64_t skippedCount() const
  {
    return this->notFinite + this->excluded + this->withoutArray;
  }

  /// Counts the samples of a cloud that was loaded.
  void countSamples(const IsosurfaceExtractor& extractor, const CloudCounts& cloud);

  /// Counts the surface of an isovalue, by its number, without points that other ranks count.
  void countSurface(std::size_t isovalue, const ExtractedIsosurface& surface);

  /// Adds what the other ranks have counted. Collective.
  /// @throws std::bad_alloc or FailedElsewhere
  void share(Team& team);
};

/// A message for each cause. Samples that only the caller left out are none.
/// @throws std::bad_alloc
std::vector<Message> describeReport(const Report& report, OptionNaming naming = sameName);

} // namespace isopoint

#endif
