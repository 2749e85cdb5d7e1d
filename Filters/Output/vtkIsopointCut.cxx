// SPDX-License-Identifier: GPL-3.0-or-later
#include "Output/vtkIsopointCut.h"

#include "Common/vtkIsopointArrays.h"
#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Failure.h"
#include "Core/OutputArrays.h"
#include "Input/vtkIsopointNumbers.h"
#include "Output/vtkIsopointEndSamples.h"
#include "Output/vtkIsopointOutputArrays.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkImplicitFunction.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <set>
#include <string>

vtkIsopointCut::vtkIsopointCut(vtkImplicitFunction* function)
  : Function(function)
{
  this->IsOfPlane = !function || (vtkPlane::SafeDownCast(function) && !function->GetTransform());
  if (function && this->IsOfPlane)
  {
    double zero[3] = { 0.0, 0.0, 0.0 };
    function->EvaluateGradient(zero, this->Normal.data());
    this->Level = -function->EvaluateFunction(zero);
  }
}

void vtkIsopointCut::Check() const
{
  if (!this->Function || !this->IsOfPlane)
  {
    return;
  }
  const double length = std::hypot(this->Normal[0], this->Normal[1], this->Normal[2]);
  if (length == 0.0)
  {
    throw isopoint::UsageError("The normal of the plane is zero. Set a direction.");
  }
  if (!std::isfinite(length) || !std::isfinite(this->Level))
  {
    throw isopoint::UsageError(
      "The normal or the origin of the plane is not finite. Set finite numbers.");
  }
}

vtkIsopointInputState vtkIsopointCut::GetState() const
{
  if (!this->IsOfPlane)
  {
    return { this->Function->GetMTime() };
  }
  vtkIsopointInputState state(this->Normal.size());
  std::memcpy(state.data(), this->Normal.data(), sizeof(this->Normal));
  return state;
}

double vtkIsopointCut::Evaluate(const isopoint::Vector& place) const
{
  if (this->IsOfPlane)
  {
    return place[0] * this->Normal[0] + place[1] * this->Normal[1] + place[2] * this->Normal[2];
  }
  return this->Function->FunctionValue(place.data());
}

namespace
{

/// Whether several threads may evaluate a function at once. Only exact classes are known to: others
/// may use caches, functions of their own, or code of Python.
bool isForThreads(vtkImplicitFunction* function)
{
  static const std::set<std::string> classes{ "vtkBox", "vtkCone", "vtkCylinder", "vtkPVBox",
    "vtkPVCylinder", "vtkPVPlane", "vtkPlane", "vtkQuadric", "vtkSphere", "vtkSuperquadric" };
  return classes.count(function->GetClassName()) > 0;
}

} // namespace

vtkSmartPointer<vtkDoubleArray> vtkIsopointCut::FindValues(
  const isopoint::Execution& execution, const vtkIsopointBlock& block) const
{
  const vtkIsopointPositions positions(block.Positions);
  auto values = vtkSmartPointer<vtkDoubleArray>::New();
  vtkAllocateTuples(values, block.GetNumberOfSamples());
  double* const numbers = values->GetPointer(0);
  const auto evaluate = [&](std::size_t i)
  {
    isopoint::Vector position;
    positions(i, position.data());
    numbers[i] = this->Evaluate(position);
  };
  const auto count = static_cast<std::size_t>(block.GetNumberOfSamples());
  if (this->IsOfPlane || isForThreads(this->Function))
  {
    isopoint::forEachIndex(execution, count, evaluate);
  }
  else
  {
    isopoint::forEachInOrder(execution, count, evaluate);
  }
  return values;
}

namespace
{

/// Where a function of the way from one place to another is zero: a share of the way, from 0 to 1.
/// Each second step of bisection is one of the secant, so the bracket always shrinks. 0 without a
/// change of sign.
template <class Function>
double shareToZero(const Function& function, double begin, double end)
{
  constexpr int mostSteps = 100;
  constexpr double tolerance = 1e-15;
  if (begin == 0.0 || std::signbit(begin) == std::signbit(end))
  {
    return 0.0;
  }
  const double enough = tolerance * std::max(std::abs(begin), std::abs(end));
  double low = 0.0;
  double high = 1.0;
  double share = 0.0;
  for (int step = 0; step < mostSteps && high - low > tolerance; ++step)
  {
    const double secant = low + (high - low) * (begin / (begin - end));
    share = step % 2 == 0 ? std::clamp(secant, low, high) : 0.5 * (low + high);
    const double found = function(share);
    const bool isLow = std::signbit(found) == std::signbit(begin);
    (isLow ? low : high) = share;
    (isLow ? begin : end) = found;
    if (std::abs(found) <= enough)
    {
      break;
    }
  }
  return share;
}

void moveTuple(double share, vtkDataArray* from, vtkIdType sample, vtkDataArray* to, vtkIdType i)
{
  for (int component = 0; component < to->GetNumberOfComponents(); ++component)
  {
    const double moved = (1.0 - share) * to->GetComponent(i, component) +
                         share * from->GetComponent(sample, component);
    vtkSetIsopointNumber(to, i, component, moved);
  }
}

} // namespace

void vtkIsopointCut::MovePoints(const isopoint::Execution& execution,
  const std::vector<isopoint::ExtractedIsosurface>& surfaces, const vtkIsopointEndSamples& ends,
  vtkPolyData* slice) const
{
  using isopoint::operator+;
  using isopoint::operator-;
  using isopoint::operator*;
  vtkPoints* const points = slice->GetPoints();
  std::vector<std::pair<vtkDataArray*, vtkDataArray*>> arrays; // of samples, of the slice
  for (int k = 0; k < slice->GetPointData()->GetNumberOfArrays(); ++k)
  {
    vtkDataArray* const array = slice->GetPointData()->GetArray(k);
    const int attribute = slice->GetPointData()->IsArrayAnAttribute(k);
    if (array && array->GetName() && !vtkHasIsopointIds(array, attribute))
    {
      arrays.emplace_back(ends.GetAttributes()->GetArray(array->GetName()), array);
    }
  }
  vtkIdType first = 0;
  for (const isopoint::ExtractedIsosurface& extracted : surfaces)
  {
    const isopoint::Isosurface& surface = extracted.surface;
    const double level = surface.isovalue;
    isopoint::forEachInOrder(execution, surface.size(),
      [&](std::size_t index)
      {
        const vtkIdType i = first + static_cast<vtkIdType>(index);
        isopoint::Vector begin;
        points->GetPoint(i, begin.data());
        const double before = this->Evaluate(begin) - level;
        const isopoint::IsopointEdge& edge = surface.edgeOf(index);
        isopoint::Vector end;
        std::uint64_t sample = edge.second;
        ends.GetPosition(sample, end.data());
        double after = this->Evaluate(end) - level;
        if ((after >= 0.0) == (before >= 0.0))
        {
          sample = edge.first;
          ends.GetPosition(sample, end.data());
          after = this->Evaluate(end) - level;
        }
        const isopoint::Vector way = end - begin;
        const double share = shareToZero(
          [&](double part) { return this->Evaluate(begin + part * way) - level; }, before, after);
        points->SetPoint(i, (begin + share * way).data());
        for (const auto& [from, to] : arrays)
        {
          moveTuple(share, from, static_cast<vtkIdType>(sample), to, i);
        }
      });
    first += static_cast<vtkIdType>(surface.size());
  }
}
