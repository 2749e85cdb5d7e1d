// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatMapper.h"

#include "vtkIsopointSplatMapperInternals.h"
#include "vtkIsopointSplatOpenGL.h"

#include "vtkActor.h"
#include "vtkAlgorithm.h"
#include "vtkBoundingBox.h"
#include "vtkCommand.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkInformation.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderTimer.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLTexture.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkScalarsToColors.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"
#include "vtkTextureUnitManager.h"

#include <algorithm>
#include <vector>

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
  vtkBoundingBox box;
  this->Internal->Try(this,
    [&]
    {
      const char* const radii = this->RadiusArrayName;
      box = this->Internal->Bounds.Of(this->GetInputDataObject(0, 0),
        this->Internal->BlockAttributes, { radii ? radii : "", this->Radius, this->RadiusScale });
    });
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
  const auto isTranslucent = [&](const vtkIsopointSplatLeaf& leaf)
  {
    int cellFlag = 0;
    vtkAbstractArray* const scalars = vtkAbstractMapper::GetAbstractScalars(
      leaf.Data, this->ScalarMode, this->ArrayAccessMode, this->ArrayId, this->ArrayName, cellFlag);
    return scalars && leaf.Visible && !leaf.HasColor &&
           !table->IsOpaque(scalars, this->ColorMode, this->ArrayComponent);
  };
  bool result = false;
  this->Internal->Try(this,
    [&]
    {
      table->Build();
      const std::vector<vtkIsopointSplatLeaf> leaves =
        vtkIsopointSplatLeaves(this->GetInputDataObject(0, 0), this->Internal->BlockAttributes);
      result = std::any_of(leaves.begin(), leaves.end(), isTranslucent);
    });
  return result;
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
  if (!this->Internal->Prepare(this, renderer->GetSelector()))
  {
    this->CurrentInput = nullptr;
    return;
  }
  // The superclass's shader depends on one input; the first block represents all that are drawn.
  this->CurrentInput = this->Internal->Blocks.Get().front()->Data;
  this->Internal->BeginFrame();
  this->RenderPieceStart(renderer, actor);
  this->RenderPieceDraw(renderer, actor);
  this->RenderPieceFinish(renderer, actor);
  this->Internal->EndFrame();
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor)
{
  vtkIsopointSplatPasses& passes = this->Internal->Passes;
  vtkIsopointSplatPasses::Settings settings;
  const bool isRendered = this->Internal->Try(this,
    [&]
    {
      this->Internal->SetUpPasses(this, renderer, actor, settings);
      passes.Render(settings, this->Internal->GetPassBlocks(actor));
    });
  if (!isRendered)
  {
    passes.ReleaseGraphicsResources();
    return;
  }

  // Faces are culled splat by splat in the passes; the triangle over the viewport is never culled.
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
    setTexture("splatOutlineSums", layer.HasOutline ? layer.Outline : layer.Color);
    setTexture("splatOpacitySums", layer.HasOpacity ? layer.Opacity : layer.Color);
    setTexture("splatOwnSums", layer.HasOwn ? layer.Own : layer.Color);
    // Samplers of two kinds must not share a unit, even if one of them is not read.
    vtkTextureUnitManager* const units = passes.GetWindow()->GetTextureUnitManager();
    const int unused = units->Allocate();
    if (settings.Ids)
    {
      setTexture("splatIds", passes.GetIds());
    }
    else if (program->IsUniformUsed("splatIds"))
    {
      program->SetUniformi("splatIds", unused);
    }
    if (program->IsUniformUsed("splatColorMap"))
    {
      const bool hasMap = this->Internal->ColoredBy == Internals::Coloring::ColorMap;
      program->SetUniformi(
        "splatColorMap", hasMap ? this->InternalColorTexture->GetTextureUnit() : unused);
    }
    program->SetUniformi("splatColoring", static_cast<int>(this->Internal->ColoredBy));
    program->SetUniformi("splatGhosts", layer.HasOwn ? (settings.Ids ? 2 : 1) : 0);
    program->SetUniformi("splatOpacities", layer.HasOpacity ? 1 : 0);
    program->SetUniform2i("splatOrigin", this->Internal->ViewportOrigin);
    const float size[2] = { static_cast<float>(settings.Size[0]),
      static_cast<float>(settings.Size[1]) };
    program->SetUniform2f("splatViewportSize", size);
    program->SetUniformMatrix("splatVCDCMatrix", settings.ViewToClip);
    if (settings.Samples > 0)
    {
      vtkIsopointSplatPasses::SetSamplePositions(program, "splatSamplePositions", layer);
    }
    program->SetUniformi("splatCameraParallel", settings.ParallelProjection ? 1 : 0);

    helper.VAO->Bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    units->Free(unused);
    for (vtkTextureObject* const texture : active)
    {
      texture->Deactivate();
    }
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
  // The window deletes its context: later, the same handles could be those of another context.
  this->Internal->WindowObserver =
    window->AddObserver(vtkCommand::DeleteEvent, this, &vtkIsopointSplatMapper::ReleaseSplats);
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::ReleaseSplats()
{
  // The window of these resources may not be the current one, or may have been deleted.
  vtkOpenGLRenderWindow* const window = this->Internal->Passes.GetWindow();
  if (window)
  {
    window->PushContext();
  }
  this->Internal->Blocks.ReleaseGraphicsResources();
  this->Internal->Passes.ReleaseGraphicsResources();
  // The superclass releases its own resources only if its RenderPiece has been called.
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
    this->SetBlendGhosts(other->GetBlendGhosts());
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
  os << indent << "BlendGhosts: " << (this->BlendGhosts ? "On" : "Off") << "\n";
  os << indent << "MaximumNumberOfLayers: " << this->MaximumNumberOfLayers << "\n";
  os << indent << "CompositeDataDisplayAttributes: " << this->Internal->BlockAttributes << "\n";
}
