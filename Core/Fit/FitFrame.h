// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_FitFrame_h
#define isopoint_FitFrame_h

#include "Core/Base/Vector.h"
#include "Core/Fit/FrameSamples.h"
#include "Core/Fit/LocalFit.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// The frame of a fit: its origin is the isopoint on its edge, its units are powers of two near the
/// edge's length and the increase of values along it, by which numbers are divided without
/// rounding.
class FitFrame
{
public:
  /// Whether units are normal numbers and positions up to an edge's length away are finite;
  /// otherwise nothing can be fitted.
  bool isUsable() const { return this->IsUsable; }

  /// Goes to an edge, without samples.
  void enter(const FitEdge& edge, double isovalue);

  /// Adds samples in their order, but of the first ones that are added the nearest come first, and
  /// of very many the nearest alone are added. Complexity: O(last - first)
  void add(const FitSample* first, const FitSample* last);

  const FrameSamples& samples() const { return this->Samples; }

  /// The edge, from the end below the isovalue to the other one.
  const Vector& increasing() const { return this->Increasing; }

  // From the frame's units to those of positions and values.
  Vector positionAt(const Vector& place) const;
  Vector gradientOf(const Vector& gradient) const;
  Hessian hessianOf(const Hessian& hessian) const;
  std::vector<CreasePlane> planesOf(std::vector<CreasePlane> planes) const;

private:
  /// Distances up to a limit, of those that are equal to it the first ones.
  struct NearestChoice
  {
    double limit;
    std::size_t equalCount; // that are still to be taken

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
    return scaled(this->PerLength, difference(position, this->Origin));
  }

  FrameSamples Samples;
  Vector Origin{};
  double Isovalue = 0.0;
  Vector Increasing{};
  double Length = 1.0;    // the unit of lengths, a power of two
  double Value = 1.0;     // and of values, likewise
  double PerLength = 1.0; // their reciprocals, which are exact
  double PerValue = 1.0;
  bool IsUsable = false;
  std::vector<double> Distances;   // squared, of samples that are added
  std::vector<double> Ranked;      // the same in another order
  std::vector<std::size_t> Others; // than the nearest samples
};

} // namespace isopoint

#endif
