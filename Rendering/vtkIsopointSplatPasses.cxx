// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatPasses.h"

#include "vtkIsopointSplatFS.h"
#include "vtkIsopointSplatGS.h"
#include "vtkIsopointSplatOpenGL.h"
#include "vtkIsopointSplatVS.h"

#include "vtkMatrix3x3.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <cmath>
#include <cstring>
#include <string>

namespace
{

/// In pixels. More than half of a pixel's diagonal, so that every splat covers a pixel's center.
constexpr float minimumHalfAxis = 0.75f;

/// Blended splats are larger than visible ones by this factor: the surface is smoother, its outline
/// unchanged.
constexpr double blendingReach = 1.4;

/// With several samples per pixel, or one if their number is 0.
void prepareColorTexture(vtkTextureObject* texture, const int size[2], int components, int samples)
{
  if (texture->GetHandle() == 0)
  {
    texture->SetSamples(static_cast<unsigned int>(samples));
    texture->SetAutoParameters(samples == 0); // there are none where there are samples
    texture->Allocate2D(size[0], size[1], components, VTK_FLOAT);
    texture->SetMinificationFilter(vtkTextureObject::Nearest);
    texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  }
  texture->Resize(size[0], size[1]);
}

void prepareDepthTexture(vtkTextureObject* texture, const int size[2], int samples)
{
  if (texture->GetHandle() == 0)
  {
    texture->SetSamples(static_cast<unsigned int>(samples));
    texture->SetAutoParameters(samples == 0); // there are none where there are samples
    texture->AllocateDepth(size[0], size[1], vtkTextureObject::Float32);
    texture->SetMinificationFilter(vtkTextureObject::Nearest);
    texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  }
  texture->Resize(size[0], size[1]);
}

/// @throws std::bad_alloc where OpenGL had no memory for a texture of the framebuffer
void bind(vtkOpenGLFramebufferObject* framebuffer, unsigned int buffers)
{
  framebuffer->Bind();
  framebuffer->DeactivateDrawBuffers();
  framebuffer->ActivateDrawBuffers(buffers);
  // All formats are required to be renderable: only a lack of memory makes it incomplete.
  if (glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
  {
    vtkIsopointSplatOutOfGraphicsMemory();
  }
}

bool hasSampleShading()
{
  GLint count = 0;
  glGetIntegerv(GL_NUM_EXTENSIONS, &count);
  for (GLint i = 0; i < count; ++i)
  {
    const auto* const name =
      reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(i)));
    if (name && std::strcmp(name, "GL_ARB_sample_shading") == 0)
    {
      return true;
    }
  }
  return false;
}

/// Of the samples of the bound framebuffer: x and y of each, in pixels, from the pixel's center.
std::vector<float> samplePositions(int samples)
{
  constexpr float center = 0.5f;
  std::vector<float> positions(2 * static_cast<std::size_t>(samples));
  for (int i = 0; i < samples; ++i)
  {
    float* const position = &positions[2 * static_cast<std::size_t>(i)];
    glGetMultisamplefv(GL_SAMPLE_POSITION, static_cast<GLuint>(i), position);
    position[0] -= center;
    position[1] -= center;
  }
  return positions;
}

/// Restores OpenGL's state at the end of a scope. vtkOpenGLState::Push and Pop would restore
/// bindings from VTK's cache, some of them of deleted buffers.
class StateKeeper
{
public:
  explicit StateKeeper(vtkOpenGLState* state)
    : State(state)
    , Blend(state, GL_BLEND)
    , CullFace(state, GL_CULL_FACE)
    , DepthTest(state, GL_DEPTH_TEST)
    , ScissorTest(state, GL_SCISSOR_TEST)
    , StencilTest(state, GL_STENCIL_TEST)
    , BlendFunction(state)
    , ClearColor(state)
    , ColorMask(state)
    , DepthFunction(state)
    , DepthMask(state)
    , Viewport(state)
  {
    state->vtkglGetDoublev(GL_DEPTH_CLEAR_VALUE, &this->ClearDepth);
    glGetIntegerv(GL_BLEND_EQUATION_RGB, &this->BlendEquations[0]);
    glGetIntegerv(GL_BLEND_EQUATION_ALPHA, &this->BlendEquations[1]);
    state->PushFramebufferBindings();
  }

  ~StateKeeper()
  {
    this->State->PopFramebufferBindings();
    this->State->vtkglClearDepth(this->ClearDepth);
    this->State->vtkglBlendEquationSeparate(this->BlendEquations[0], this->BlendEquations[1]);
  }

  StateKeeper(const StateKeeper&) = delete;
  StateKeeper& operator=(const StateKeeper&) = delete;

private:
  vtkOpenGLState* const State;
  vtkOpenGLState::ScopedglEnableDisable Blend, CullFace, DepthTest, ScissorTest, StencilTest;
  vtkOpenGLState::ScopedglBlendFuncSeparate BlendFunction;
  vtkOpenGLState::ScopedglClearColor ClearColor;
  vtkOpenGLState::ScopedglColorMask ColorMask;
  vtkOpenGLState::ScopedglDepthFunc DepthFunction;
  vtkOpenGLState::ScopedglDepthMask DepthMask;
  vtkOpenGLState::ScopedglViewport Viewport;
  GLdouble ClearDepth;
  GLint BlendEquations[2];
};

/// Enables the first elements of gl_ClipDistance for the duration of a scope.
class ClipDistances
{
public:
  explicit ClipDistances(std::size_t count)
    : Count(static_cast<unsigned int>(count))
  {
    for (unsigned int i = 0; i < this->Count; ++i)
    {
      glEnable(GL_CLIP_DISTANCE0 + i);
    }
  }

  ~ClipDistances()
  {
    for (unsigned int i = 0; i < this->Count; ++i)
    {
      glDisable(GL_CLIP_DISTANCE0 + i);
    }
  }

  ClipDistances(const ClipDistances&) = delete;
  ClipDistances& operator=(const ClipDistances&) = delete;

private:
  const unsigned int Count;
};

void clear(vtkOpenGLState* state)
{
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  state->vtkglClearDepth(1.0);
  state->vtkglClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

/// The matrix from model coordinates relative to a center to view coordinates, both transposed.
void placeCenter(const std::array<double, 3>& center, vtkMatrix4x4* modelToView, vtkMatrix4x4* out)
{
  vtkNew<vtkMatrix4x4> translation;
  for (int axis = 0; axis < 3; ++axis)
  {
    translation->SetElement(3, axis, center[axis]);
  }
  vtkMatrix4x4::Multiply4x4(translation, modelToView, out);
}

} // namespace

//------------------------------------------------------------------------------
int vtkIsopointSplatPasses::SamplesOfFramebuffer()
{
  constexpr int mostSamples = 32; // of one word of a sample mask
  GLint samples = 0;
  if (glIsEnabled(GL_MULTISAMPLE))
  {
    glGetIntegerv(GL_SAMPLES, &samples);
  }
  return samples > 1 && samples <= mostSamples && hasSampleShading() ? samples : 0;
}

//------------------------------------------------------------------------------
void vtkIsopointSplatPasses::SetSamplePositions(
  vtkShaderProgram* program, const char* name, const Layer& layer)
{
  using Position = float[2];
  program->SetUniform2fv(
    name, layer.Samples, reinterpret_cast<const Position*>(layer.SamplePositions.data()));
}

//------------------------------------------------------------------------------
vtkIsopointSplatPasses::vtkIsopointSplatPasses() = default;
vtkIsopointSplatPasses::~vtkIsopointSplatPasses() = default;

//------------------------------------------------------------------------------
bool vtkIsopointSplatPasses::IsUpToDate(const Settings& settings, const std::vector<Block>& blocks)
{
  std::vector<double> state = { static_cast<double>(settings.Size[0]),
    static_cast<double>(settings.Size[1]), settings.ParallelProjection ? 1.0 : 0.0,
    settings.RadiusScale, settings.BlendDepth, static_cast<double>(settings.Stride),
    static_cast<double>(settings.CulledFacing), static_cast<double>(settings.NumberOfLayers),
    static_cast<double>(settings.Samples), settings.TranslucentColors ? 1.0 : 0.0,
    settings.BlendsGhosts ? 1.0 : 0.0 };
  state.push_back(settings.HasColors ? 1.0 : 0.0);
  state.insert(state.end(), settings.ModelToView->GetData(), settings.ModelToView->GetData() + 16);
  state.insert(state.end(), settings.ViewToClip->GetData(), settings.ViewToClip->GetData() + 16);
  for (const std::array<double, 4>& plane : settings.ClippingPlanes)
  {
    state.insert(state.end(), plane.begin(), plane.end());
  }
  for (const Block& block : blocks)
  {
    state.push_back(static_cast<double>(block.Version));
    state.push_back(static_cast<double>(block.Index));
    state.insert(state.end(), block.PlainColor.begin(), block.PlainColor.end());
  }
  const bool isSame = state == this->State;
  this->State = std::move(state);
  return isSame;
}

//------------------------------------------------------------------------------
void vtkIsopointSplatPasses::Render(const Settings& settings, const std::vector<Block>& blocks)
{
  const bool isUpToDate = this->IsUpToDate(settings, blocks);
  if (isUpToDate && (this->HasIds || !settings.Ids))
  {
    return;
  }
  vtkOpenGLState* const state = this->Window->GetState();
  const StateKeeper keeper(state);
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglDisable(GL_STENCIL_TEST);
  state->vtkglDisable(GL_CULL_FACE);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglViewport(0, 0, settings.Size[0], settings.Size[1]);
  const ClipDistances clipDistances(settings.ClippingPlanes.size());
  if (!isUpToDate)
  {
    this->RenderLayers(settings, blocks);
  }
  if (settings.Ids && this->NumberOfLayers > 0)
  {
    this->RenderIds(settings, blocks);
  }
  this->HasIds = settings.Ids;
}

//------------------------------------------------------------------------------
void vtkIsopointSplatPasses::RenderLayers(
  const Settings& settings, const std::vector<Block>& blocks)
{
  this->NumberOfLayers = 0;
  while (this->Layers.size() > static_cast<std::size_t>(settings.NumberOfLayers))
  {
    this->ReleaseLayer(*this->Layers.back());
    this->Layers.pop_back();
  }
  while (this->NumberOfLayers < settings.NumberOfLayers &&
         this->RenderLayer(this->NumberOfLayers, settings, blocks))
  {
    ++this->NumberOfLayers;
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatPasses::PrepareLayer(Layer& layer, const Settings& settings)
{
  if (!layer.Framebuffer->GetContext())
  {
    layer.Framebuffer->SetContext(this->Window);
    for (vtkTextureObject* texture : { layer.Depth.Get(), layer.Surface.Get(), layer.Color.Get(),
           layer.Opacity.Get(), layer.Own.Get(), layer.Outline.Get() })
    {
      texture->SetContext(this->Window);
    }
  }
  if (layer.Samples != settings.Samples)
  {
    this->ReleaseLayer(layer);
    layer.Samples = settings.Samples;
  }
  const bool isNew = layer.Depth->GetHandle() == 0;
  prepareDepthTexture(layer.Depth, settings.Size, settings.Samples);
  prepareColorTexture(layer.Surface, settings.Size, 4, settings.Samples);
  prepareColorTexture(layer.Color, settings.Size, 4, settings.Samples);
  std::vector<vtkTextureObject*> wanted = { layer.Surface, layer.Color };
  layer.HasOpacity = settings.TranslucentColors;
  layer.HasOwn = settings.BlendsGhosts;
  const auto want = [&](bool condition, vtkTextureObject* sums, int components)
  {
    if (condition)
    {
      prepareColorTexture(sums, settings.Size, components, settings.Samples);
      wanted.push_back(sums);
    }
  };
  layer.HasOutline = settings.Samples > 0 && settings.HasColors;
  want(layer.HasOutline, layer.Outline, 4);
  want(layer.HasOpacity, layer.Opacity, 1);
  want(layer.HasOwn, layer.Own, 1);
  layer.Framebuffer->Bind();
  if (isNew)
  {
    layer.Framebuffer->AddDepthAttachment(layer.Depth);
    layer.Attached.clear();
  }
  for (std::size_t i = wanted.size(); i < layer.Attached.size(); ++i)
  {
    layer.Framebuffer->RemoveColorAttachment(static_cast<unsigned int>(i));
  }
  layer.Attached.resize(wanted.size(), nullptr);
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    if (layer.Attached[i] != wanted[i])
    {
      layer.Framebuffer->AddColorAttachment(static_cast<unsigned int>(i), wanted[i]);
    }
  }
  layer.Attached = wanted;
}

//------------------------------------------------------------------------------
bool vtkIsopointSplatPasses::RenderLayer(
  int index, const Settings& settings, const std::vector<Block>& blocks)
{
  if (index >= static_cast<int>(this->Layers.size()))
  {
    this->Layers.push_back(std::make_unique<Layer>());
  }
  Layer& layer = *this->Layers[index];
  this->PrepareLayer(layer, settings);
  bind(layer.Framebuffer, static_cast<unsigned int>(layer.Attached.size()));

  layer.SamplePositions = samplePositions(settings.Samples);

  vtkOpenGLState* const state = this->Window->GetState();
  state->vtkglDisable(GL_BLEND);
  clear(state);

  GLuint query = 0;
  if (index > 0)
  {
    glGenQueries(1, &query);
    glBeginQuery(GL_SAMPLES_PASSED, query);
  }
  state->vtkglColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  state->vtkglDepthFunc(GL_LESS);
  // Splats in front of the near plane must not hide anything, though this pass moves them back.
  glEnable(GL_CLIP_DISTANCE0 + MaximumNumberOfClippingPlanes);
  this->DrawBlocks(Pass::Visibility, index, settings, blocks);
  glDisable(GL_CLIP_DISTANCE0 + MaximumNumberOfClippingPlanes);
  if (index > 0)
  {
    GLuint samples = 0;
    glEndQuery(GL_SAMPLES_PASSED);
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &samples);
    glDeleteQueries(1, &query);
    if (samples == 0)
    {
      return false;
    }
  }

  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  state->vtkglDepthMask(GL_FALSE);
  state->vtkglDepthFunc(GL_LEQUAL);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendEquation(GL_FUNC_ADD);
  state->vtkglBlendFunc(GL_ONE, GL_ONE);
  this->DrawBlocks(Pass::Blend, index, settings, blocks);
  return true;
}

//------------------------------------------------------------------------------
void vtkIsopointSplatPasses::PrepareIds(const Settings& settings)
{
  if (!this->IdFramebuffer->GetContext())
  {
    this->IdFramebuffer->SetContext(this->Window);
    this->Ids->SetContext(this->Window);
    this->IdDepth->SetContext(this->Window);
  }
  const bool isNew = this->Ids->GetHandle() == 0;
  prepareColorTexture(this->Ids, settings.Size, 4, 0);
  prepareDepthTexture(this->IdDepth, settings.Size, 0);
  this->IdFramebuffer->Bind();
  if (isNew)
  {
    this->IdFramebuffer->AddDepthAttachment(this->IdDepth);
    this->IdFramebuffer->AddColorAttachment(0, this->Ids);
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatPasses::RenderIds(const Settings& settings, const std::vector<Block>& blocks)
{
  this->PrepareIds(settings);
  bind(this->IdFramebuffer, 1);
  vtkOpenGLState* const state = this->Window->GetState();
  state->vtkglDisable(GL_BLEND);
  clear(state);
  state->vtkglDepthFunc(GL_LESS);
  this->DrawBlocks(Pass::Ids, 0, settings, blocks);
}

//------------------------------------------------------------------------------
void vtkIsopointSplatPasses::DrawBlocks(
  Pass pass, int layer, const Settings& settings, const std::vector<Block>& blocks)
{
  vtkTextureObject* depth = nullptr;
  if (pass == Pass::Ids)
  {
    depth = this->Layers[0]->Depth;
  }
  else if (layer > 0)
  {
    depth = this->Layers[layer - 1]->Depth;
  }
  if (depth)
  {
    depth->Activate();
  }
  for (const Block& block : blocks)
  {
    vtkShaderProgram* const program = this->ReadyProgram(pass, layer > 0, settings, *block.Buffers);
    if (!program)
    {
      continue;
    }
    this->SetUniforms(program, pass, settings, block);
    if (depth)
    {
      program->SetUniformi(
        pass == Pass::Ids ? "visibleDepth" : "previousDepth", depth->GetTextureUnit());
    }
    block.Buffers->Draw(program);
  }
  if (depth)
  {
    depth->Deactivate();
  }
}

//------------------------------------------------------------------------------
vtkShaderProgram* vtkIsopointSplatPasses::ReadyProgram(
  Pass pass, bool isDeeper, const Settings& settings, const vtkIsopointSplatBuffers& buffers)
{
  std::string sources[3] = { vtkIsopointSplatVS, vtkIsopointSplatFS, vtkIsopointSplatGS };
  std::string definitions = pass == Pass::Visibility ? "#define SPLAT_VISIBILITY\n"
                            : pass == Pass::Blend    ? "#define SPLAT_BLEND\n"
                                                     : "#define SPLAT_IDS\n";
  const auto define = [&definitions](bool condition, const char* name)
  {
    if (condition)
    {
      definitions += std::string("#define ") + name + "\n";
    }
  };
  define(isDeeper, "SPLAT_DEEPER_LAYER");
  define(buffers.HasNormals(), "SPLAT_NORMALS");
  define(buffers.HasEllipses(), "SPLAT_ELLIPSES");
  define(buffers.HasGrowth(), "SPLAT_GROWTH");
  define(buffers.HasClips(), "SPLAT_CLIPS");
  define(buffers.HasColors() && pass == Pass::Blend, "SPLAT_COLORS");
  if (settings.Samples > 0 && pass != Pass::Ids)
  {
    definitions += "#define SPLAT_SAMPLES " + std::to_string(settings.Samples) + "\n";
    vtkShaderProgram::Substitute(
      sources[1], "//VTK::Samples::Dec", "#extension GL_ARB_sample_shading : require");
  }
  const bool hasOutline = settings.Samples > 0 && settings.HasColors;
  define(hasOutline, "SPLAT_OUTLINE");
  define(settings.Samples > 0 && !settings.HasColors, "SPLAT_OUTLINE_FOR_COLOR");
  define(settings.BlendsGhosts, "SPLAT_GHOSTS");
  define(settings.TranslucentColors, "SPLAT_TRANSLUCENT_COLORS");
  define(!settings.ClippingPlanes.empty(), "SPLAT_CLIPPED");

  // Their names cannot be defined: VTK replaces the text gl_FragData[number].
  int target = 2; // after the sums that are always there, in the order of PrepareLayer
  const auto place = [&](bool condition, const char* name)
  { vtkShaderProgram::Substitute(sources[1], name, std::to_string(condition ? target++ : 0)); };
  place(hasOutline, "OUTLINE_TARGET");
  place(settings.TranslucentColors, "OPACITY_TARGET");
  place(settings.BlendsGhosts, "OWN_TARGET");
  for (std::string& source : sources)
  {
    vtkShaderProgram::Substitute(source, "//VTK::Define::Dec", definitions);
  }
  return this->Window->GetShaderCache()->ReadyShaderProgram(
    sources[0].c_str(), sources[1].c_str(), sources[2].c_str());
}

//------------------------------------------------------------------------------
void vtkIsopointSplatPasses::SetUniforms(
  vtkShaderProgram* program, Pass pass, const Settings& settings, const Block& block)
{
  vtkNew<vtkMatrix4x4> centerToView;
  placeCenter(block.Buffers->GetCenter(), settings.ModelToView, centerToView);
  // Normals are transformed by the transposed inverse; OpenGL transposes matrices once more.
  vtkNew<vtkMatrix3x3> linear;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      linear->SetElement(row, column, centerToView->GetElement(row, column));
    }
  }
  const double viewScale = std::cbrt(std::abs(linear->Determinant()));
  vtkNew<vtkMatrix3x3> normalMatrix;
  vtkMatrix3x3::Invert(linear, normalMatrix);
  normalMatrix->Transpose();

  program->SetUniformMatrix("MCVCMatrix", centerToView);
  program->SetUniformMatrix("VCDCMatrix", settings.ViewToClip);
  program->SetUniformMatrix("normalMatrix", normalMatrix);
  const float size[2] = { static_cast<float>(settings.Size[0]),
    static_cast<float>(settings.Size[1]) };
  program->SetUniform2f("viewportSize", size);
  program->SetUniformf("radiusScale", static_cast<float>(settings.RadiusScale));
  program->SetUniformf("reach", static_cast<float>(pass == Pass::Blend ? blendingReach : 1.0));
  program->SetUniformf("viewScale", static_cast<float>(viewScale));
  program->SetUniformf("blendDepth", static_cast<float>(settings.BlendDepth));
  program->SetUniformf("minimumHalfAxis", minimumHalfAxis);
  program->SetUniformi("cameraParallel", settings.ParallelProjection ? 1 : 0);
  program->SetUniformi("culledFacing", settings.CulledFacing);
  program->SetUniform4f("plainColor", block.PlainColor.data());
  program->SetUniformf("blockIndex", static_cast<float>(block.Index));

  if (settings.Samples > 0 && pass != Pass::Ids)
  {
    SetSamplePositions(program, "samplePositions", *this->Layers[0]);
  }
  float planes[MaximumNumberOfClippingPlanes][4] = {};
  const int planeCount = static_cast<int>(settings.ClippingPlanes.size());
  for (int i = 0; i < planeCount; ++i)
  {
    for (int component = 0; component < 4; ++component)
    {
      planes[i][component] = static_cast<float>(settings.ClippingPlanes[i][component]);
    }
  }
  if (planeCount > 0)
  {
    program->SetUniformi("clippingPlaneCount", planeCount);
    program->SetUniform4fv("clippingPlanes", planeCount, planes);
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatPasses::ReleaseGraphicsResources()
{
  for (const std::unique_ptr<Layer>& layer : this->Layers)
  {
    this->ReleaseLayer(*layer);
  }
  this->Layers.clear();
  this->NumberOfLayers = 0;
  this->IdFramebuffer->ReleaseGraphicsResources(this->Window);
  this->Ids->ReleaseGraphicsResources(this->Window);
  this->IdDepth->ReleaseGraphicsResources(this->Window);
  this->State.clear();
  this->HasIds = false;
}

//------------------------------------------------------------------------------
void vtkIsopointSplatPasses::ReleaseLayer(Layer& layer)
{
  layer.Framebuffer->ReleaseGraphicsResources(this->Window);
  for (vtkTextureObject* texture : { layer.Depth.Get(), layer.Surface.Get(), layer.Color.Get(),
         layer.Opacity.Get(), layer.Own.Get(), layer.Outline.Get() })
  {
    texture->ReleaseGraphicsResources(this->Window);
  }
}
