// SPDX-License-Identifier: GPL-3.0-or-later
#include "Input/vtkIsopointGhosts.h"

#include "Common/vtkIsopointArrays.h"
#include "Core/Base/Execution.h"

#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <vector>

vtkUnsignedCharArray* vtkGetIsopointGhosts(vtkDataSetAttributes* attributes, vtkIdType count)
{
  auto* const ghosts = vtkUnsignedCharArray::SafeDownCast(
    attributes->GetArray(vtkDataSetAttributes::GhostArrayName()));
  return ghosts && ghosts->GetNumberOfComponents() == 1 && ghosts->GetNumberOfValues() >= count
           ? ghosts
           : nullptr;
}

namespace
{

constexpr int hiddenOrCovered =
  vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL;

bool hasAny(vtkUnsignedCharArray* ghosts, int bits)
{
  return ghosts &&
         std::any_of(ghosts->GetPointer(0), ghosts->GetPointer(0) + ghosts->GetNumberOfValues(),
           [bits](unsigned char value) { return (value & bits) != 0; });
}

vtkSmartPointer<vtkUnsignedCharArray> newGhosts(vtkIdType count)
{
  auto ghosts = vtkSmartPointer<vtkUnsignedCharArray>::New();
  vtkAllocateTuples(ghosts, count);
  std::fill_n(ghosts->GetPointer(0), count, static_cast<unsigned char>(0));
  return ghosts;
}

/// @param visit(cell, point) called from any thread, for all points of a cell on one thread
template <class Visitor>
void forEachCellPoint(const isopoint::Execution& execution, vtkDataSet* input, const Visitor& visit)
{
  const auto count = static_cast<std::size_t>(input->GetNumberOfCells());
  if (count == 0)
  {
    return;
  }
  // GetCellPoints() is thread-safe only after a first call on a single thread.
  vtkNew<vtkIdList> first;
  input->GetCellPoints(0, first);
  constexpr std::size_t grain = 4096;
  isopoint::forBatches(execution, count, 16 * grain, grain,
    [&](std::size_t begin, std::size_t end)
    {
      vtkNew<vtkIdList> points;
      for (auto cell = static_cast<vtkIdType>(begin); cell < static_cast<vtkIdType>(end); ++cell)
      {
        input->GetCellPoints(cell, points);
        for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
        {
          visit(cell, points->GetId(i));
        }
      }
    });
}

/// vtkFindGhostPoints() without regard to other ranks.
vtkSmartPointer<vtkUnsignedCharArray> findOwnGhostPoints(
  const isopoint::Execution& execution, vtkDataSet* input)
{
  const vtkIdType count = input->GetNumberOfPoints();
  vtkUnsignedCharArray* const own = vtkGetIsopointGhosts(input->GetPointData(), count);
  vtkUnsignedCharArray* const cells =
    vtkGetIsopointGhosts(input->GetCellData(), input->GetNumberOfCells());
  // If the points have a ghost array, it marks duplicates itself.
  const int excluding =
    own ? hiddenOrCovered : hiddenOrCovered | vtkDataSetAttributes::DUPLICATECELL;
  if (!hasAny(cells, excluding))
  {
    return own;
  }
  constexpr unsigned char inExcludedCell = 1;
  constexpr unsigned char inSampleCell = 2;
  std::vector<std::atomic<unsigned char>> memberships(static_cast<std::size_t>(count));
  forEachCellPoint(execution, input,
    [&](vtkIdType cell, vtkIdType point)
    {
      const unsigned char bit =
        (cells->GetValue(cell) & excluding) != 0 ? inExcludedCell : inSampleCell;
      std::atomic<unsigned char>& membership = memberships[static_cast<std::size_t>(point)];
      if ((membership.load(std::memory_order_relaxed) & bit) == 0)
      {
        membership.fetch_or(bit, std::memory_order_relaxed);
      }
    });
  const vtkSmartPointer<vtkUnsignedCharArray> ghosts = newGhosts(count);
  for (vtkIdType point = 0; point < count; ++point)
  {
    const bool isExcluded = memberships[static_cast<std::size_t>(point)] == inExcludedCell;
    const int value =
      (own ? own->GetValue(point) : 0) | (isExcluded ? vtkDataSetAttributes::HIDDENPOINT : 0);
    ghosts->SetValue(point, static_cast<unsigned char>(value));
  }
  return ghosts;
}

/// A ghost array of its own for attributes, with the marks that they have.
vtkSmartPointer<vtkUnsignedCharArray> addGhosts(vtkDataSetAttributes* attributes, vtkIdType count)
{
  const vtkSmartPointer<vtkUnsignedCharArray> ghosts = newGhosts(count);
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  if (vtkUnsignedCharArray* const before = vtkGetIsopointGhosts(attributes, count))
  {
    std::copy_n(before->GetPointer(0), count, ghosts->GetPointer(0));
  }
  attributes->AddArray(ghosts);
  return ghosts;
}

/// Whether other pieces of a structured grid follow this one.
bool goesOn(const int* extent, const int* wholeExtent)
{
  return extent[1] < wholeExtent[1] || extent[3] < wholeExtent[3] || extent[5] < wholeExtent[5];
}

} // namespace

vtkSmartPointer<vtkUnsignedCharArray> vtkFindGhostPoints(
  const isopoint::Execution& execution, vtkDataSet* input, const int* wholeExtent)
{
  const vtkSmartPointer<vtkUnsignedCharArray> own = findOwnGhostPoints(execution, input);
  const int* const extent = wholeExtent && input->GetExtentType() == VTK_3D_EXTENT
                              ? input->GetInformation()->Get(vtkDataObject::DATA_EXTENT())
                              : nullptr;
  if (!extent || !goesOn(extent, wholeExtent))
  {
    return own;
  }
  const vtkSmartPointer<vtkUnsignedCharArray> ghosts = newGhosts(input->GetNumberOfPoints());
  vtkIdType point = 0;
  for (int z = extent[4]; z <= extent[5]; ++z)
  {
    for (int y = extent[2]; y <= extent[3]; ++y)
    {
      for (int x = extent[0]; x <= extent[1]; ++x, ++point)
      {
        const bool isOfNext = (x == extent[1] && x < wholeExtent[1]) ||
                              (y == extent[3] && y < wholeExtent[3]) ||
                              (z == extent[5] && z < wholeExtent[5]);
        const int value =
          (own ? own->GetValue(point) : 0) | (isOfNext ? vtkDataSetAttributes::DUPLICATEPOINT : 0);
        ghosts->SetValue(point, static_cast<unsigned char>(value));
      }
    }
  }
  return ghosts;
}

vtkSmartPointer<vtkUnsignedCharArray> vtkFindGhostCells(
  const isopoint::Execution& execution, vtkDataSet* input)
{
  const vtkIdType count = input->GetNumberOfCells();
  vtkUnsignedCharArray* const own = vtkGetIsopointGhosts(input->GetCellData(), count);
  vtkUnsignedCharArray* const points =
    vtkGetIsopointGhosts(input->GetPointData(), input->GetNumberOfPoints());
  const bool hasHiddenPoints = hasAny(points, vtkDataSetAttributes::HIDDENPOINT);
  if (!own && !hasHiddenPoints)
  {
    return nullptr;
  }
  const vtkSmartPointer<vtkUnsignedCharArray> ghosts = newGhosts(count);
  for (vtkIdType cell = 0; own && cell < count; ++cell)
  {
    if ((own->GetValue(cell) & (hiddenOrCovered | vtkDataSetAttributes::DUPLICATECELL)) != 0)
    {
      ghosts->SetValue(cell, vtkDataSetAttributes::HIDDENPOINT);
    }
  }
  if (hasHiddenPoints)
  {
    forEachCellPoint(execution, input,
      [&](vtkIdType cell, vtkIdType point)
      {
        if ((points->GetValue(point) & vtkDataSetAttributes::HIDDENPOINT) != 0)
        {
          ghosts->SetValue(cell, vtkDataSetAttributes::HIDDENPOINT);
        }
      });
  }
  return ghosts;
}

void vtkHideIsopointPoints(
  const isopoint::Execution& execution, const unsigned char* hidden, vtkDataSet* data)
{
  const vtkIdType count = data->GetNumberOfPoints();
  if (std::all_of(hidden, hidden + count, [](unsigned char isHidden) { return isHidden == 0; }))
  {
    return;
  }
  const auto points = addGhosts(data->GetPointData(), count);
  const auto cells = addGhosts(data->GetCellData(), data->GetNumberOfCells());
  for (vtkIdType point = 0; point < count; ++point)
  {
    unsigned char& marks = *points->GetPointer(point);
    marks |= hidden[point] != 0 ? vtkDataSetAttributes::HIDDENPOINT : 0;
  }
  forEachCellPoint(execution, data,
    [&](vtkIdType cell, vtkIdType point)
    {
      unsigned char& marks = *cells->GetPointer(cell);
      marks |= hidden[point] != 0 ? vtkDataSetAttributes::HIDDENCELL : 0;
    });
}
