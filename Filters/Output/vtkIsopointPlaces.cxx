// SPDX-License-Identifier: GPL-3.0-or-later
#include "Output/vtkIsopointPlaces.h"

#include "Common/vtkIsopointArrays.h"
#include "Core/Failure.h"
#include "Input/vtkIsopointNumbers.h"
#include "Output/vtkIsopointOutput.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCharArray.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{

constexpr const char* tooManyPoints =
  "The image has too many points for any memory. Reduce the sampling dimensions, or increase the"
  " spacing.";

void pass(vtkDataSetAttributes* from, bool areAll, vtkDataSetAttributes* to)
{
  if (areAll)
  {
    to->PassData(from);
  }
  else if (auto* const ghosts = from->GetArray(vtkDataSetAttributes::GhostArrayName()))
  {
    to->AddArray(ghosts);
  }
}

void copy(vtkDataSet* input, const vtkIsopointPassing& passing, vtkDataSet* output)
{
  output->CopyStructure(input);
  pass(input->GetPointData(), passing.PointArrays, output->GetPointData());
  pass(input->GetCellData(), passing.CellArrays, output->GetCellData());
  if (passing.FieldArrays)
  {
    output->GetFieldData()->PassData(input->GetFieldData());
  }
}

/// Gives a composite the structure of another one, and copies of its leaves.
/// @param copyLeaf(leaf) returns null to leave it out
template <class Copy>
void copyLeaves(vtkCompositeDataSet* input, vtkCompositeDataSet* output, const Copy& copyLeaf)
{
  output->CopyStructure(input);
  const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(input->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    if (const vtkSmartPointer<vtkDataObject> made = copyLeaf(iterator->GetCurrentDataObject()))
    {
      output->SetDataSet(iterator, made);
    }
  }
}

} // namespace

void vtkCopyIsopointPlaces(
  vtkDataObject* input, const vtkIsopointPassing& passing, vtkDataObject* output)
{
  auto* const blocks = vtkCompositeDataSet::SafeDownCast(input);
  if (!blocks)
  {
    copy(vtkDataSet::SafeDownCast(input), passing, vtkDataSet::SafeDownCast(output));
    return;
  }
  copyLeaves(blocks, vtkCompositeDataSet::SafeDownCast(output),
    [&](vtkDataObject* leaf)
    {
      auto* const data = vtkDataSet::SafeDownCast(leaf);
      const auto made = vtkSmartPointer<vtkDataSet>::Take(data ? data->NewInstance() : nullptr);
      if (data)
      {
        copy(data, passing, made);
      }
      return vtkSmartPointer<vtkDataObject>(made);
    });
  if (passing.FieldArrays)
  {
    output->GetFieldData()->PassData(input->GetFieldData());
  }
}

void vtkCopyIsopointInput(vtkDataObject* input, vtkDataObject* output)
{
  auto* const blocks = vtkCompositeDataSet::SafeDownCast(input);
  if (!blocks)
  {
    output->ShallowCopy(input);
    return;
  }
  copyLeaves(blocks, vtkCompositeDataSet::SafeDownCast(output),
    [](vtkDataObject* leaf)
    {
      const auto made = vtkSmartPointer<vtkDataObject>::Take(leaf->NewInstance());
      made->ShallowCopy(leaf);
      return made;
    });
  output->GetFieldData()->PassData(input->GetFieldData());
}

void vtkAppendIsopointPlaces(vtkDataSet* data, std::vector<isopoint::Vector>& places)
{
  const vtkIsopointPositions positions(data);
  const auto first = places.size();
  places.resize(first + static_cast<std::size_t>(data->GetNumberOfPoints()));
  for (std::size_t i = first; i < places.size(); ++i)
  {
    positions(i - first, places[i].data());
  }
}

void vtkMakeIsopointLine(
  const double begin[3], const double end[3], vtkIdType count, vtkPolyData* output)
{
  const auto isFinite = [](double x) { return std::isfinite(x); };
  if (!std::all_of(begin, begin + 3, isFinite) || !std::all_of(end, end + 3, isFinite))
  {
    throw isopoint::UsageError("The ends of the line are not finite. Set finite numbers.");
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkAllocateTuples(points->GetData(), count);
  vtkNew<vtkDoubleArray> lengths;
  lengths->SetName(vtkIsopointLineLength);
  vtkAllocateTuples(lengths, count);
  const double length = std::hypot(end[0] - begin[0], end[1] - begin[1], end[2] - begin[2]);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    double place[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      place[axis] = (1.0 - share) * begin[axis] + share * end[axis];
    }
    points->SetPoint(i, place);
    lengths->SetValue(i, share * length);
  }
  output->SetPoints(points);
  if (count > 0)
  {
    output->SetLines(vtkNewIsopointPolyline(count));
  }
  output->GetPointData()->AddArray(lengths);
}

vtkIsopointGrid vtkFindIsopointGrid(
  const double bounds[6], const int dimensions[3], const double spacing[3])
{
  double lengths[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    lengths[axis] = bounds[2 * axis + 1] - bounds[2 * axis];
    if (!(lengths[axis] >= 0.0) || !std::isfinite(lengths[axis]))
    {
      throw isopoint::UsageError("The sampling bounds are not three ascending pairs of numbers. Set"
                                 " the least and the greatest x, y and z.");
    }
    if (dimensions[axis] < 0)
    {
      throw isopoint::UsageError("A sampling dimension is negative. Set the number of points along"
                                 " the axis, or 0 for as many as the spacing needs.");
    }
    if (!(spacing[axis] >= 0.0) || !std::isfinite(spacing[axis]))
    {
      throw isopoint::UsageError("The spacing is negative or not finite. Set the distance of points"
                                 " along each axis, or 0 for a 99th of the longest side.");
    }
  }
  const double longest = *std::max_element(lengths, lengths + 3);
  constexpr int automaticSteps = 99;
  constexpr double rounding = 1e-12; // of a length that is a multiple of the spacing
  vtkIsopointGrid grid;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double least = bounds[2 * axis];
    const bool isBySpacing = dimensions[axis] == 0;
    double step = spacing[axis] > 0.0 ? spacing[axis] : longest / automaticSteps;
    double steps = isBySpacing ? std::ceil(lengths[axis] / step * (1.0 - rounding))
                               : static_cast<double>(dimensions[axis] - 1);
    if (lengths[axis] == 0.0)
    {
      steps = 0.0;
    }
    if (!(steps < std::numeric_limits<int>::max()))
    {
      throw isopoint::UsageError(tooManyPoints);
    }
    if (!isBySpacing || step == 0.0)
    {
      step = steps > 0.0 ? lengths[axis] / steps : 1.0;
    }
    grid.Spacing[axis] = step;
    grid.Origin[axis] = steps > 0.0 ? least : least + 0.5 * lengths[axis];
    grid.Extent[2 * axis] = 0;
    grid.Extent[2 * axis + 1] = static_cast<int>(steps);
  }
  return grid;
}

void vtkMakeIsopointGrid(const vtkIsopointGrid& grid, const int extent[6], vtkImageData* output)
{
  constexpr double mostPoints = 1e11; // whose positions take terabytes
  const double points =
    (1.0 + extent[1] - extent[0]) * (1.0 + extent[3] - extent[2]) * (1.0 + extent[5] - extent[4]);
  if (points > mostPoints)
  {
    throw isopoint::UsageError(tooManyPoints);
  }
  output->GetPointData()->Initialize(); // images keep the scalars of the last update
  output->SetOrigin(grid.Origin);
  output->SetSpacing(grid.Spacing);
  output->SetExtent(const_cast<int*>(extent));
}

void vtkAddIsopointTuples(vtkAbstractArray* all, vtkIdType first, vtkIdType count, int attribute,
  vtkDataSetAttributes* output)
{
  vtkSmartPointer<vtkAbstractArray> own = all;
  if (count != all->GetNumberOfTuples())
  {
    own = vtkNewArrayLike(all, count);
    own->InsertTuples(0, count, first, all);
  }
  vtkAddAttribute(attribute, own, output);
}

void vtkAddIsopointMask(const unsigned char* areNull, const std::string& name, vtkDataSet* output)
{
  vtkNew<vtkCharArray> mask;
  mask->SetName(name.c_str());
  vtkAllocateTuples(mask, output->GetNumberOfPoints());
  std::transform(areNull, areNull + output->GetNumberOfPoints(), mask->GetPointer(0),
    [](unsigned char isNull) { return static_cast<char>(isNull == 0); });
  output->GetPointData()->AddArray(mask);
}
