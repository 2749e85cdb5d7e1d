// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointBlocks.h"

#include "Isopoint/Base/Execution.h"
#include "vtkIsopointCellCenters.h"
#include "vtkIsopointCompatibility.h"
#include "vtkIsopointGhosts.h"

#include "vtkBitArray.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkExplicitStructuredGrid.h"
#include "vtkHyperTree.h"
#include "vtkHyperTreeGrid.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkUnstructuredGridBase.h"

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <utility>

namespace
{

void add(vtkIsopointState& state, vtkObject* object)
{
  state.push_back(object ? object->GetMTime() : 0);
}

void add(vtkIsopointState& state, vtkCellArray* cells)
{
  state.push_back(cells ? cells->GetMTime() : 0);
  add(state, cells ? cells->GetConnectivityArray() : nullptr);
  add(state, cells ? cells->GetOffsetsArray() : nullptr);
}

/// Adds what an array of flags holds. Blanking a point or a cell and masking a node change these in
/// place, and VTK counts that as no modification.
template <class TArray>
void addFlags(vtkIsopointState& state, TArray* flags)
{
  add(state, static_cast<vtkObject*>(flags));
  std::uint64_t hash = 14695981039346656037u; // FNV-1a: one changed flag always changes it
  const vtkIdType count = flags ? flags->GetNumberOfValues() : 0;
  for (vtkIdType i = 0; i < count; ++i)
  {
    hash = (hash ^ static_cast<unsigned char>(flags->GetValue(i))) * 1099511628211u;
  }
  state.push_back(static_cast<vtkMTimeType>(hash));
}

void addGhosts(vtkIsopointState& state, vtkDataSetAttributes* attributes)
{
  addFlags(state,
    vtkUnsignedCharArray::SafeDownCast(
      attributes ? attributes->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()) : nullptr));
}

void addGrid(vtkIsopointState& state, vtkUnstructuredGrid* grid)
{
  add(state, grid->GetCells());
  add(state, grid->GetCellTypesArray());
  const auto faces = vtkGetFacesOfPolyhedra(grid);
  add(state, faces.first);
  add(state, faces.second);
}

void addCoordinates(vtkIsopointState& state, vtkDataArray* x, vtkDataArray* y, vtkDataArray* z)
{
  add(state, x);
  add(state, y);
  add(state, z);
}

/// A tree that is subdivided or replaced leaves the grid's modification time as it is.
void addTrees(vtkIsopointState& state, vtkHyperTreeGrid* trees)
{
  addCoordinates(
    state, trees->GetXCoordinates(), trees->GetYCoordinates(), trees->GetZCoordinates());
  addFlags(state, trees->GetMask());
  vtkHyperTreeGrid::vtkHyperTreeGridIterator iterator;
  trees->InitializeTreeIterator(iterator);
  while (vtkHyperTree* const tree = iterator.GetNextTree())
  {
    add(state, tree);
    for (const vtkIdType number : { tree->GetTreeIndex(), tree->GetNumberOfVertices(),
           tree->GetGlobalIndexFromLocal(0), tree->GetGlobalNodeIndexMax() })
    {
      state.push_back(static_cast<vtkMTimeType>(number));
    }
  }
}

/// What the positions of a leaf's points and cells, and whether they take part, depend on.
vtkIsopointState geometryOf(vtkDataObject* leaf)
{
  vtkIsopointState state{ leaf->vtkObject::GetMTime() };
  if (auto* const pointSet = vtkPointSet::SafeDownCast(leaf))
  {
    add(state, pointSet->GetPoints());
    add(state, pointSet->GetPoints() ? pointSet->GetPoints()->GetData() : nullptr);
  }
  if (auto* const grid = vtkUnstructuredGrid::SafeDownCast(leaf))
  {
    addGrid(state, grid);
  }
  else if (vtkUnstructuredGridBase::SafeDownCast(leaf))
  {
    // Its cells are in memory of another kind, of which it alone knows when it changed.
    add(state, static_cast<vtkObject*>(leaf));
  }
  if (auto* const grid = vtkExplicitStructuredGrid::SafeDownCast(leaf))
  {
    add(state, grid->GetCells());
  }
  if (auto* const polyData = vtkPolyData::SafeDownCast(leaf))
  {
    add(state, polyData->GetVerts());
    add(state, polyData->GetLines());
    add(state, polyData->GetPolys());
    add(state, polyData->GetStrips());
  }
  if (auto* const image = vtkImageData::SafeDownCast(leaf))
  {
    add(state, image->GetDirectionMatrix());
  }
  if (auto* const grid = vtkRectilinearGrid::SafeDownCast(leaf))
  {
    addCoordinates(
      state, grid->GetXCoordinates(), grid->GetYCoordinates(), grid->GetZCoordinates());
  }
  if (auto* const trees = vtkHyperTreeGrid::SafeDownCast(leaf))
  {
    addTrees(state, trees);
  }
  addGhosts(state, leaf->GetAttributes(vtkDataObject::POINT));
  addGhosts(state, leaf->GetAttributes(vtkDataObject::CELL));
  return state;
}

/// The names of arrays, for an error message.
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

/// What a leaf offers, for an error message.
std::string offerOf(vtkDataObject* leaf)
{
  return " Choose one with SetInputArrayToProcess(); the point arrays are: " +
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

/// @throws vtkUnusableIsopointInput if it is none
vtkDataArray* asScalars(vtkAbstractArray* array, vtkDataObject* leaf)
{
  const std::string described =
    std::string("The array \"") + (array->GetName() ? array->GetName() : "") + "\" ";
  auto* const scalars = vtkDataArray::SafeDownCast(array);
  if (!scalars)
  {
    throw vtkUnusableIsopointInput(described + "holds no numbers." + offerOf(leaf));
  }
  if (scalars->GetNumberOfComponents() != 1)
  {
    throw vtkUnusableIsopointInput(described + "has " +
                                   std::to_string(scalars->GetNumberOfComponents()) +
                                   " components where a scalar is needed. Take one component or the"
                                   " magnitude first (vtkArrayCalculator, or ParaView's"
                                   " Calculator).");
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
  // ParaView passes an empty name where nothing was chosen.
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

std::string vtkIsopointArrayChoice::DescribeMissing() const
{
  const std::string element = !this->MayBeOfPoints() ? "cell"
                              : this->MayBeOfCells() ? "point or cell"
                                                     : "point";
  return this->Name.empty()
           ? "The input has no active " + element + " scalars."
           : "The input has no " + element + " array named \"" + this->Name + "\".";
}

void vtkIsopointBlocks::Collect(
  const isopoint::Execution& execution, vtkDataObject* input, const vtkIsopointArrayChoice& choice)
{
  this->ReleaseInput();
  std::string offer;
  vtkForEachIsopointLeaf(input,
    [&](vtkDataObject* leaf, std::size_t number)
    {
      this->LeafCount = number + 1;
      if (elementCount(leaf) > 0)
      {
        offer = offer.empty() ? offerOf(leaf) : offer;
        this->AddLeaf(execution, leaf, number, choice);
      }
    });
  this->KeptCenters.erase(this->KeptCenters.lower_bound(this->LeafCount), this->KeptCenters.end());
  if (offer.empty())
  {
    throw vtkUnusableIsopointInput(
      "The input has no points. Connect a data set with points and a scalar array.");
  }
  if (this->Blocks.empty())
  {
    throw vtkUnusableIsopointInput(choice.DescribeMissing() + offer);
  }
}

void vtkIsopointBlocks::AddLeaf(const isopoint::Execution& execution, vtkDataObject* leaf,
  std::size_t number, const vtkIsopointArrayChoice& choice)
{
  // A hyper tree grid has cells alone.
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
  vtkIsopointState state = geometryOf(leaf);
  state.push_back(ofPoints ? 0 : 1);
  this->AddPositions(execution, leaf, ofCells != nullptr, block);
  if (block.Scalars->GetNumberOfTuples() != block.GetNumberOfSamples())
  {
    std::ostringstream message;
    message << "The array \"" << (block.Scalars->GetName() ? block.Scalars->GetName() : "")
            << "\" has " << block.Scalars->GetNumberOfTuples() << " values for "
            << block.GetNumberOfSamples() << (ofPoints ? " points." : " cells.") << offerOf(leaf);
    throw vtkUnusableIsopointInput(message.str());
  }
  add(state, block.Scalars);
  if (block.GetNumberOfSamples() > 0)
  {
    this->Blocks.push_back(block);
    this->States.push_back(std::move(state));
  }
}

void vtkIsopointBlocks::AddPositions(const isopoint::Execution& execution, vtkDataObject* leaf,
  bool isOfCells, vtkIsopointBlock& block)
{
  if (auto* const trees = vtkHyperTreeGrid::SafeDownCast(leaf))
  {
    vtkFindLeafCenters(trees, block.Scalars->GetNumberOfTuples(), block);
    return;
  }
  auto* const dataSet = vtkDataSet::SafeDownCast(leaf);
  if (!isOfCells)
  {
    block.Positions = dataSet;
    block.Ghosts = vtkFindGhostPoints(dataSet);
    return;
  }
  block.Ghosts = vtkFindGhostCells(dataSet);
  block.Positions = vtkMakeDualGrid(dataSet);
  if (!block.Positions)
  {
    Centers& kept = this->KeptCenters[block.Leaf];
    vtkIsopointState geometry = geometryOf(leaf);
    if (!kept.Points || kept.Geometry != geometry)
    {
      kept.Points = vtkComputeCellCenters(execution, dataSet);
      kept.Geometry = std::move(geometry);
    }
    vtkNew<vtkPolyData> centers;
    centers->SetPoints(kept.Points);
    block.Positions = centers;
  }
}

vtkIsopointState vtkIsopointBlocks::GetState(std::size_t begin, std::size_t end) const
{
  vtkIsopointState state;
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
  this->LeafCount = 0;
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
