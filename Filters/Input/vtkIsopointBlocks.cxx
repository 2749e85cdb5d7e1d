// SPDX-License-Identifier: GPL-3.0-or-later
#include "Input/vtkIsopointBlocks.h"

#include "Input/vtkIsopointCellCenters.h"
#include "Input/vtkIsopointGhosts.h"
#include "Input/vtkIsopointUsageError.h"
#include "Isopoint/Base/Execution.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkHyperTreeGrid.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace
{

/// The names of the arrays, for an error message.
std::string arrayNames(vtkDataSetAttributes* attributes)
{
  std::ostringstream names;
  const int count = attributes ? attributes->GetNumberOfArrays() : 0;
  for (int i = 0; i < count; ++i)
  {
    const char* const name = attributes->GetArrayName(i);
    names << (i > 0 ? ", " : "") << (name ? name : "(unnamed)");
  }
  return count > 0 ? names.str() : std::string("none");
}

/// The remedy of an error about the array to process, with the arrays of a leaf.
std::string remedyFor(vtkDataObject* leaf)
{
  return " Choose a scalar array with SetInputArrayToProcess() (Contour By in ParaView); the point"
         " arrays are: " +
         arrayNames(leaf->GetAttributes(vtkDataObject::POINT)) +
         "; the cell arrays are: " + arrayNames(leaf->GetAttributes(vtkDataObject::CELL)) + ".";
}

vtkIdType elementCount(vtkDataObject* leaf)
{
  if (auto* const dataSet = vtkDataSet::SafeDownCast(leaf))
  {
    return std::max(dataSet->GetNumberOfPoints(), dataSet->GetNumberOfCells());
  }
  auto* const trees = vtkHyperTreeGrid::SafeDownCast(leaf);
  return trees ? trees->GetNumberOfLeaves() : 0;
}

/// @throws vtkIsopointUsageError if the array is not numeric or has not one component
vtkDataArray* asScalars(vtkAbstractArray* array, vtkDataObject* leaf)
{
  const std::string described =
    std::string("The array \"") + (array->GetName() ? array->GetName() : "") + "\" ";
  auto* const scalars = vtkDataArray::SafeDownCast(array);
  if (!scalars)
  {
    throw vtkIsopointUsageError(described + "holds no numbers." + remedyFor(leaf));
  }
  if (scalars->GetNumberOfComponents() != 1)
  {
    throw vtkIsopointUsageError(described + "has " +
                                std::to_string(scalars->GetNumberOfComponents()) +
                                " components, but a scalar array has one. Compute a component"
                                " or the magnitude first, with vtkArrayCalculator or ParaView's"
                                " Calculator.");
  }
  return scalars;
}

} // namespace

vtkIdType vtkIsopointBlock::GetNumberOfSamples() const
{
  return this->Positions->GetNumberOfPoints();
}

vtkIsopointArrayChoice::vtkIsopointArrayChoice(vtkInformation* inputArray)
  : Association(inputArray->Get(vtkDataObject::FIELD_ASSOCIATION()))
  // ParaView passes an empty name if no array was chosen.
  , Name(inputArray->Has(vtkDataObject::FIELD_NAME()) ? inputArray->Get(vtkDataObject::FIELD_NAME())
                                                      : "")
  , Attribute(inputArray->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE())
                ? inputArray->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE())
                : vtkDataSetAttributes::SCALARS)
{
}

bool vtkIsopointArrayChoice::MayBeOfPoints() const
{
  return this->Association != vtkDataObject::FIELD_ASSOCIATION_CELLS;
}

bool vtkIsopointArrayChoice::MayBeOfCells() const
{
  return this->Association == vtkDataObject::FIELD_ASSOCIATION_CELLS ||
         this->Association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS;
}

vtkAbstractArray* vtkIsopointArrayChoice::Find(vtkDataSetAttributes* attributes) const
{
  return this->Name.empty() ? attributes->GetAbstractAttribute(this->Attribute)
                            : attributes->GetAbstractArray(this->Name.c_str());
}

std::string vtkIsopointArrayChoice::Describe() const
{
  const std::string element = !this->MayBeOfPoints() ? "cell"
                              : this->MayBeOfCells() ? "point or cell"
                                                     : "point";
  return this->Name.empty() ? "active " + element + " scalars"
                            : element + " array named \"" + this->Name + "\"";
}

void vtkIsopointBlocks::Collect(const isopoint::Execution& execution, vtkDataObject* input,
  const vtkIsopointArrayChoice& choice, const int* wholeExtent)
{
  this->ReleaseInput();
  std::string remedy;
  std::size_t leaves = 0;
  vtkForEachIsopointLeaf(input,
    [&](vtkDataObject* leaf, std::size_t number)
    {
      leaves = number + 1;
      if (elementCount(leaf) > 0)
      {
        remedy = remedy.empty() ? remedyFor(leaf) : remedy;
        this->AddLeaf(execution, leaf, number, choice, leaf == input ? wholeExtent : nullptr);
      }
    });
  this->KeptCenters.erase(this->KeptCenters.lower_bound(leaves), this->KeptCenters.end());
  if (remedy.empty())
  {
    throw vtkIsopointNothingError(
      "The input has no points or cells. Connect a data set with a scalar array.");
  }
  if (this->Blocks.empty())
  {
    throw vtkIsopointNothingError("The input has no " + choice.Describe() + "." + remedy);
  }
}

void vtkIsopointBlocks::AddLeaf(const isopoint::Execution& execution, vtkDataObject* leaf,
  std::size_t number, const vtkIsopointArrayChoice& choice, const int* wholeExtent)
{
  // A hyper tree grid has cell data only.
  const bool hasPoints = vtkDataSet::SafeDownCast(leaf) != nullptr;
  vtkDataSetAttributes* const points =
    hasPoints ? leaf->GetAttributes(vtkDataObject::POINT) : nullptr;
  vtkDataSetAttributes* const cells = leaf->GetAttributes(vtkDataObject::CELL);
  vtkAbstractArray* const ofPoints =
    points && choice.MayBeOfPoints() ? choice.Find(points) : nullptr;
  vtkAbstractArray* const ofCells =
    !ofPoints && cells && (choice.MayBeOfCells() || !hasPoints) ? choice.Find(cells) : nullptr;
  if (!ofPoints && !ofCells)
  {
    this->PointsWithoutArray += elementCount(leaf);
    return;
  }
  vtkIsopointBlock block;
  block.Leaf = number;
  block.Attributes = ofPoints ? points : cells;
  block.Scalars = asScalars(ofPoints ? ofPoints : ofCells, leaf);
  vtkIsopointInputState state = vtkGetIsopointGeometryState(leaf);
  if (ofPoints)
  {
    block.Positions = vtkDataSet::SafeDownCast(leaf);
    block.Ghosts = vtkFindGhostPoints(block.Positions, wholeExtent);
    for (int i = 0; wholeExtent && i < 6; ++i)
    {
      state.push_back(static_cast<vtkMTimeType>(wholeExtent[i]));
    }
  }
  else
  {
    this->AddCenters(execution, leaf, state, block);
  }
  if (block.Scalars->GetNumberOfTuples() != block.GetNumberOfSamples())
  {
    std::ostringstream message;
    message << "The array \"" << (block.Scalars->GetName() ? block.Scalars->GetName() : "")
            << "\" has " << block.Scalars->GetNumberOfTuples() << " values for "
            << block.GetNumberOfSamples() << (ofPoints ? " points." : " cells.") << remedyFor(leaf);
    throw vtkIsopointUsageError(message.str());
  }
  state.push_back(ofPoints ? 0 : 1);
  vtkAppendIsopointArrayState(state, block.Scalars);
  if (block.GetNumberOfSamples() > 0)
  {
    this->Blocks.push_back(block);
    this->States.push_back(std::move(state));
  }
}

void vtkIsopointBlocks::AddCenters(const isopoint::Execution& execution, vtkDataObject* leaf,
  const vtkIsopointInputState& geometry, vtkIsopointBlock& block)
{
  if (auto* const trees = vtkHyperTreeGrid::SafeDownCast(leaf))
  {
    vtkFindLeafCenters(trees, block.Scalars->GetNumberOfTuples(), block);
    return;
  }
  auto* const dataSet = vtkDataSet::SafeDownCast(leaf);
  block.Ghosts = vtkFindGhostCells(dataSet);
  block.Positions = vtkMakeDualGrid(dataSet);
  if (!block.Positions)
  {
    Centers& kept = this->KeptCenters[block.Leaf];
    if (!kept.Points || kept.Geometry != geometry)
    {
      kept.Points = vtkComputeCellCenters(execution, dataSet);
      kept.Geometry = geometry;
    }
    vtkNew<vtkPolyData> centers;
    centers->SetPoints(kept.Points);
    block.Positions = centers;
  }
}

vtkIsopointInputState vtkIsopointBlocks::GetState(std::size_t begin, std::size_t end) const
{
  vtkIsopointInputState state;
  for (std::size_t i = begin; i < end; ++i)
  {
    state.insert(state.end(), this->States[i].begin(), this->States[i].end());
  }
  return state;
}

void vtkIsopointBlocks::ReleaseInput()
{
  this->Blocks.clear();
  this->States.clear();
  this->PointsWithoutArray = 0;
}

void vtkForEachIsopointLeaf(
  vtkDataObject* input, const std::function<void(vtkDataObject* leaf, std::size_t number)>& visit)
{
  auto* const composite = vtkCompositeDataSet::SafeDownCast(input);
  if (!composite)
  {
    visit(input, 0);
    return;
  }
  const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  std::size_t number = 0;
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    visit(iterator->GetCurrentDataObject(), number++);
  }
}
