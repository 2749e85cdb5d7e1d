// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointTracedDisplay.h"

#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

// VTK 9.4 replaced the OpenGL loader.
#if __has_include("vtk_glad.h")
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif

namespace
{

const char* const fragmentShader = R"(//VTK::System::Dec
in vec2 texCoord;
uniform sampler2D tracedColors;
uniform sampler2D tracedDepths;
//VTK::Output::Dec
void main()
{
  gl_FragData[0] = texture(tracedColors, texCoord);
  gl_FragDepth = texture(tracedDepths, texCoord).r;
}
)";

void upload(vtkTextureObject* texture, vtkOpenGLRenderWindow* window, int width, int height,
  int components, const std::vector<float>& pixels)
{
  texture->SetContext(window);
  texture->SetMinificationFilter(vtkTextureObject::Nearest);
  texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  texture->Create2DFromRaw(static_cast<unsigned int>(width), static_cast<unsigned int>(height),
    components, VTK_FLOAT, const_cast<float*>(pixels.data()));
}

} // namespace

vtkIsopointTracedDisplay::vtkIsopointTracedDisplay() = default;
vtkIsopointTracedDisplay::~vtkIsopointTracedDisplay() = default;

void vtkIsopointTracedDisplay::Draw(vtkOpenGLRenderWindow* window, int width, int height,
  const std::vector<float>& colors, const std::vector<float>& depths)
{
  if (!this->Quad)
  {
    this->Quad = std::make_unique<vtkOpenGLQuadHelper>(window, nullptr, fragmentShader, nullptr);
  }
  else
  {
    window->GetShaderCache()->ReadyShaderProgram(this->Quad->Program);
  }
  if (!this->Quad->Program || !this->Quad->Program->GetCompiled())
  {
    return;
  }
  upload(this->Colors, window, width, height, 4, colors);
  upload(this->Depths, window, width, height, 1, depths);
  vtkOpenGLState* const state = window->GetState();
  vtkOpenGLState::ScopedglEnableDisable const blending(state, GL_BLEND);
  vtkOpenGLState::ScopedglEnableDisable const depthTest(state, GL_DEPTH_TEST);
  vtkOpenGLState::ScopedglBlendFuncSeparate const function(state);
  vtkOpenGLState::ScopedglDepthMask const mask(state);
  vtkOpenGLState::ScopedglDepthFunc const comparison(state);
  state->vtkglEnable(GL_BLEND);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(GL_LEQUAL);
  state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  this->Colors->Activate();
  this->Depths->Activate();
  this->Quad->Program->SetUniformi("tracedColors", this->Colors->GetTextureUnit());
  this->Quad->Program->SetUniformi("tracedDepths", this->Depths->GetTextureUnit());
  this->Quad->Render();
  this->Colors->Deactivate();
  this->Depths->Deactivate();
}

void vtkIsopointTracedDisplay::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Quad.reset();
  this->Colors->ReleaseGraphicsResources(window);
  this->Depths->ReleaseGraphicsResources(window);
}
