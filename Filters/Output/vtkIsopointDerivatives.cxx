// SPDX-License-Identifier: GPL-3.0-or-later
#include "Output/vtkIsopointDerivatives.h"

#include "Common/vtkIsopointArrays.h"
#include "Core/Failure.h"

#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"

#include <algorithm>

namespace
{

/// @param compute(of, result) writes numbers of one place; of[3 * i + j] derives component i by j
template <class Compute>
vtkSmartPointer<vtkDoubleArray> derived(
  vtkDoubleArray* gradients, int components, const Compute& compute)
{
  constexpr int ofVectors = 9;
  auto result = vtkSmartPointer<vtkDoubleArray>::New();
  result->SetNumberOfComponents(components);
  vtkAllocateTuples(result, gradients->GetNumberOfTuples());
  for (vtkIdType i = 0; i < gradients->GetNumberOfTuples(); ++i)
  {
    compute(gradients->GetPointer(ofVectors * i), result->GetPointer(components * i));
  }
  return result;
}

} // namespace

void vtkCheckIsopointNames(const std::vector<std::string>& names)
{
  for (auto name = names.begin(); name != names.end(); ++name)
  {
    if (name->empty() || vtkIsGhostArrayName(name->c_str()) ||
        std::find(names.begin(), name, *name) != name)
    {
      throw isopoint::UsageError(
        "A computed array cannot have the name \"" + *name +
        "\": empty, that of ghost marks, or that of another one. Set another name.");
    }
  }
}

void vtkCheckIsopointVectors(int components)
{
  if (components != 3)
  {
    throw isopoint::UsageError(
      "Divergence, vorticity and Q-criterion need vectors, but the array has " +
      std::to_string(components) + (components == 1 ? " component" : " components") +
      ". Choose an array with three components, or compute the gradient alone.");
  }
}

vtkSmartPointer<vtkDoubleArray> vtkComputeIsopointDivergence(vtkDoubleArray* gradients)
{
  return derived(
    gradients, 1, [](const double* of, double* result) { *result = of[0] + of[4] + of[8]; });
}

vtkSmartPointer<vtkDoubleArray> vtkComputeIsopointVorticity(vtkDoubleArray* gradients)
{
  return derived(gradients, 3,
    [](const double* of, double* result)
    {
      result[0] = of[7] - of[5];
      result[1] = of[2] - of[6];
      result[2] = of[3] - of[1];
    });
}

vtkSmartPointer<vtkDoubleArray> vtkComputeIsopointQCriterion(vtkDoubleArray* gradients)
{
  return derived(gradients, 1,
    [](const double* of, double* result)
    {
      *result = -0.5 * (of[0] * of[0] + of[4] * of[4] + of[8] * of[8]) -
                (of[1] * of[3] + of[2] * of[6] + of[5] * of[7]);
    });
}
