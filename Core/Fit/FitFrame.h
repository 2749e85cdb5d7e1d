// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"
#include "Core/Fit/FrameSamples.h"
#include "Core/Fit/LocalFit.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// The frame of a fit. Its origin is the isopoint on its edge. Its units are powers of two, so that
/// conversion is exact, near the edge's length and the increase of values along it.
class FitFrame
{
public:
  /// Whether a fit is possible: units are normal, and positions within an edge's length are finite.
  bool isUsable() const { return this->IsUsable; }

  /// Moves to an edge; there are no samples yet.
  void enter(const FitEdge& edge, double isovalue);

  /// Adds samples, O(1) each. The nearest come first while there are fewer than
  /// FrameSamples::nearest. If there would be more than FrameSamples::most, only the nearest of
  /// these are added.
  void add(const FitSample* first, const FitSample* last);

  const FrameSamples& samples() const { return this->Samples; }

  /// The edge, from the end below the isovalue to the other.
  const Vector& increasing() const { return this->Increasing; }

  // From the frame's units to those of positions and values.
  Vector positionAt(const Vector& place) const;
  Vector gradientOf(const Vector& gradient) const;
  Hessian hessianOf(const Hessian& hessian) const;
  std::vector<CreasePlane> planesOf(std::vector<CreasePlane> planes) const;

private:
  /// Selects distances below a limit, and the first ones equal to it.
  struct NearestChoice
  {
    double limit;
    std::size_t equalCount; // how many more to take

    bool takes(double distance)
    {
      const bool isEqual = distance == this->limit && this->equalCount > 0;
      this->equalCount -= isEqual ? 1 : 0;
      return distance < this->limit || isEqual;
    }
  };

  NearestChoice choiceOf(std::size_t count);
  void addNearest(
    const FitSample* samples, std::size_t count, std::size_t nearest, std::size_t most);
  void add(const FitSample& sample)
  {
    this->Samples.add(
      this->placeOf(sample.position), (sample.value - this->Isovalue) * this->PerValue);
  }
  Vector placeOf(const Vector& position) const
  {
    return this->PerLength * (position - this->Origin);
  }

  FrameSamples Samples;
  Vector Origin{};
  double Isovalue = 0.0;
  Vector Increasing{};
  double Length = 1.0;    // unit of lengths, a power of two
  double Value = 1.0;     // unit of values, likewise
  double PerLength = 1.0; // exact reciprocals
  double PerValue = 1.0;
  bool IsUsable = false;
  std::vector<double> Distances;   // squared, of samples to add
  std::vector<double> Ranked;      // the same in another order
  std::vector<std::size_t> Others; // indices of samples after the nearest
};

} // namespace isopoint
