// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatMapperInternals.h"

#include "vtkIsopointSplatMemory.h"
#include "vtkIsopointSplatOpenGL.h"

#include "vtkActor.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkFloatArray.h"
#include "vtkHardwareSelector.h"
#include "vtkImageData.h"
#include "vtkOpenGLActor.h"
#include "vtkOpenGLCamera.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLTexture.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkScalarsToColors.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <sstream>

namespace
{

vtkDataArray* arrayOf(vtkPolyData* data, const char* name)
{
  return name && name[0] ? data->GetPointData()->GetArray(name) : nullptr;
}

const char* orNothing(const char* name)
{
  return name ? name : "";
}

/// Colors of points from those of points, of vertex cells or of a tuple of the field data.
/// @throws std::bad_alloc
vtkSmartPointer<vtkUnsignedCharArray> colorsOfPoints(
  vtkIsopointSplatBlocks::Block& block, vtkUnsignedCharArray* colors, int cellFlag, vtkIdType tuple)
{
  if (cellFlag == 0)
  {
    return colors;
  }
  const auto result = vtkSmartPointer<vtkUnsignedCharArray>::New();
  result->SetNumberOfComponents(4);
  vtkIsopointSplatMemory::Allocate(result, block.Data->GetNumberOfPoints());
  for (vtkIdType i = 0; i < result->GetNumberOfTuples(); ++i)
  {
    const vtkIdType source =
      cellFlag == 2 && tuple >= 0 ? tuple : vtkIsopointSplatBlocks::CellOfPoint(block, i);
    unsigned char color[4] = { 255, 255, 255, 255 };
    if (source >= 0 && source < colors->GetNumberOfTuples())
    {
      colors->GetTypedTuple(source, color);
    }
    result->SetTypedTuple(i, color);
  }
  return result;
}

bool hasTranslucent(vtkUnsignedCharArray* colors)
{
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    if (colors->GetTypedComponent(i, 3) < 255)
    {
      return true;
    }
  }
  return false;
}

/// Sets a variable for the duration of a scope.
class ScopedValue
{
public:
  ScopedValue(vtkTypeBool& variable, vtkTypeBool value)
    : Variable(variable)
    , Former(variable)
  {
    variable = value;
  }
  ~ScopedValue() { this->Variable = this->Former; }
  ScopedValue(const ScopedValue&) = delete;
  ScopedValue& operator=(const ScopedValue&) = delete;

private:
  vtkTypeBool& Variable;
  const vtkTypeBool Former;
};

} // namespace

//------------------------------------------------------------------------------
bool vtkIsopointSplatMapper::Internals::Try(
  vtkIsopointSplatMapper* mapper, const std::function<void()>& function)
{
  try
  {
    function();
    return true;
  }
  catch (const std::bad_alloc&)
  {
    this->HasLackedMemory = true;
    this->ReportOutOfMemory(mapper);
    return false;
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::Internals::ReportOutOfMemory(vtkIsopointSplatMapper* mapper)
try
{
  vtkDataObject* const input = mapper->GetInputDataObject(0, 0);
  vtkMTimeType change = input ? input->GetMTime() : 0;
  vtkIdType points = 0;
  for (const vtkIsopointSplatLeaf& leaf : vtkIsopointSplatLeaves(input, this->BlockAttributes))
  {
    change = std::max(change, leaf.Data->GetMTime());
    points += leaf.Data->GetNumberOfPoints();
  }
  if (this->OutOfMemory != change)
  {
    this->OutOfMemory = change;
    vtkErrorWithObjectMacro(mapper, "Out of memory: the splats of "
                                      << points << " points are not drawn. Close other data, pass "
                                      << "fewer points, or make the window smaller.");
  }
}
catch (const std::bad_alloc&)
{
  // There is no memory for the message either.
}

//------------------------------------------------------------------------------
bool vtkIsopointSplatMapper::Internals::Prepare(
  vtkIsopointSplatMapper* mapper, vtkHardwareSelector* selector)
{
  const auto prepare = [&]
  {
    this->Blocks.SetInput(mapper->GetInputDataObject(0, 0), this->BlockAttributes);
    this->UpdateGeometry(mapper);
    this->UpdateColors(mapper);
    if (selector && selector->GetFieldAssociation() == vtkDataObject::FIELD_ASSOCIATION_CELLS)
    {
      for (const auto& block : this->Blocks.Get())
      {
        vtkIsopointSplatBlocks::CellOfPoint(*block, 0);
      }
    }
  };
  if (!this->Try(mapper, prepare))
  {
    this->Blocks.ReleaseGraphicsResources();
    return false;
  }
  return !this->Blocks.IsEmpty();
}

//------------------------------------------------------------------------------
vtkDataArray* vtkIsopointSplatMapper::Internals::Usable(
  vtkIsopointSplatMapper* mapper, vtkPolyData* data, vtkDataArray* array, int components)
{
  if (!array || array->GetNumberOfComponents() != components)
  {
    return nullptr;
  }
  if (array->GetNumberOfTuples() >= data->GetNumberOfPoints())
  {
    return array;
  }
  if (!this->WarnedOfShortArrays)
  {
    vtkWarningWithObjectMacro(
      mapper, "The array \"" << orNothing(array->GetName()) << "\" is ignored: it has "
                             << array->GetNumberOfTuples() << " tuples for "
                             << data->GetNumberOfPoints() << " points. Give it one for each.");
    this->WarnedOfShortArrays = true;
  }
  return nullptr;
}

//------------------------------------------------------------------------------
vtkIsopointSplatBuffers::Shape vtkIsopointSplatMapper::Internals::ShapeOf(
  vtkIsopointSplatMapper* mapper, vtkPolyData* data)
{
  const auto usable = [&](vtkDataArray* array, int components)
  { return this->Usable(mapper, data, array, components); };
  vtkIsopointSplatBuffers::Shape shape;
  shape.Normals = usable(data->GetPointData()->GetNormals(), 3);
  shape.Radii = usable(arrayOf(data, mapper->RadiusArrayName), 1);
  if (!shape.Radii)
  {
    shape.Radius = mapper->Radius > 0.0
                     ? mapper->Radius
                     : vtkIsopointSplatBounds::AutomaticRadius(data->GetPoints());
  }
  if (mapper->Shape == vtkIsopointSplatMapper::ELLIPSE)
  {
    shape.Axis1 = usable(arrayOf(data, mapper->SplatAxis1ArrayName), 3);
    shape.Axis2 = usable(arrayOf(data, mapper->SplatAxis2ArrayName), 3);
  }
  vtkDataArray* const clips = arrayOf(data, mapper->SplatClipArrayName);
  if (clips && (clips->GetDataType() == VTK_FLOAT || clips->GetDataType() == VTK_DOUBLE))
  {
    shape.Clips = usable(clips, clips->GetNumberOfComponents() == 4 ? 4 : 5);
  }
  return shape;
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::Internals::UpdateGeometry(vtkIsopointSplatMapper* mapper)
{
  for (const auto& block : this->Blocks.Get())
  {
    std::ostringstream state;
    state << block->Data->GetMTime() << '\n'
          << orNothing(mapper->RadiusArrayName) << '\n'
          << orNothing(mapper->SplatAxis1ArrayName) << '\n'
          << orNothing(mapper->SplatAxis2ArrayName) << '\n'
          << orNothing(mapper->SplatClipArrayName) << '\n'
          << mapper->Shape << '\n'
          << std::hexfloat << mapper->Radius;
    if (block->GeometryState != state.str())
    {
      block->GeometryState.clear();
      this->UpdateGeometry(mapper, *block);
      block->GeometryState = state.str();
    }
    block->Buffers.SetStride(mapper->Stride);
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::Internals::UpdateGeometry(
  vtkIsopointSplatMapper* mapper, vtkIsopointSplatBlocks::Block& block)
{
  block.ColorState.clear();
  block.CellOfPoint.clear();
  block.Version = ++this->LastVersion;
  const vtkIsopointSplatBuffers::Shape shape = this->ShapeOf(mapper, block.Data);
  if (!shape.Normals && !this->WarnedOfNormals)
  {
    vtkWarningWithObjectMacro(mapper,
      "The input has no point normals: its splats face the camera. Of isopoints let their filter "
      "compute normals (Compute Normals in ParaView, ComputeNormalsOn()); for other points compute "
      "them, for example with vtkPCANormalEstimation, and make them the active normals.");
    this->WarnedOfNormals = true;
  }
  if (block.Data->GetNumberOfPoints() > std::numeric_limits<GLsizei>::max())
  {
    vtkErrorWithObjectMacro(mapper, "A block of "
                                      << block.Data->GetNumberOfPoints()
                                      << " points is not drawn: split it into blocks of at most "
                                      << std::numeric_limits<GLsizei>::max() << " points.");
    return;
  }
  block.Buffers.SetSplats(block.Data, shape);
}

//------------------------------------------------------------------------------
bool vtkIsopointSplatMapper::Internals::CanUseColorMap(vtkIsopointSplatMapper* mapper) const
{
  const auto& blocks = this->Blocks.Get();
  return std::all_of(blocks.begin(), blocks.end(),
    [mapper](const std::unique_ptr<vtkIsopointSplatBlocks::Block>& block)
    {
      int cellFlag = 0;
      return !block->Leaf.HasColor &&
             vtkAbstractMapper::GetAbstractScalars(block->Data, mapper->ScalarMode,
               mapper->ArrayAccessMode, mapper->ArrayId, mapper->ArrayName, cellFlag) != nullptr &&
             cellFlag == 0;
    });
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::Internals::UpdateColors(vtkIsopointSplatMapper* mapper)
{
  const bool usesMap = mapper->InterpolateScalarsBeforeMapping && this->CanUseColorMap(mapper);
  const auto stateOf = [&]()
  {
    vtkScalarsToColors* const table = mapper->LookupTable;
    std::ostringstream state;
    state << mapper->ScalarVisibility << ' ' << mapper->ScalarMode << ' ' << mapper->ColorMode
          << ' ' << mapper->ArrayAccessMode << ' ' << mapper->ArrayId << ' '
          << mapper->ArrayComponent << ' ' << mapper->UseLookupTableScalarRange << ' '
          << std::hexfloat << mapper->ScalarRange[0] << ' ' << mapper->ScalarRange[1] << ' '
          << usesMap << ' ' << mapper->FieldDataTupleId << ' ' << table << ' '
          << (table ? table->GetMTime() : 0) << '\n'
          << mapper->ArrayName << '\n';
    for (const auto& block : this->Blocks.Get())
    {
      state << block->Leaf.HasColor;
    }
    return state.str();
  };
  const std::string state = stateOf();
  const auto& blocks = this->Blocks.Get();
  if (std::all_of(blocks.begin(), blocks.end(),
        [&state](const auto& block) { return block->ColorState == state; }))
  {
    return;
  }
  this->ColoredBy = Coloring::Material;
  this->HasTranslucentColors = false;
  {
    const ScopedValue scope(mapper->InterpolateScalarsBeforeMapping, usesMap);
    for (const auto& block : blocks)
    {
      this->UpdateColors(mapper, *block);
    }
  }
  // Mapping may build the table, which changes its modified time.
  const std::string newState = stateOf();
  for (const auto& block : blocks)
  {
    block->ColorState = newState;
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::Internals::UpdateColors(
  vtkIsopointSplatMapper* mapper, vtkIsopointSplatBlocks::Block& block)
{
  const auto forget = [mapper](auto*& array)
  {
    if (array)
    {
      array->UnRegister(mapper);
      array = nullptr;
    }
  };
  // MapScalars would take the previous block's colors to be up to date for this one.
  forget(mapper->Colors);
  forget(mapper->ColorCoordinates);
  int cellFlag = 0;
  if (!block.Leaf.HasColor)
  {
    this->MapScalars(mapper, block, cellFlag);
  }
  if (block.Leaf.HasColor)
  {
    block.Buffers.SetColors(nullptr);
    this->ColoredBy = Coloring::Colors;
  }
  else if (mapper->ColorTextureMap && this->Usable(mapper, block.Data, mapper->ColorCoordinates, 2))
  {
    if (!mapper->InternalColorTexture)
    {
      mapper->InternalColorTexture = vtkOpenGLTexture::New();
      mapper->InternalColorTexture->RepeatOff();
    }
    mapper->InternalColorTexture->SetInputData(mapper->ColorTextureMap);
    block.Buffers.SetColorCoordinates(mapper->ColorCoordinates);
    this->ColoredBy = Coloring::ColorMap;
  }
  else if (mapper->Colors && cellFlag == 1 && block.Data->GetNumberOfVerts() == 0)
  {
    if (!this->WarnedOfCells)
    {
      vtkWarningWithObjectMacro(mapper,
        "The splats are not colored by the cell array: cell data color vertex cells, and the input "
        "has none. Apply vtkCellDataToPointData, or choose a point array.");
      this->WarnedOfCells = true;
    }
    block.Buffers.SetColors(nullptr);
  }
  else if (mapper->Colors && (cellFlag != 0 || this->Usable(mapper, block.Data, mapper->Colors, 4)))
  {
    const auto colors = colorsOfPoints(block, mapper->Colors, cellFlag, mapper->FieldDataTupleId);
    block.Buffers.SetColors(colors);
    this->ColoredBy = Coloring::Colors;
    this->HasTranslucentColors = this->HasTranslucentColors || hasTranslucent(colors);
  }
  else
  {
    block.Buffers.SetColors(nullptr);
  }
  forget(mapper->Colors);
  forget(mapper->ColorCoordinates);
  block.Version = ++this->LastVersion;
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::Internals::MapScalars(
  vtkIsopointSplatMapper* mapper, vtkIsopointSplatBlocks::Block& block, int& cellFlag)
{
  vtkAbstractArray* const scalars = vtkAbstractMapper::GetAbstractScalars(block.Data,
    mapper->ScalarMode, mapper->ArrayAccessMode, mapper->ArrayId, mapper->ArrayName, cellFlag);
  if (scalars && mapper->ScalarVisibility)
  {
    // MapScalars allocates two floats per tuple for coordinates in a color map, half of that for
    // colors.
    constexpr std::size_t size = 2 * sizeof(float);
    vtkIsopointSplatMemory::Require(size * static_cast<std::size_t>(scalars->GetNumberOfTuples()));
  }
  mapper->MapScalars(block.Data, 1.0, cellFlag);
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::Internals::SetUpPasses(vtkIsopointSplatMapper* mapper,
  vtkRenderer* renderer, vtkActor* actor, vtkIsopointSplatPasses::Settings& settings)
{
  const auto window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  int viewport[4];
  window->GetState()->vtkglGetIntegerv(GL_VIEWPORT, viewport);
  for (int axis = 0; axis < 2; ++axis)
  {
    this->ViewportOrigin[axis] = viewport[axis];
    settings.Size[axis] = std::max(viewport[2 + axis], 1);
  }

  const auto camera = static_cast<vtkOpenGLCamera*>(renderer->GetActiveCamera());
  vtkMatrix4x4* worldToView;
  vtkMatrix4x4* worldToClip;
  vtkMatrix4x4* viewToClip;
  vtkMatrix3x3* normals;
  camera->GetKeyMatrices(renderer, worldToView, normals, viewToClip, worldToClip);
  settings.ViewToClip->DeepCopy(viewToClip);
  settings.ParallelProjection = camera->GetParallelProjection() != 0;
  if (actor->GetIsIdentity())
  {
    settings.ModelToView->DeepCopy(worldToView);
  }
  else
  {
    vtkMatrix4x4* modelToWorld;
    static_cast<vtkOpenGLActor*>(actor)->GetKeyMatrices(modelToWorld, normals);
    vtkMatrix4x4::Multiply4x4(modelToWorld, worldToView, settings.ModelToView);
  }

  const int planes = mapper->GetNumberOfClippingPlanes();
  vtkNew<vtkMatrix4x4> planeToView;
  vtkMatrix4x4::Invert(worldToView, planeToView);
  constexpr int most = vtkIsopointSplatPasses::MaximumNumberOfClippingPlanes;
  for (int i = 0; i < std::min(planes, most); ++i)
  {
    vtkPlane* const plane = mapper->GetClippingPlanes()->GetItem(i);
    double equation[4];
    plane->GetNormal(equation);
    equation[3] = -vtkMath::Dot(equation, plane->GetOrigin());
    std::array<double, 4> inView;
    planeToView->MultiplyPoint(equation, inView.data());
    settings.ClippingPlanes.push_back(inView);
  }
  if (planes > most && this->TooManyPlanes != mapper->GetClippingPlanes()->GetMTime())
  {
    this->TooManyPlanes = mapper->GetClippingPlanes()->GetMTime();
    vtkErrorWithObjectMacro(mapper, "Only the first "
                                      << most << " of " << planes
                                      << " clipping planes are applied: the shaders "
                                         "support no more. Remove some.");
  }

  vtkProperty* const property = actor->GetProperty();
  settings.CulledFacing =
    property->GetFrontfaceCulling() ? 1 : (property->GetBackfaceCulling() ? -1 : 0);
  settings.RadiusScale = mapper->RadiusScale;
  settings.BlendDepth = mapper->BlendDepth;
  settings.Stride = mapper->Stride;
  // At a lower level of detail another choice of splats is drawn where they are no ghosts.
  settings.BlendsGhosts = mapper->BlendGhosts && mapper->Stride == 1;
  settings.Ids = renderer->GetSelector() != nullptr;
  settings.NumberOfLayers = actor->IsRenderingTranslucentPolygonalGeometry() && !settings.Ids
                              ? mapper->MaximumNumberOfLayers
                              : 1;
  // Layers with samples would take too much memory.
  settings.Samples = settings.Ids || settings.NumberOfLayers > 1
                       ? 0
                       : vtkIsopointSplatPasses::SamplesOfFramebuffer();
  this->Samples = settings.Samples;
  settings.HasColors = this->ColoredBy != Coloring::Material;
  settings.TranslucentColors = this->HasTranslucentColors && this->ColoredBy == Coloring::Colors;
}

//------------------------------------------------------------------------------
std::vector<vtkIsopointSplatPasses::Block> vtkIsopointSplatMapper::Internals::GetPassBlocks(
  vtkActor* actor)
{
  std::array<double, 3> material;
  actor->GetProperty()->GetDiffuseColor(material.data());
  std::vector<vtkIsopointSplatPasses::Block> result;
  for (const auto& block : this->Blocks.Get())
  {
    if (!block->Leaf.Visible)
    {
      continue;
    }
    const std::array<double, 3>& color = block->Leaf.HasColor ? block->Leaf.Color : material;
    result.push_back({ &block->Buffers, block->Version, block->Leaf.FlatIndex,
      { static_cast<float>(color[0]), static_cast<float>(color[1]), static_cast<float>(color[2]),
        1.0f } });
  }
  return result;
}
