// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatRepresentation.h"

#include "vtkActor.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataAssembly.h"
#include "vtkDataAssemblyUtilities.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIsopointSplatMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPVRenderView.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkScalarsToColors.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <set>

vtkStandardNewMacro(vtkIsopointSplatRepresentation);

namespace
{

/// The points of a data set; in double precision where it computes them.
/// @throws std::bad_alloc
vtkSmartPointer<vtkPoints> pointsOf(vtkDataSet* data)
{
  if (vtkPointSet* const pointSet = vtkPointSet::SafeDownCast(data))
  {
    return pointSet->GetPoints();
  }
  // VTK's arrays end the program where they find no memory.
  const vtkIdType count = data->GetNumberOfPoints();
  auto* const positions =
    static_cast<double*>(std::malloc(3 * sizeof(double) * static_cast<std::size_t>(count)));
  if (!positions)
  {
    throw std::bad_alloc();
  }
  for (vtkIdType i = 0; i < count; ++i)
  {
    data->GetPoint(i, positions + 3 * i);
  }
  vtkNew<vtkDoubleArray> array;
  array->SetNumberOfComponents(3);
  array->SetArray(positions, 3 * count, 0, vtkAbstractArray::VTK_DATA_ARRAY_FREE);
  const auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(array);
  return points;
}

/// The points of a data set with their arrays; null where there are none.
/// @throws std::bad_alloc
vtkSmartPointer<vtkPolyData> splatsOf(vtkDataObject* object)
{
  vtkDataSet* const data = vtkDataSet::SafeDownCast(object);
  if (!data || data->GetNumberOfPoints() == 0)
  {
    return nullptr;
  }
  const auto splats = vtkSmartPointer<vtkPolyData>::New();
  if (vtkPolyData* const polyData = vtkPolyData::SafeDownCast(data))
  {
    // Vertex cells are kept, since they can be selected.
    splats->ShallowCopy(polyData);
    return splats;
  }
  splats->SetPoints(pointsOf(data));
  splats->GetPointData()->ShallowCopy(data->GetPointData());
  splats->SetFieldData(data->GetFieldData());
  return splats;
}

/// The same for each block of composite data. Other data become one block: the client of a server,
/// which has no data, expects composite data.
/// @throws std::bad_alloc
vtkSmartPointer<vtkDataObject> compositeSplatsOf(vtkDataObject* object)
{
  vtkCompositeDataSet* const input = vtkCompositeDataSet::SafeDownCast(object);
  if (!input)
  {
    const auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    blocks->SetBlock(0, splatsOf(object));
    return blocks;
  }
  const auto output = vtkSmartPointer<vtkCompositeDataSet>::Take(input->NewInstance());
  output->CopyStructure(input);
  const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(input->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    output->SetDataSet(iterator, splatsOf(iterator->GetCurrentDataObject()));
  }
  return output;
}

} // namespace

//------------------------------------------------------------------------------
vtkIsopointSplatRepresentation::vtkIsopointSplatRepresentation()
  : Property(this->Actor->GetProperty())
{
  this->Actor->SetMapper(this->Mapper);
  this->Mapper->SetCompositeDataDisplayAttributes(this->BlockAttributes);
  this->SetMapScalars(1);
}

//------------------------------------------------------------------------------
vtkIsopointSplatRepresentation::~vtkIsopointSplatRepresentation() = default;

//------------------------------------------------------------------------------
int vtkIsopointSplatRepresentation::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  // The client of a server has no data.
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkIsopointSplatRepresentation::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const int result = this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
  vtkMultiProcessController* const ranks = vtkMultiProcessController::GetGlobalController();
  auto* const levels = vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS();
  for (int i = 0; ranks && ranks->GetNumberOfProcesses() > 1 &&
                  i < inputVector[0]->GetNumberOfInformationObjects();
       ++i)
  {
    vtkInformation* const info = inputVector[0]->GetInformationObject(i);
    info->Set(levels, std::max(info->Has(levels) ? info->Get(levels) : 0, 1));
  }
  return result;
}

//------------------------------------------------------------------------------
int vtkIsopointSplatRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->Splats = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  if (inputVector[0]->GetNumberOfInformationObjects() > 0)
  {
    vtkDataObject* const input = vtkDataObject::GetData(inputVector[0], 0);
    try
    {
      this->Splats = compositeSplatsOf(input);
    }
    catch (const std::bad_alloc&)
    {
      vtkErrorMacro(
        "Out of memory: the splats of "
        << input->GetNumberOfElements(vtkDataObject::POINT)
        << " points are not shown. Close other data, or pass fewer points, for example through "
           "Extract Subset.");
    }
  }
  return this->Superclass::RequestData(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
bool vtkIsopointSplatRepresentation::AddToView(vtkView* view)
{
  vtkPVRenderView* const renderView = vtkPVRenderView::SafeDownCast(view);
  if (!renderView)
  {
    return false;
  }
  renderView->GetRenderer()->AddActor(this->Actor);
  renderView->RegisterPropForHardwareSelection(this, this->Actor);
  return this->Superclass::AddToView(view);
}

//------------------------------------------------------------------------------
bool vtkIsopointSplatRepresentation::RemoveFromView(vtkView* view)
{
  vtkPVRenderView* const renderView = vtkPVRenderView::SafeDownCast(view);
  if (!renderView)
  {
    return false;
  }
  renderView->GetRenderer()->RemoveActor(this->Actor);
  renderView->UnRegisterPropForHardwareSelection(this, this->Actor);
  return this->Superclass::RemoveFromView(view);
}

//------------------------------------------------------------------------------
int vtkIsopointSplatRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* requestType, vtkInformation* inInfo, vtkInformation* outInfo)
{
  if (!this->Superclass::ProcessViewRequest(requestType, inInfo, outInfo))
  {
    return 0;
  }
  if (requestType == vtkPVView::REQUEST_UPDATE())
  {
    this->ProvideData(inInfo, outInfo);
  }
  else if (requestType == vtkPVView::REQUEST_RENDER())
  {
    const bool isLowerDetail = inInfo->Has(vtkPVRenderView::USE_LOD()) != 0;
    this->Mapper->SetStride(isLowerDetail ? this->LODStride : 1);
    // Where one process renders the points of all ranks, it has those of which the ghosts are
    // duplicates.
    auto* const view = vtkPVRenderView::SafeDownCast(inInfo->Get(vtkPVView::VIEW()));
    this->Mapper->SetBlendGhosts(
      view && (isLowerDetail ? view->GetUseDistributedRenderingForLODRender()
                             : view->GetUseDistributedRenderingForRender()));
    vtkDataObject* const splats = vtkPVView::GetDeliveredPiece(inInfo, this);
    this->UpdateBlockAttributes(splats);
    this->Mapper->SetInputDataObject(splats);
    this->UpdateColoring();
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkIsopointSplatRepresentation::ProvideData(vtkInformation* inInfo, vtkInformation* outInfo)
{
  double bounds[6];
  this->UpdateBlockAttributes(this->Splats);
  this->Mapper->SetInputDataObject(this->Splats);
  this->Mapper->GetBounds(bounds);
  vtkNew<vtkMatrix4x4> matrix;
  this->Actor->GetMatrix(matrix);
  vtkPVRenderView::SetPiece(inInfo, this, this->Splats);
  vtkPVRenderView::SetGeometryBounds(inInfo, this, bounds, matrix);
  if (this->MayBeTranslucent())
  {
    outInfo->Set(vtkPVRenderView::NEED_ORDERED_COMPOSITING(), 1);
  }
  vtkPVRenderView::SetOrderedCompositingConfiguration(inInfo, this,
    vtkPVRenderView::DATA_IS_REDISTRIBUTABLE | vtkPVRenderView::USE_DATA_FOR_LOAD_BALANCING);
}

//------------------------------------------------------------------------------
bool vtkIsopointSplatRepresentation::MayBeTranslucent()
{
  vtkScalarsToColors* const table = this->Mapper->GetLookupTable();
  const bool hasOpaqueColors =
    !this->Mapper->GetScalarVisibility() ||
    (this->Mapper->GetColorMode() != VTK_COLOR_MODE_DIRECT_SCALARS && table && table->IsOpaque());
  return this->Property->GetOpacity() < 1.0 || !hasOpaqueColors;
}

//------------------------------------------------------------------------------
void vtkIsopointSplatRepresentation::UpdateColoring()
{
  vtkInformation* const info = this->GetInputArrayInformation(0);
  const char* const name =
    info && info->Has(vtkDataObject::FIELD_ASSOCIATION()) && info->Has(vtkDataObject::FIELD_NAME())
      ? info->Get(vtkDataObject::FIELD_NAME())
      : nullptr;
  if (!name || !name[0])
  {
    this->Mapper->SetScalarVisibility(0);
    this->Mapper->SelectColorArray(static_cast<const char*>(nullptr));
    return;
  }
  this->Mapper->SetScalarVisibility(1);
  this->Mapper->SelectColorArray(name);
  this->Mapper->SetUseLookupTableScalarRange(1);
  switch (info->Get(vtkDataObject::FIELD_ASSOCIATION()))
  {
    case vtkDataObject::FIELD_ASSOCIATION_CELLS:
      this->Mapper->SetScalarMode(VTK_SCALAR_MODE_USE_CELL_FIELD_DATA);
      break;
    case vtkDataObject::FIELD_ASSOCIATION_NONE:
      this->Mapper->SetScalarMode(VTK_SCALAR_MODE_USE_FIELD_DATA);
      this->Mapper->SetFieldDataTupleId(0);
      break;
    default:
      this->Mapper->SetScalarMode(VTK_SCALAR_MODE_USE_POINT_FIELD_DATA);
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatRepresentation::UpdateBlockAttributes(vtkDataObject* splats)
{
  vtkDataObjectTree* const tree = vtkDataObjectTree::SafeDownCast(splats);
  this->BlockAttributes->RemoveBlockVisibilities();
  this->BlockAttributes->RemoveBlockColors();
  const bool showsAll = this->BlockSelectors == std::vector<std::string>{ "/" };
  vtkNew<vtkDataAssembly> hierarchy;
  if (!tree || (showsAll && this->BlockColors.empty()) ||
      !vtkDataAssemblyUtilities::GenerateHierarchy(tree, hierarchy))
  {
    return;
  }
  const auto forBlocks = [&](const std::vector<std::string>& selectors, const auto& apply)
  {
    const std::vector<unsigned int> ids =
      vtkDataAssemblyUtilities::GetSelectedCompositeIds(selectors, hierarchy);
    const std::set<unsigned int> chosen(ids.begin(), ids.end());
    const auto iterator = vtkSmartPointer<vtkDataObjectTreeIterator>::Take(tree->NewTreeIterator());
    iterator->VisitOnlyLeavesOff();
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      if (chosen.count(iterator->GetCurrentFlatIndex()) > 0)
      {
        apply(iterator->GetCurrentDataObject());
      }
    }
  };
  if (!showsAll)
  {
    this->BlockAttributes->SetBlockVisibility(tree, false);
    forBlocks(this->BlockSelectors,
      [this](vtkDataObject* block) { this->BlockAttributes->SetBlockVisibility(block, true); });
  }
  for (const auto& color : this->BlockColors)
  {
    forBlocks({ color.first }, [&](vtkDataObject* block)
      { this->BlockAttributes->SetBlockColor(block, color.second.data()); });
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatRepresentation::AddBlockSelector(const char* selector)
{
  if (selector)
  {
    this->BlockSelectors.emplace_back(selector);
    this->MarkModified();
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatRepresentation::RemoveAllBlockSelectors()
{
  this->BlockSelectors.clear();
  this->MarkModified();
}

//------------------------------------------------------------------------------
void vtkIsopointSplatRepresentation::SetBlockColor(
  const char* selector, double red, double green, double blue)
{
  if (selector)
  {
    this->BlockColors.emplace_back(selector, std::array<double, 3>{ red, green, blue });
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatRepresentation::RemoveAllBlockColors()
{
  this->BlockColors.clear();
}

//------------------------------------------------------------------------------
void vtkIsopointSplatRepresentation::SetVisibility(bool visible)
{
  this->Actor->SetVisibility(visible);
  this->Superclass::SetVisibility(visible);
}

//------------------------------------------------------------------------------
void vtkIsopointSplatRepresentation::SetMapScalars(int mapsScalars)
{
  this->Mapper->SetColorMode(
    mapsScalars ? VTK_COLOR_MODE_MAP_SCALARS : VTK_COLOR_MODE_DIRECT_SCALARS);
}

//------------------------------------------------------------------------------
void vtkIsopointSplatRepresentation::SetBackfaceRepresentation(int representation)
{
  this->Property->SetBackfaceCulling(representation == 401);
  this->Property->SetFrontfaceCulling(representation == 402);
}

//------------------------------------------------------------------------------
#define vtkForwardMacro(object, method, type)                                                      \
  void vtkIsopointSplatRepresentation::method(type value)                                          \
  {                                                                                                \
    this->object->method(value);                                                                   \
  }
#define vtkForward3Macro(object, method)                                                           \
  void vtkIsopointSplatRepresentation::method(double x, double y, double z)                        \
  {                                                                                                \
    this->object->method(x, y, z);                                                                 \
  }

vtkForwardMacro(Mapper, SetRadiusArrayName, const char*);
vtkForwardMacro(Mapper, SetRadius, double);
vtkForwardMacro(Mapper, SetRadiusScale, double);
vtkForwardMacro(Mapper, SetBlendDepth, double);
vtkForwardMacro(Mapper, SetShape, int);
vtkForwardMacro(Mapper, SetMaximumNumberOfLayers, int);
vtkForwardMacro(Mapper, SetLookupTable, vtkScalarsToColors*);
vtkForwardMacro(Mapper, SetInterpolateScalarsBeforeMapping, int);
vtkForward3Macro(Actor, SetOrientation);
vtkForward3Macro(Actor, SetOrigin);
vtkForward3Macro(Actor, SetPosition);
vtkForward3Macro(Actor, SetScale);
vtkForwardMacro(Actor, SetPickable, int);
vtkForward3Macro(Property, SetAmbientColor);
vtkForward3Macro(Property, SetDiffuseColor);
vtkForward3Macro(Property, SetSpecularColor);
vtkForward3Macro(Property, SetEdgeTint);
vtkForward3Macro(Property, SetCoatColor);
vtkForwardMacro(Property, SetAmbient, double);
vtkForwardMacro(Property, SetDiffuse, double);
vtkForwardMacro(Property, SetSpecular, double);
vtkForwardMacro(Property, SetSpecularPower, double);
vtkForwardMacro(Property, SetOpacity, double);
vtkForwardMacro(Property, SetInterpolation, int);
vtkForwardMacro(Property, SetMetallic, double);
vtkForwardMacro(Property, SetRoughness, double);
vtkForwardMacro(Property, SetBaseIOR, double);
vtkForwardMacro(Property, SetCoatIOR, double);
vtkForwardMacro(Property, SetCoatRoughness, double);
vtkForwardMacro(Property, SetCoatStrength, double);

//------------------------------------------------------------------------------
void vtkIsopointSplatRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LODStride: " << this->LODStride << "\n";
  os << indent << "Mapper:\n";
  this->Mapper->PrintSelf(os, indent.GetNextIndent());
}
