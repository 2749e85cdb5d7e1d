// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatMapper.h"

#include "vtkIsopointSplatMapperInternals.h"
#include "vtkIsopointSplatOpenGL.h"

#include "vtkActor.h"
#include "vtkAlgorithm.h"
#include "vtkBoundingBox.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkHardwareSelector.h"
#include "vtkInformation.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderTimer.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLTexture.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkScalarsToColors.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>

vtkStandardNewMacro(vtkIsopointSplatMapper);

//------------------------------------------------------------------------------
vtkIsopointSplatMapper::vtkIsopointSplatMapper()
  : RadiusArrayName(nullptr)
  , SplatAxis1ArrayName(nullptr)
  , SplatAxis2ArrayName(nullptr)
  , SplatClipArrayName(nullptr)
  , Internal(new Internals)
{
  this->SetRadiusArrayName("Radius");
  this->SetSplatAxis1ArrayName("SplatAxis1");
  this->SetSplatAxis2ArrayName("SplatAxis2");
  this->SetSplatClipArrayName("SplatClip");
}

//------------------------------------------------------------------------------
vtkIsopointSplatMapper::~vtkIsopointSplatMapper()
{
  if (vtkWindow* const window = this->Internal->Passes.GetWindow())
  {
    window->RemoveObserver(this->Internal->WindowObserver);
  }
  this->ReleaseSplats();
  this->SetRadiusArrayName(nullptr);
  this->SetSplatAxis1ArrayName(nullptr);
  this->SetSplatAxis2ArrayName(nullptr);
  this->SetSplatClipArrayName(nullptr);
}

//------------------------------------------------------------------------------
int vtkIsopointSplatMapper::FillInputPortInformation(int port, vtkInformation* info)
{
  this->Superclass::FillInputPortInformation(port, info);
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::ComputeBounds()
{
  const vtkBoundingBox box =
    this->Internal->Bounds.Of(this->GetInputDataObject(0, 0), this->Internal->BlockAttributes);
  if (box.IsValid())
  {
    box.GetBounds(this->Bounds);
  }
  else
  {
    vtkMath::UninitializeBounds(this->Bounds);
  }
}

//------------------------------------------------------------------------------
bool vtkIsopointSplatMapper::HasTranslucentPolygonalGeometry()
{
  vtkScalarsToColors* const table = this->ScalarVisibility ? this->GetLookupTable() : nullptr;
  if (!table)
  {
    return false;
  }
  table->Build();
  for (const vtkIsopointSplatLeaf& leaf :
    vtkIsopointSplatLeaves(this->GetInputDataObject(0, 0), this->Internal->BlockAttributes))
  {
    int cellFlag = 0;
    vtkAbstractArray* const scalars = vtkAbstractMapper::GetAbstractScalars(
      leaf.Data, this->ScalarMode, this->ArrayAccessMode, this->ArrayId, this->ArrayName, cellFlag);
    if (scalars && leaf.Visible && !leaf.HasColor &&
        !table->IsOpaque(scalars, this->ColorMode, this->ArrayComponent))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::RenderPiece(vtkRenderer* renderer, vtkActor* actor)
{
  if (renderer->GetRenderWindow()->CheckAbortStatus())
  {
    return;
  }
  this->InvokeEvent(vtkCommand::StartEvent, nullptr);
  if (!this->Static)
  {
    this->GetInputAlgorithm()->Update();
  }
  this->InvokeEvent(vtkCommand::EndEvent, nullptr);

  this->UseWindow(renderer->GetRenderWindow());
  this->Internal->Blocks.SetInput(this->GetInputDataObject(0, 0), this->Internal->BlockAttributes);
  if (this->Internal->Blocks.IsEmpty())
  {
    this->CurrentInput = nullptr;
    return;
  }
  // The superclass asks it for what its shader needs; all blocks are drawn.
  this->CurrentInput = this->Internal->Blocks.Get().front()->Data;
  this->RenderPieceStart(renderer, actor);
  this->RenderPieceDraw(renderer, actor);
  this->RenderPieceFinish(renderer, actor);
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::UpdateBufferObjects(vtkRenderer*, vtkActor*)
{
  this->Internal->UpdateGeometry(this);
  this->Internal->UpdateColors(this);
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::UpdateMaximumPointCellIds(vtkRenderer* renderer, vtkActor*)
{
  vtkHardwareSelector* const selector = renderer->GetSelector();
  for (const auto& block : this->Internal->Blocks.Get())
  {
    const vtkIdType last = block->Data->GetNumberOfPoints() - 1;
    selector->UpdateMaximumPointId(last);
    // Cells are found by the points that are drawn.
    selector->UpdateMaximumCellId(std::max(last, block->Data->GetNumberOfCells() - 1));
    const auto include = [selector](vtkDataSetAttributes* attributes, const char* name,
                           void (vtkHardwareSelector::*update)(vtkIdType))
    {
      if (vtkDataArray* const ids = name ? attributes->GetArray(name) : nullptr)
      {
        (selector->*update)(static_cast<vtkIdType>(ids->GetRange(0)[1]));
      }
    };
    include(block->Data->GetPointData(), this->PointIdArrayName,
      &vtkHardwareSelector::UpdateMaximumPointId);
    include(
      block->Data->GetCellData(), this->CellIdArrayName, &vtkHardwareSelector::UpdateMaximumCellId);
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor)
{
  vtkIsopointSplatPasses& passes = this->Internal->Passes;
  vtkIsopointSplatPasses::Settings settings;
  this->Internal->SetUpPasses(this, renderer, actor, settings);
  passes.Render(settings, this->Internal->GetPassBlocks(actor));

  // What is culled was so splat by splat; the triangle over the viewport has no facing.
  vtkOpenGLState* const state = passes.GetWindow()->GetState();
  vtkOpenGLState::ScopedglEnableDisable cullFace(state, GL_CULL_FACE);
  state->vtkglDisable(GL_CULL_FACE);
  this->DrawingVertices = false;
  this->DrawingSelection = false;
  vtkOpenGLHelper& helper = this->Primitives[PrimitiveTris];
  for (int i = passes.GetNumberOfLayers() - 1; i >= 0; --i)
  {
    this->UpdateShaders(helper, renderer, actor);
    vtkShaderProgram* const program = helper.Program;
    if (!program)
    {
      return;
    }
    std::vector<vtkTextureObject*> active;
    const auto setTexture = [&](const char* name, vtkTextureObject* texture)
    {
      if (program->IsUniformUsed(name))
      {
        texture->Activate();
        active.push_back(texture);
        program->SetUniformi(name, texture->GetTextureUnit());
      }
    };
    const vtkIsopointSplatPasses::Layer& layer = passes.GetLayer(i);
    setTexture("splatVisibleDepth", layer.Depth);
    setTexture("splatSurfaceSums", layer.Surface);
    setTexture("splatColorSums", layer.Color);
    setTexture("splatOpacitySums", layer.HasOpacity ? layer.Opacity : layer.Color);
    setTexture("splatIds", settings.Ids ? passes.GetIds() : layer.Color);
    if (program->IsUniformUsed("splatColorMap"))
    {
      const bool hasMap = this->Internal->ColoredBy == Internals::Coloring::ColorMap;
      program->SetUniformi("splatColorMap",
        hasMap ? this->InternalColorTexture->GetTextureUnit() : layer.Color->GetTextureUnit());
    }
    program->SetUniformi("splatColoring", static_cast<int>(this->Internal->ColoredBy));
    program->SetUniformi("splatOpacities", layer.HasOpacity ? 1 : 0);
    program->SetUniform2i("splatOrigin", this->Internal->ViewportOrigin);
    const float size[2] = { static_cast<float>(settings.Size[0]),
      static_cast<float>(settings.Size[1]) };
    program->SetUniform2f("splatViewportSize", size);
    program->SetUniformMatrix("splatVCDCMatrix", settings.ViewToClip);
    program->SetUniformi("splatCameraParallel", settings.ParallelProjection ? 1 : 0);

    helper.VAO->Bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    for (vtkTextureObject* const texture : active)
    {
      texture->Deactivate();
    }
  }
}

//------------------------------------------------------------------------------
namespace
{

vtkIdType readId(vtkHardwareSelector* selector, int lowPass, int highPass, unsigned int offset)
{
  const unsigned char* const low = selector->GetRawPixelBuffer(lowPass);
  const unsigned char* const high = selector->GetRawPixelBuffer(highPass);
  vtkIdType id = high ? high[offset] : 0;
  for (int byte = 2; byte >= 0; --byte)
  {
    id = (id << 8) | low[offset + byte];
  }
  return id;
}

void writeBytes(unsigned char* pixels, unsigned int offset, vtkIdType value)
{
  for (int byte = 0; byte < 3; ++byte)
  {
    pixels[offset + byte] = static_cast<unsigned char>((value >> (8 * byte)) & 0xff);
  }
}

vtkIdType throughArray(vtkDataSetAttributes* attributes, const char* name, vtkIdType id)
{
  vtkDataArray* const array = name ? attributes->GetArray(name) : nullptr;
  return array && id < array->GetNumberOfTuples()
           ? static_cast<vtkIdType>(array->GetComponent(id, 0))
           : id;
}

} // namespace

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::ProcessSelectorPixelBuffers(
  vtkHardwareSelector* selector, std::vector<unsigned int>& pixelOffsets, vtkProp*)
{
  using Selector = vtkHardwareSelector;
  const int pass = selector->GetCurrentPass();
  const bool isCell = pass == Selector::CELL_ID_LOW24 || pass == Selector::CELL_ID_HIGH24;
  const bool isHigh = pass == Selector::CELL_ID_HIGH24 || pass == Selector::POINT_ID_HIGH24;
  const bool isPoint = pass == Selector::POINT_ID_LOW24 || pass == Selector::POINT_ID_HIGH24;
  const bool isProcess = pass == Selector::PROCESS_PASS && selector->GetUseProcessIdFromData();
  const int lowPass = isCell ? Selector::CELL_ID_LOW24 : Selector::POINT_ID_LOW24;
  const int highPass = isCell ? Selector::CELL_ID_HIGH24 : Selector::POINT_ID_HIGH24;
  unsigned char* const pixels = selector->GetPixelBuffer(pass);
  if (!this->PopulateSelectionSettings || !(isCell || isPoint || isProcess) || !pixels ||
      !selector->GetRawPixelBuffer(lowPass))
  {
    return;
  }
  const unsigned char* const composite =
    selector->GetRawPixelBuffer(Selector::COMPOSITE_INDEX_PASS);
  for (const unsigned int offset : pixelOffsets)
  {
    const unsigned int flatIndex =
      composite ? composite[offset] | (composite[offset + 1] << 8) | (composite[offset + 2] << 16)
                : 0;
    vtkIsopointSplatBlocks::Block* const block = this->Internal->Blocks.Find(flatIndex);
    if (!block)
    {
      continue;
    }
    const vtkIdType point = readId(selector, lowPass, highPass, offset);
    vtkIdType id = point;
    if (isCell)
    {
      const vtkIdType cell = vtkIsopointSplatBlocks::CellOfPoint(*block, point);
      id = cell < 0 ? 0 : throughArray(block->Data->GetCellData(), this->CellIdArrayName, cell);
    }
    else if (isPoint)
    {
      id = throughArray(block->Data->GetPointData(), this->PointIdArrayName, point);
    }
    else if (this->ProcessIdArrayName &&
             block->Data->GetPointData()->GetArray(this->ProcessIdArrayName))
    {
      id = 1 + throughArray(block->Data->GetPointData(), this->ProcessIdArrayName, point);
    }
    else
    {
      continue;
    }
    writeBytes(pixels, offset, isHigh ? id >> 24 : id);
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::SetCompositeDataDisplayAttributes(
  vtkCompositeDataDisplayAttributes* attributes)
{
  if (this->Internal->BlockAttributes != attributes)
  {
    this->Internal->BlockAttributes = attributes;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkCompositeDataDisplayAttributes* vtkIsopointSplatMapper::GetCompositeDataDisplayAttributes()
{
  return this->Internal->BlockAttributes;
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->ReleaseSplats();
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::UseWindow(vtkWindow* window)
{
  vtkWindow* const former = this->Internal->Passes.GetWindow();
  if (former == window)
  {
    return;
  }
  this->ReleaseSplats();
  if (former)
  {
    former->RemoveObserver(this->Internal->WindowObserver);
  }
  this->Internal->Passes.SetWindow(vtkOpenGLRenderWindow::SafeDownCast(window));
  // Its context goes with it, and handles would be another one's then.
  this->Internal->WindowObserver =
    window->AddObserver(vtkCommand::DeleteEvent, this, &vtkIsopointSplatMapper::ReleaseSplats);
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::ReleaseSplats()
{
  // The window that they were made for may not be the current one, or may be gone.
  vtkOpenGLRenderWindow* const window = this->Internal->Passes.GetWindow();
  if (window)
  {
    window->PushContext();
  }
  this->Internal->Blocks.ReleaseGraphicsResources();
  this->Internal->Passes.ReleaseGraphicsResources();
  // The superclass releases its own only if it has rendered by itself.
  for (vtkOpenGLHelper& helper : this->Primitives)
  {
    helper.ReleaseGraphicsResources(window);
  }
  this->TimerQuery->ReleaseGraphicsResources();
  if (this->InternalColorTexture)
  {
    this->InternalColorTexture->ReleaseGraphicsResources(window);
  }
  if (window)
  {
    window->PopContext();
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::ShallowCopy(vtkAbstractMapper* mapper)
{
  if (const auto other = vtkIsopointSplatMapper::SafeDownCast(mapper))
  {
    this->SetRadiusArrayName(other->GetRadiusArrayName());
    this->SetSplatAxis1ArrayName(other->GetSplatAxis1ArrayName());
    this->SetSplatAxis2ArrayName(other->GetSplatAxis2ArrayName());
    this->SetSplatClipArrayName(other->GetSplatClipArrayName());
    this->SetRadius(other->GetRadius());
    this->SetRadiusScale(other->GetRadiusScale());
    this->SetBlendDepth(other->GetBlendDepth());
    this->SetShape(other->GetShape());
    this->SetStride(other->GetStride());
    this->SetMaximumNumberOfLayers(other->GetMaximumNumberOfLayers());
    this->SetCompositeDataDisplayAttributes(other->Internal->BlockAttributes);
  }
  this->Superclass::ShallowCopy(mapper);
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto printName = [&](const char* label, const char* name)
  { os << indent << label << ": " << (name ? name : "(none)") << "\n"; };
  printName("RadiusArrayName", this->RadiusArrayName);
  printName("SplatAxis1ArrayName", this->SplatAxis1ArrayName);
  printName("SplatAxis2ArrayName", this->SplatAxis2ArrayName);
  printName("SplatClipArrayName", this->SplatClipArrayName);
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "RadiusScale: " << this->RadiusScale << "\n";
  os << indent << "BlendDepth: " << this->BlendDepth << "\n";
  os << indent << "Shape: " << (this->Shape == CIRCLE ? "circle" : "ellipse") << "\n";
  os << indent << "Stride: " << this->Stride << "\n";
  os << indent << "MaximumNumberOfLayers: " << this->MaximumNumberOfLayers << "\n";
  os << indent << "CompositeDataDisplayAttributes: " << this->Internal->BlockAttributes << "\n";
}
