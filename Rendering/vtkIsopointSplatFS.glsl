//VTK::System::Dec

// SPDX-License-Identifier: GPL-3.0-or-later
// The fragments of the off-screen passes: visibility (depth alone), blending (weighted sums of
// what the surface is made of) and ids (of the splat whose centre is nearest).
// Blending writes weight x (normal, z), weight x (color, 1) and weight x opacity; ids are written
// as the lower and upper 16 bits of the point's, and the block's.
//VTK::Define::Dec

in vec2 placeGS;
#ifdef SPLAT_BLEND
in float depthGS;
flat in vec3 normalGS;
flat in vec4 colorGS;
#endif
#ifdef SPLAT_IDS
flat in uint pointIdGS;
uniform float blockIndex;
uniform sampler2D visibleDepth;
#endif
#ifdef SPLAT_DEEPER_LAYER
noperspective in float nearerDepthGS;
uniform sampler2D previousDepth;
#endif

//VTK::Output::Dec

void main()
{
  float squaredRadius = dot(placeGS, placeGS);
  if (squaredRadius > 1.0)
  {
    discard;
  }
#ifdef SPLAT_DEEPER_LAYER
  if (nearerDepthGS <= texelFetch(previousDepth, ivec2(gl_FragCoord.xy), 0).r)
  {
    discard;
  }
#endif
#ifdef SPLAT_BLEND
  float weight = (1.0 - squaredRadius) * (1.0 - squaredRadius) + 1e-4;
  gl_FragData[0] = weight * vec4(normalGS, depthGS);
  gl_FragData[1] = weight * vec4(colorGS.rgb, 1.0);
#ifdef SPLAT_TRANSLUCENT_COLORS
  gl_FragData[2] = vec4(weight * colorGS.a);
#endif
#endif
#ifdef SPLAT_IDS
  if (gl_FragCoord.z > texelFetch(visibleDepth, ivec2(gl_FragCoord.xy), 0).r)
  {
    discard;
  }
  gl_FragData[0] = vec4(float(pointIdGS & 0xffffu), float(pointIdGS >> 16u), blockIndex, 1.0);
  gl_FragDepth = sqrt(squaredRadius);
#endif
}
