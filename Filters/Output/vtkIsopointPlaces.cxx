// SPDX-License-Identifier: GPL-3.0-or-later
#include "Output/vtkIsopointPlaces.h"

#include "Common/vtkIsopointArrays.h"

#include "vtkCellData.h"
#include "vtkCharArray.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <algorithm>

namespace
{

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

void vtkAddIsopointTuples(
  vtkDataArray* all, vtkIdType first, vtkIdType count, int attribute, vtkDataSetAttributes* output)
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
