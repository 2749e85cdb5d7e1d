// SPDX-License-Identifier: GPL-3.0-or-later
#include "Input/vtkIsopointGhosts.h"

#include "Input/vtkIsopointAllocation.h"

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
#include <cstddef>
#include <vector>

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

template <class Visitor>
void forEachCellPoint(vtkDataSet* input, const Visitor& visit)
{
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    input->GetCellPoints(cell, points);
    for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
    {
      visit(cell, points->GetId(i));
    }
  }
}

} // namespace

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

/// The points of a data set without regard to other ranks; see vtkFindGhostPoints().
vtkSmartPointer<vtkUnsignedCharArray> findOwnGhostPoints(vtkDataSet* input)
{
  const vtkIdType count = input->GetNumberOfPoints();
  vtkUnsignedCharArray* const own = vtkGetIsopointGhosts(input->GetPointData(), count);
  vtkUnsignedCharArray* const cells =
    vtkGetIsopointGhosts(input->GetCellData(), input->GetNumberOfCells());
  // If the points have a ghost array, it marks the duplicates among them.
  const int excluding =
    own ? hiddenOrCovered : hiddenOrCovered | vtkDataSetAttributes::DUPLICATECELL;
  if (!hasAny(cells, excluding))
  {
    return own;
  }
  constexpr unsigned char inExcludedCell = 1;
  constexpr unsigned char inSampleCell = 2;
  std::vector<unsigned char> memberships(static_cast<std::size_t>(count), 0);
  forEachCellPoint(input,
    [&](vtkIdType cell, vtkIdType point)
    {
      memberships[static_cast<std::size_t>(point)] |=
        (cells->GetValue(cell) & excluding) != 0 ? inExcludedCell : inSampleCell;
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

/// Whether the pieces of a structured grid go on beyond this one.
bool goesOn(const int* extent, const int* wholeExtent)
{
  return extent[1] < wholeExtent[1] || extent[3] < wholeExtent[3] || extent[5] < wholeExtent[5];
}

} // namespace

vtkSmartPointer<vtkUnsignedCharArray> vtkFindGhostPoints(vtkDataSet* input, const int* wholeExtent)
{
  const vtkSmartPointer<vtkUnsignedCharArray> own = findOwnGhostPoints(input);
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

vtkSmartPointer<vtkUnsignedCharArray> vtkFindGhostCells(vtkDataSet* input)
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
    forEachCellPoint(input,
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
