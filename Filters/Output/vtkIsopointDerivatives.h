// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointDerivatives_h
#define vtkIsopointDerivatives_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDoubleArray;

/// @throws isopoint::UsageError unless the names of arrays differ, none empty or that of ghost
/// marks
void vtkCheckIsopointNames(const std::vector<std::string>& names);

/// @throws isopoint::UsageError unless the components of an array are three
void vtkCheckIsopointVectors(int components);

// Each function computes an array from the gradients of vectors: nine components, the derivatives
// of x by x, y and z, then those of y and z. As vtkGradientFilter defines it.
// Throws std::bad_alloc.

/// The trace. One component.
vtkSmartPointer<vtkDoubleArray> vtkComputeIsopointDivergence(vtkDoubleArray* gradients);

/// The curl. Three components.
vtkSmartPointer<vtkDoubleArray> vtkComputeIsopointVorticity(vtkDoubleArray* gradients);

/// Minus half the trace of the square of the gradient. One component.
vtkSmartPointer<vtkDoubleArray> vtkComputeIsopointQCriterion(vtkDoubleArray* gradients);

#endif
