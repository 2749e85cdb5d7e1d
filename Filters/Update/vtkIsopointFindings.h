// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointFindings_h
#define vtkIsopointFindings_h

#include "Input/vtkIsopointBlock.h"

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
} // namespace isopoint
struct vtkIsopointOptions;

/**
 * What the user of a filter is told.
 */
struct vtkIsopointMessage
{
  enum Kinds
  {
    WARNING, // of a result that is not what was asked for
    NOTE     // on a result that is
  };
  std::string Cause; // the same in each update as long as it lasts
  std::string Text;  // what counts first: ParaView's list cuts it; then the remedy
  Kinds Kind = WARNING;
};

/**
 * What an update found out that its user may have to know.
 */
struct vtkIsopointFindings
{
  std::vector<double> Isovalues;        // ascending
  std::vector<std::uint64_t> Points;    // for each isovalue
  bool AreTriangles = false;            // whether points are connected
  bool DropsGaps = false;               // whether what lies in gaps is left out
  bool AreProjected = false;            // whether fits were to move points
  std::uint64_t UnprojectedPoints = 0;  // that no fit moved
  std::uint64_t DroppedInGaps = 0;      // edges, or tetrahedra, that were left out
  std::uint64_t Samples = 0;            // those that were left out included
  std::uint64_t NotFinite = 0;          // samples with such a coordinate or value
  std::uint64_t Ghosts = 0;             // ghost and hidden samples
  std::uint64_t WithoutArray = 0;       // samples of blocks without the contoured array
  std::string Array;                    // its name, perhaps empty
  std::set<std::string> ReplacedArrays; // input arrays with the name of a computed one
  bool IsPieceOfProcess = false;        // whether processes without a controller yield pieces
  /// The range of the samples that take part, empty without any.
  double Least = std::numeric_limits<double>::infinity();
  double Greatest = -std::numeric_limits<double>::infinity();

  /// Nothing yet, with these options. @throws std::bad_alloc
  void Start(const vtkIsopointOptions& options);

  /// Of all isovalues.
  std::uint64_t GetNumberOfPoints() const;

  /// Those that took no part, for any reason.
  std::uint64_t GetNumberOfSkippedSamples() const;

  /// Counts the samples of some blocks, which the extractor has loaded.
  void CountSamples(
    const std::vector<vtkIsopointBlock>& blocks, const isopoint::IsosurfaceExtractor& extractor);

  /// Adds what the other ranks have found. Collective.
  /// @throws std::bad_alloc or FailedElsewhere
  void Share(isopoint::Team& team);
};

/**
 * A message for each cause. Ghosts alone are none.
 * @throws std::bad_alloc
 */
std::vector<vtkIsopointMessage> vtkDescribeIsopointFindings(const vtkIsopointFindings& findings);

#endif
