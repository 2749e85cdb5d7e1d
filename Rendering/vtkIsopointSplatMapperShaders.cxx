// SPDX-License-Identifier: GPL-3.0-or-later
// Replacements in the fragment shader of vtkOpenGLPolyDataMapper by which it shades the blended
// surface.
#include "vtkIsopointSplatMapper.h"

#include "vtkIsopointSplatMapperInternals.h"
#include "vtkIsopointSplatResolveColor.h"
#include "vtkIsopointSplatResolveDeclarations.h"
#include "vtkIsopointSplatResolvePosition.h"
#include "vtkIsopointSplatResolveVS.h"

#include "vtkActor.h"
#include "vtkHardwareSelector.h"
#include "vtkOpenGLHelper.h"
#include "vtkProperty.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"

#include <string>

namespace
{

void substitute(const std::map<vtkShader::Type, vtkShader*>& shaders, const std::string& tag,
  const std::string& text)
{
  vtkShaderProgram::Substitute(shaders.at(vtkShader::Fragment), tag, text);
}

} // namespace

//------------------------------------------------------------------------------
bool vtkIsopointSplatMapper::GetNeedToRebuildShaders(
  vtkOpenGLHelper& helper, vtkRenderer* renderer, vtkActor* actor)
{
  const bool isComposite = this->Internal->Blocks.IsComposite();
  const int samples = this->Internal->Samples;
  const bool differs =
    isComposite != this->Internal->ShaderOfComposite || samples != this->Internal->ShaderOfSamples;
  this->Internal->ShaderOfComposite = isComposite;
  this->Internal->ShaderOfSamples = samples;
  return this->Superclass::GetNeedToRebuildShaders(helper, renderer, actor) || differs;
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::GetShaderTemplate(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::GetShaderTemplate(shaders, renderer, actor);
  shaders[vtkShader::Vertex]->SetSource(vtkIsopointSplatResolveVS);
  shaders[vtkShader::Geometry]->SetSource("");
  if (this->Internal->Samples > 0)
  {
    const std::string tag = "//VTK::System::Dec";
    substitute(shaders, tag,
      tag + "\n#extension GL_ARB_sample_shading : require\n#define SPLAT_SAMPLES " +
        std::to_string(this->Internal->Samples));
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::ReplaceShaderColor(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor)
{
  const std::string tag = "//VTK::Color::Impl";
  const std::string ownTag = "//VTK::SplatColor::Impl";
  substitute(shaders, tag, tag + "\n" + ownTag);
  this->Superclass::ReplaceShaderColor(shaders, renderer, actor);
  substitute(shaders, ownTag, vtkIsopointSplatResolveColor);
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::ReplaceShaderPositionVC(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer*, vtkActor*)
{
  substitute(shaders, "//VTK::Camera::Dec", "uniform int cameraParallel;");
  substitute(shaders, "//VTK::PositionVC::Dec", vtkIsopointSplatResolveDeclarations);
  substitute(shaders, "//VTK::PositionVC::Impl", vtkIsopointSplatResolvePosition);
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::ReplaceShaderNormal(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer*, vtkActor* actor)
{
  std::string normal = "vec3 normalVCVSOutput = splatFrontFacing ? splatNormal : -splatNormal;\n";
  if (actor->GetProperty()->GetCoatStrength() > 0.0)
  {
    normal += "  vec3 coatNormalVCVSOutput = normalVCVSOutput;\n";
  }
  substitute(shaders, "//VTK::Normal::Impl", normal);
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::ReplaceShaderCoincidentOffset(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor)
{
  float factor = 0.0f;
  float offset = 0.0f;
  this->GetCoincidentParameters(renderer, actor, factor, offset);
  if (factor != 0.0f || offset != 0.0f)
  {
    substitute(shaders, "//VTK::Coincident::Dec",
      "uniform float cFactor;\n"
      "uniform float cOffset;\n");
    substitute(shaders, "//VTK::UniformFlow::Impl",
      "float splatSlope = length(vec2(dFdx(splatDepth), dFdy(splatDepth)));\n"
      "  splatDepth += cFactor * splatSlope + cOffset / 65000.0;\n"
      "  //VTK::UniformFlow::Impl\n");
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::ReplaceShaderDepth(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer*, vtkActor*)
{
  substitute(shaders, "//VTK::Depth::Impl",
    "if (!splatCovers)\n"
    "  {\n"
    "    discard;\n"
    "  }\n"
    "  gl_FragDepth = splatDepth;\n");
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::ReplaceShaderRenderPass(std::map<vtkShader::Type, vtkShader*> shaders,
  vtkRenderer* renderer, vtkActor* actor, bool prePass)
{
  this->Superclass::ReplaceShaderRenderPass(shaders, renderer, actor, prePass);
  if (!prePass)
  {
    // The built-in variables describe the triangle over the viewport, not the surface.
    vtkShader* const fragment = shaders[vtkShader::Fragment];
    std::string source = fragment->GetSource();
    vtkShaderProgram::Substitute(source, "gl_FrontFacing", "splatFrontFacing");
    vtkShaderProgram::Substitute(source, "gl_FragCoord.z", "splatDepth");
    vtkShaderProgram::Substitute(source, "gl_FragCoord.w", "(1.0 / splatPlaceDC.w)");
    fragment->SetSource(source);
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::ReplaceShaderPicking(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer*, vtkActor*)
{
  const int pass = this->LastSelectionState;
  if (pass < vtkHardwareSelector::MIN_KNOWN_PASS)
  {
    return;
  }
  const std::string id = "  vec4 splatId = texelFetch(splatIds, splatPixel, 0);\n"
                         "  int splatPoint = int(splatId.r) + (int(splatId.g) << 16);\n";
  const auto lowBytes = [](const std::string& value)
  {
    return "  gl_FragData[0] = vec4(vec3(" + value + " & 0xff, (" + value + " >> 8) & 0xff, (" +
           value + " >> 16) & 0xff) / 255.0, 1.0);\n";
  };
  switch (pass)
  {
    // Ids of cells follow from those of points, see ProcessSelectorPixelBuffers.
    case vtkHardwareSelector::POINT_ID_LOW24:
    case vtkHardwareSelector::CELL_ID_LOW24:
      substitute(shaders, "//VTK::Picking::Impl", id + lowBytes("splatPoint"));
      break;
    case vtkHardwareSelector::POINT_ID_HIGH24:
    case vtkHardwareSelector::CELL_ID_HIGH24:
      substitute(shaders, "//VTK::Picking::Impl",
        id + "  gl_FragData[0] = vec4(float((splatPoint >> 24) & 0xff) / 255.0, 0.0, 0.0, 1.0);\n");
      break;
    case vtkHardwareSelector::COMPOSITE_INDEX_PASS:
      if (this->Internal->Blocks.IsComposite())
      {
        substitute(shaders, "//VTK::Picking::Impl",
          id + "  int splatBlock = int(splatId.b);\n" + lowBytes("splatBlock"));
        break;
      }
      [[fallthrough]];
    default:
      substitute(shaders, "//VTK::Picking::Dec", "uniform vec3 mapperIndex;");
      substitute(shaders, "//VTK::Picking::Impl", "  gl_FragData[0] = vec4(mapperIndex, 1.0);\n");
  }
}
