// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"
#include "Core/Fit/FrameSamples.h"
#include "Core/Fit/PlaceFit.h"
#include "Core/Places/ProbeRequest.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace isopoint
{

/// The samples around a place, nearest first. Samples at one position are one, with several ids.
struct NearbySamples
{
  std::vector<Vector> offsets;       // from the place, by position
  std::vector<std::uint64_t> ids;    // ascending for each position
  std::vector<std::size_t> idBegins; // by position, and the end
  double reach = 0.0;                // distance at which weights vanish
  std::size_t fitted = 0;            // number of positions to fit to, from the first on

  void clear()
  {
    this->offsets.clear();
    this->ids.clear();
    this->idBegins.assign(1, 0);
    this->reach = 0.0;
    this->fitted = 0;
  }

  std::size_t size() const { return this->offsets.size(); }
  bool haveOneIdEach() const { return this->ids.size() == this->offsets.size(); }

  /// Sets the reach and the number of fitted positions.
  /// @param next distance of the first position that is not fitted to; negative if there is none
  void setReach(std::size_t most, double next);
};

/// The number of positions that a method needs around each place: to fit to, and to tell whether
/// the place is outside.
std::size_t neededCount(const ProbeOptions& options);

/// Computes the values of arrays at places from the samples around. Memory is kept. For one thread.
class PlaceEvaluator
{
public:
  /// @param options, arrays must outlive the evaluator
  PlaceEvaluator(const ProbeOptions& options, const std::vector<ProbedArray>& arrays);

  /// Goes to a place. @returns PlaceKinds
  std::uint8_t enter(const NearbySamples& around);

  /// Writes the results of all arrays at a place, after enter(). O(samples) for each
  /// @param around without samples if the place is outside anyway
  /// @param kinds as enter() returned
  void evaluate(std::size_t place, const NearbySamples& around, std::uint8_t kinds);

  /// Writes the results of all arrays at a place that was entered earlier. @param weights of an
  /// earlier time; null if the method is Blend
  void evaluateAgain(
    std::size_t place, const NearbySamples& around, std::uint8_t kinds, const double* weights);

  /// Writes four weights for each position that is fitted to, after enter(), unless the method is
  /// Blend: see PlaceFitter::weights().
  void writeWeights(const NearbySamples& around, double* weights);

private:
  std::uint8_t kindsOf(const std::vector<Vector>& offsets) const;
  bool read(const ProbedArray& array, const NearbySamples& around);
  void evaluatePresent(const ProbedArray& array, std::size_t place, const NearbySamples& around);
  void apply(const ProbedArray& array, std::size_t place, std::size_t fitted, PlaceFitter& fitter);
  void writeOutside(const ProbedArray& array, std::size_t place) const;
  void writeNothing(const ProbedArray& array, std::size_t place) const;
  void writeNearest(
    const ProbedArray& array, std::size_t place, const NearbySamples& around, bool isOutside) const;

  const ProbeOptions& Options;
  const std::vector<ProbedArray>& Arrays;
  PlaceFitter Fitter;
  PlaceFitter PresentFitter; // of an array that lacks values
  bool IsPrepared = false;   // the fitter, for the place
  NearbySamples Present;
  std::vector<SampleNumbers> Values;             // by component, then position
  std::vector<double> Numbers;                   // by id
  std::vector<std::pair<double, double>> Ranges; // of the values fitted to, by component
};

} // namespace isopoint
