// SPDX-License-Identifier: GPL-3.0-or-later
#include "Input/vtkIsopointBlocks.h"

#include "Common/vtkIsopointArrays.h"
#include "Core/Base/Execution.h"
#include "Input/vtkIsopointCellCenters.h"
#include "Input/vtkIsopointGhosts.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkHyperTreeGrid.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace
{

/// The names of all arrays but ghost marks, for an error message.
std::string arrayNames(vtkDataSetAttributes* attributes)
{
  std::string names;
  const int count = attributes ? attributes->GetNumberOfArrays() : 0;
  for (int i = 0; i < count; ++i)
  {
    const char* const found = attributes->GetArrayName(i);
    if (!vtkIsGhostArrayName(found))
    {
      names += std::string(names.empty() ? "" : ", ") + (found ? found : "(unnamed)");
    }
  }
  return names.empty() ? "none" : names;
}

/// The remedy for a wrong array to process: lists the arrays of a leaf.
std::string remedyFor(vtkDataObject* leaf, const vtkIsopointArrayChoice& choice)
{
  const std::string ofPoints = arrayNames(leaf->GetAttributes(vtkDataObject::POINT));
  const std::string ofCells = arrayNames(leaf->GetAttributes(vtkDataObject::CELL));
  if (ofPoints == "none" && ofCells == "none")
  {
    return " There are no arrays: load point or cell arrays in the reader.";
  }
  const std::string chosen = choice.GetRole() == vtkIsopointArrayChoice::Tuples
                               ? "n array (Scalar Array in ParaView, "
                               : " scalar array (Contour By in ParaView, ";
  return " Choose a" + chosen +
         "SetInputArrayToProcess() in VTK); the point arrays are: " + ofPoints +
         "; the cell arrays are: " + ofCells + ".";
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

/// The beginning of an error message.
std::string describe(vtkAbstractArray* array)
{
  return std::string("The array \"") + (array->GetName() ? array->GetName() : "") + "\" ";
}

/// @throws isopoint::UsageError unless the array is numeric and, for values, has one component
vtkDataArray* asNumbers(
  vtkAbstractArray* array, vtkDataObject* leaf, const vtkIsopointArrayChoice& choice)
{
  auto* const scalars = vtkDataArray::SafeDownCast(array);
  if (!scalars)
  {
    throw isopoint::UsageError(describe(array) + "holds no numbers." + remedyFor(leaf, choice));
  }
  if (choice.GetRole() == vtkIsopointArrayChoice::Values && scalars->GetNumberOfComponents() != 1)
  {
    throw isopoint::UsageError(describe(array) + "has " +
                               std::to_string(scalars->GetNumberOfComponents()) +
                               " components, but a scalar array has one. Compute a component"
                               " or the magnitude first, with vtkArrayCalculator or ParaView's"
                               " Calculator.");
  }
  return scalars;
}

vtkSmartPointer<vtkDataSet> asPolyData(vtkPoints* points)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  return data;
}

/// The ghost array of a leaf's points, or null.
vtkUnsignedCharArray* ownGhosts(vtkDataObject* leaf)
{
  auto* const dataSet = vtkDataSet::SafeDownCast(leaf);
  return dataSet ? vtkGetIsopointGhosts(dataSet->GetPointData(), dataSet->GetNumberOfPoints())
                 : nullptr;
}

/// The number of samples that ghost marks exclude.
vtkIdType countExcluded(
  const isopoint::Execution& execution, vtkUnsignedCharArray* ghosts, vtkIdType samples)
{
  constexpr std::size_t grain = 65536;
  std::atomic<vtkIdType> excluded{ 0 };
  isopoint::forRanges(execution, static_cast<std::size_t>(ghosts ? samples : 0), grain,
    [&](std::size_t begin, std::size_t end)
    {
      const unsigned char* const values = ghosts->GetPointer(0);
      excluded += std::count_if(values + begin, values + end,
        [](unsigned char value) { return (value & vtkIsopointBlock::Excluding) != 0; });
    });
  return excluded;
}

/// Whether attributes have an array of numbers besides ghost marks and ids.
bool hasNumbers(vtkDataSetAttributes* attributes)
{
  for (int i = 0; attributes && i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* const array = attributes->GetArray(i);
    const char* const name = array ? array->GetName() : nullptr;
    if (name && !vtkIsGhostArrayName(name) &&
        attributes->IsArrayAnAttribute(i) != vtkDataSetAttributes::GLOBALIDS)
    {
      return true;
    }
  }
  return false;
}

/// The number of values of an array or else of the first of the attributes.
vtkIdType countValues(vtkDataArray* array, vtkDataSetAttributes* attributes)
{
  return array ? array->GetNumberOfTuples() : attributes->GetNumberOfTuples();
}

} // namespace

vtkIdType vtkIsopointBlock::GetNumberOfSamples() const
{
  return this->Positions->GetNumberOfPoints();
}

vtkIsopointArrayChoice::vtkIsopointArrayChoice(vtkInformation* inputArray, Roles role)
  : Role(role)
  , Association(inputArray->Get(vtkDataObject::FIELD_ASSOCIATION()))
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

std::pair<vtkDataSetAttributes*, vtkAbstractArray*> vtkIsopointArrayChoice::FindIn(
  vtkDataObject* leaf) const
{
  // A hyper tree grid has cell data only.
  const bool hasPoints = vtkDataSet::SafeDownCast(leaf) != nullptr;
  vtkDataSetAttributes* const points =
    hasPoints ? leaf->GetAttributes(vtkDataObject::POINT) : nullptr;
  vtkDataSetAttributes* const cells = leaf->GetAttributes(vtkDataObject::CELL);
  if (this->Role == NoArray)
  {
    const bool areCells = !points || (!hasNumbers(points) && hasNumbers(cells));
    return { areCells ? cells : points, nullptr };
  }
  vtkAbstractArray* const ofPoints = points && this->MayBeOfPoints() ? this->Find(points) : nullptr;
  if (ofPoints)
  {
    return { points, ofPoints };
  }
  vtkAbstractArray* const ofCells =
    cells && (this->MayBeOfCells() || !hasPoints) ? this->Find(cells) : nullptr;
  return { ofCells ? cells : nullptr, ofCells };
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
  const std::vector<vtkDataObject*> leaves = vtkListIsopointLeaves(input);
  for (std::size_t number = 0; number < leaves.size(); ++number)
  {
    vtkDataObject* const leaf = leaves[number];
    if (elementCount(leaf) == 0)
    {
      this->Kept.erase(number);
      continue;
    }
    remedy = remedy.empty() ? remedyFor(leaf, choice) : remedy;
    this->AddLeaf(execution, leaf, number, choice, leaf == input ? wholeExtent : nullptr);
  }
  this->Kept.erase(this->Kept.lower_bound(leaves.size()), this->Kept.end());
  if (remedy.empty())
  {
    throw vtkIsopointNoSamplesError(
      std::string("The input has no points or cells. Connect a data set with ") +
      (choice.GetRole() == vtkIsopointArrayChoice::Values ? "a scalar array." : "points."));
  }
  if (this->Blocks.empty())
  {
    throw vtkIsopointNoSamplesError(choice.GetRole() == vtkIsopointArrayChoice::NoArray
                                      ? "The input has no samples. Connect a data set with points."
                                      : "The input has no " + choice.Describe() + "." + remedy);
  }
}

void vtkIsopointBlocks::AddLeaf(const isopoint::Execution& execution, vtkDataObject* leaf,
  std::size_t number, const vtkIsopointArrayChoice& choice, const int* wholeExtent)
{
  const auto [attributes, chosen] = choice.FindIn(leaf);
  if (!attributes)
  {
    this->PointsWithoutArray += elementCount(leaf);
    this->Kept.erase(number);
    return;
  }
  vtkDataArray* const array = chosen ? asNumbers(chosen, leaf, choice) : nullptr;
  const bool areValues = choice.GetRole() == vtkIsopointArrayChoice::Values;
  const bool areOfPoints = attributes != leaf->GetAttributes(vtkDataObject::CELL);
  vtkIsopointBlock block;
  block.Leaf = number;
  block.Attributes = attributes;
  block.Scalars = areValues ? array : nullptr;

  vtkIsopointInputState state = vtkGetIsopointGeometryState(execution, leaf);
  state.push_back(areOfPoints ? 0 : 1);
  for (int i = 0; areOfPoints && wholeExtent && i < 6; ++i)
  {
    state.push_back(static_cast<vtkMTimeType>(wholeExtent[i]));
  }
  if (vtkHyperTreeGrid::SafeDownCast(leaf)) // the ids are those of the values
  {
    state.push_back(static_cast<vtkMTimeType>(countValues(array, attributes)));
  }
  Computed& computed = this->Kept[number];
  if (computed.Of != state)
  {
    computed = Computed();
    Compute(execution, leaf, block, countValues(array, attributes), wholeExtent, computed);
    computed.Of = state;
  }
  block.Positions = areOfPoints ? vtkDataSet::SafeDownCast(leaf) : computed.Centers.Get();
  block.Ghosts = computed.HasOwnGhosts ? ownGhosts(leaf) : computed.Ghosts.Get();
  block.NumberOfExcluded = computed.NumberOfExcluded;
  block.NumberOfUnusedIds = computed.NumberOfUnusedIds;

  if (array && array->GetNumberOfTuples() != block.GetNumberOfSamples())
  {
    throw isopoint::UsageError(describe(array) + "has " +
                               std::to_string(array->GetNumberOfTuples()) + " values for " +
                               std::to_string(block.GetNumberOfSamples()) +
                               (areOfPoints ? " points." : " cells.") + remedyFor(leaf, choice));
  }
  state.push_back(areValues ? array->GetMTime() : 0);
  if (block.GetNumberOfSamples() > 0)
  {
    this->Blocks.push_back(block);
    this->States.push_back(std::move(state));
  }
}

void vtkIsopointBlocks::Compute(const isopoint::Execution& execution, vtkDataObject* leaf,
  const vtkIsopointBlock& block, vtkIdType samples, const int* wholeExtent, Computed& computed)
{
  auto* const dataSet = vtkDataSet::SafeDownCast(leaf);
  if (auto* const trees = vtkHyperTreeGrid::SafeDownCast(leaf))
  {
    const vtkIsopointLeafCenters leaves = vtkFindLeafCenters(execution, trees, samples);
    computed.Centers = asPolyData(leaves.Points);
    computed.Ghosts = leaves.Ghosts;
    computed.NumberOfUnusedIds = leaves.NumberOfUnusedIds;
  }
  else if (block.Attributes == dataSet->GetPointData())
  {
    samples = dataSet->GetNumberOfPoints();
    computed.Ghosts = vtkFindGhostPoints(execution, dataSet, wholeExtent);
  }
  else
  {
    samples = dataSet->GetNumberOfCells();
    computed.Ghosts = vtkFindGhostCells(execution, dataSet);
    computed.Centers = vtkMakeDualGrid(dataSet);
    if (!computed.Centers)
    {
      computed.Centers = asPolyData(vtkComputeCellCenters(execution, dataSet));
    }
  }
  computed.HasOwnGhosts = computed.Ghosts && computed.Ghosts == ownGhosts(leaf);
  computed.NumberOfExcluded = countExcluded(execution, computed.Ghosts, samples);
  if (computed.HasOwnGhosts)
  {
    computed.Ghosts = nullptr; // arrays of the input are not kept
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

std::vector<vtkDataObject*> vtkListIsopointLeaves(vtkDataObject* input)
{
  auto* const composite = vtkCompositeDataSet::SafeDownCast(input);
  if (!composite)
  {
    return { input };
  }
  std::vector<vtkDataObject*> leaves;
  const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    leaves.push_back(iterator->GetCurrentDataObject());
  }
  return leaves;
}
