//VTK::System::Dec
//VTK::Samples::Dec

// SPDX-License-Identifier: GPL-3.0-or-later
// The fragments of the off-screen passes: visibility (depth only), blending (weighted sums of the
// surface's attributes) and ids (of the splat whose center is nearest).
// Blending writes weight x (normal, z), weight x (color, 1), weight x opacity and, among ghosts, the
// weight of others; for samples weight x (offset on the screen from the splat's center in pixels,
// squared cosine between normal and view), in place of the color where all have the same one. Splats
// have the same value at all samples of a pixel that they cover. Ids are written as the lower and
// upper 16 bits of the point's id, the block's id, and 0 for a ghost or 1.
//VTK::Define::Dec

in vec2 placeGS;
#ifdef SPLAT_CLIPS
in float clipGS;
flat in int isBehindCreaseGS;
#endif
#ifdef SPLAT_BLEND
in float depthGS;
flat in vec3 normalGS;
flat in vec4 colorGS;
#ifdef SPLAT_SAMPLES
flat in vec2 centerPixelsGS;
flat in float slantGS;
#endif
#endif
#ifdef SPLAT_IDS
flat in uint pointIdGS;
uniform float blockIndex;
uniform sampler2D visibleDepth;
#endif
#ifdef SPLAT_GHOSTS
flat in float ownGS;
#endif
#ifdef SPLAT_DEEPER_LAYER
noperspective in float nearerDepthGS;
uniform sampler2D previousDepth;
#endif

//VTK::Output::Dec

#ifdef SPLAT_SAMPLES
uniform vec2 samplePositions[SPLAT_SAMPLES]; // in pixels, from the pixel's center
#endif

#ifdef SPLAT_CLIPS
// Overlap in pixels of faces at a crease, so that there is no slit where their planes differ
// slightly.
const float slit = 0.05;
#endif

void main()
{
  float squaredRadius = dot(placeGS, placeGS);
#ifdef SPLAT_CLIPS
  float pixel = fwidth(clipGS);
  bool isBeyond = clipGS < 0.0;
  bool isBehind = isBehindCreaseGS == 1;
#endif
#ifdef SPLAT_SAMPLES
  vec2 placeX = dFdx(placeGS);
  vec2 placeY = dFdy(placeGS);
#ifdef SPLAT_CLIPS
  float clipX = dFdx(clipGS);
  float clipY = dFdy(clipGS);
#endif
  int mask = 0;
  for (int i = 0; i < SPLAT_SAMPLES; ++i)
  {
    vec2 offset = samplePositions[i];
    vec2 place = placeGS + offset.x * placeX + offset.y * placeY;
    bool isInside = dot(place, place) <= 1.0;
#ifdef SPLAT_CLIPS
    isInside = isInside && clipGS + offset.x * clipX + offset.y * clipY >= -slit * pixel;
#endif
    mask |= isInside ? 1 << i : 0;
  }
  if (mask == 0)
  {
    discard;
  }
  gl_SampleMask[0] = mask;
  squaredRadius = min(squaredRadius, 1.0);
#else
  if (squaredRadius > 1.0)
  {
    discard;
  }
#endif
#if defined(SPLAT_CLIPS) && !defined(SPLAT_SAMPLES)
  // Twice the overlap in the other passes, so that every visible fragment has a weight despite
  // rounding.
#ifdef SPLAT_VISIBILITY
  if (clipGS < -slit * pixel)
#else
  if (clipGS < -2.0 * slit * pixel)
#endif
  {
    discard;
  }
#endif
#ifdef SPLAT_DEEPER_LAYER
  if (nearerDepthGS <= texelFetch(previousDepth, ivec2(gl_FragCoord.xy), 0).r)
  {
    discard;
  }
#endif
#ifdef SPLAT_BLEND
  float weight = (1.0 - squaredRadius) * (1.0 - squaredRadius) + 1e-4;
#ifdef SPLAT_CLIPS
  // A splat beyond its plane is seen only where there is no other splat; one hidden by the face
  // across the crease has an even lower weight.
  weight *= (isBeyond ? 1e-3 : 1.0) * (isBehind ? 1e-6 : 1.0);
#endif
  gl_FragData[0] = weight * vec4(normalGS, depthGS);
#ifdef SPLAT_SAMPLES
  vec3 outline = vec3(floor(gl_FragCoord.xy) + 0.5 - centerPixelsGS, slantGS);
#endif
#ifdef SPLAT_OUTLINE_FOR_COLOR
  gl_FragData[1] = weight * vec4(outline, 1.0);
#else
  gl_FragData[1] = weight * vec4(colorGS.rgb, 1.0);
#endif
#ifdef SPLAT_OUTLINE
  gl_FragData[OUTLINE_TARGET] = vec4(weight * outline, 0.0);
#endif
#ifdef SPLAT_TRANSLUCENT_COLORS
  gl_FragData[OPACITY_TARGET] = vec4(weight * colorGS.a);
#endif
#ifdef SPLAT_GHOSTS
  gl_FragData[OWN_TARGET] = vec4(weight * ownGS);
#endif
#endif
#ifdef SPLAT_IDS
  if (gl_FragCoord.z > texelFetch(visibleDepth, ivec2(gl_FragCoord.xy), 0).r)
  {
    discard;
  }
  gl_FragData[0] = vec4(float(pointIdGS & 0xffffu), float(pointIdGS >> 16u), blockIndex, 1.0);
#ifdef SPLAT_GHOSTS
  gl_FragData[0].a = ownGS;
#endif
  float distance = 0.5 * sqrt(squaredRadius);
#ifdef SPLAT_CLIPS
  distance += isBeyond || isBehind ? 0.5 : 0.0;
#endif
  gl_FragDepth = distance;
#endif
}
