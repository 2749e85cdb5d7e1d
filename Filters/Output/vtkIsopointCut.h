// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointCut_h
#define vtkIsopointCut_h

#include "Core/Base/Vector.h"
#include "Core/ExtractionRequest.h"
#include "Input/vtkIsopointBlocks.h"
#include "Input/vtkIsopointInputState.h"

#include "vtkSmartPointer.h"

#include <vector>

namespace isopoint
{
struct Execution;
}
class vtkDoubleArray;
class vtkImplicitFunction;
class vtkIsopointEndSamples;
class vtkPolyData;

/// An implicit function whose level sets are slices of samples (docs/triangles.md, "Slices"). Of a
/// plane without a transform, the values depend on the normal alone, and the rest is in the level.
/// Without a function, values are 0 everywhere, as of a plane without a normal.
class vtkIsopointCut
{
public:
  explicit vtkIsopointCut(vtkImplicitFunction* function);

  bool IsPlane() const { return this->IsOfPlane; }

  /// The value where the function is 0.
  double GetLevel() const { return this->Level; }

  /// Cuts of equal states have equal values.
  vtkIsopointInputState GetState() const;

  /// @throws isopoint::UsageError if a plane has no direction or its numbers are not finite
  void Check() const;

  /// The values at the samples of a block. Throws as loops of isopoint::Execution.
  vtkSmartPointer<vtkDoubleArray> FindValues(
    const isopoint::Execution& execution, const vtkIsopointBlock& block) const;

  /// Moves the points of a slice towards the sample at the end of their edge on the other side of
  /// the function, as far as it has their isovalue, and arrays of numbers with them.
  /// @param ends of edges, with positions
  void MovePoints(const isopoint::Execution& execution,
    const std::vector<isopoint::ExtractedIsosurface>& surfaces, const vtkIsopointEndSamples& ends,
    vtkPolyData* slice) const;

  /// The value at a place.
  double Evaluate(const isopoint::Vector& place) const;

private:
  vtkImplicitFunction* Function;
  bool IsOfPlane = false;
  isopoint::Vector Normal{};
  double Level = 0.0;
};

#endif
