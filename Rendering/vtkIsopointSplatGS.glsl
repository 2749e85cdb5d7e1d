//VTK::System::Dec

// SPDX-License-Identifier: GPL-3.0-or-later
// A triangle around a splat in its own plane: the rasterizer interpolates exact positions within
// the ellipse, in perspective too. In all passes the triangle covers the same fragments, at
// different depths.
//VTK::Define::Dec

layout(points) in;
layout(triangle_strip, max_vertices = 3) out;

in vec3 centerVS[];
#ifdef SPLAT_SAMPLES
in vec2 centerPixelsVS[];
in float slantVS[];
#endif
in vec3 axis1VS[];
in vec3 axis2VS[];
in vec3 normalVS[];
in vec4 colorVS[];
in float radiusVS[];
#ifdef SPLAT_CLIPS
in vec3 clipVS[];
flat in int isBehindCreaseVS[];
#endif
flat in uint pointIdVS[];
#ifdef SPLAT_GHOSTS
flat in float ownVS[];
#endif

uniform mat4 VCDCMatrix;
uniform int cameraParallel;
uniform float blendDepth; // in radii
uniform int clippingPlaneCount;
uniform vec4 clippingPlanes[6]; // in view coordinates

out vec2 placeGS; // position in the splat's plane, in half-axes: within the unit circle
#ifdef SPLAT_CLIPS
out float clipGS; // signed distance from the splat's clipping plane, in radii, negative beyond it
flat out int isBehindCreaseGS;
#endif
#ifdef SPLAT_BLEND
out float depthGS; // z in view coordinates
flat out vec3 normalGS;
flat out vec4 colorGS;
#ifdef SPLAT_SAMPLES
flat out vec2 centerPixelsGS;
flat out float slantGS;
#endif
#endif
#ifdef SPLAT_IDS
flat out uint pointIdGS;
#endif
#ifdef SPLAT_GHOSTS
flat out float ownGS;
#endif
#if defined(SPLAT_VISIBILITY)
out float gl_ClipDistance[7]; // the last one for the near plane, before the splat is moved back
#elif defined(SPLAT_CLIPPED)
out float gl_ClipDistance[6];
#endif
#ifdef SPLAT_DEEPER_LAYER
noperspective out float nearerDepthGS; // depth of the fragment, moved nearer by the blend depth
#endif

// Depth of a point moved along its view ray by a distance, away from the camera, but not beyond the
// far plane, where it would be clipped.
float movedDepth(vec3 point, float distance)
{
  vec3 ray = cameraParallel == 1 ? vec3(0.0, 0.0, -1.0) : normalize(point);
  vec4 moved = VCDCMatrix * vec4(point + distance * ray, 1.0);
  return moved.w > 0.0 ? min(moved.z / moved.w, 1.0 - 1e-6) : -1.0;
}

void emitCorner(vec2 place)
{
  vec3 corner = centerVS[0] + place.x * axis1VS[0] + place.y * axis2VS[0];
  gl_Position = VCDCMatrix * vec4(corner, 1.0);
  placeGS = place;
#ifdef SPLAT_CLIPS
  clipGS = clipVS[0].x + dot(clipVS[0].yz, place);
  isBehindCreaseGS = isBehindCreaseVS[0];
#endif
#ifdef SPLAT_BLEND
  depthGS = corner.z;
  normalGS = normalVS[0];
  colorGS = colorVS[0];
#ifdef SPLAT_SAMPLES
  centerPixelsGS = centerPixelsVS[0];
  slantGS = slantVS[0];
#endif
#endif
#ifdef SPLAT_IDS
  pointIdGS = pointIdVS[0];
#endif
#ifdef SPLAT_GHOSTS
  ownGS = ownVS[0];
#endif
#ifdef SPLAT_DEEPER_LAYER
  nearerDepthGS = 0.5 + 0.5 * movedDepth(corner, -blendDepth * radiusVS[0]);
#endif
#ifdef SPLAT_VISIBILITY
  gl_ClipDistance[6] = gl_Position.z + gl_Position.w;
  if (gl_Position.w > 0.0)
  {
    gl_Position.z = movedDepth(corner, blendDepth * radiusVS[0]) * gl_Position.w;
  }
#endif
#ifdef SPLAT_CLIPPED
  for (int i = 0; i < clippingPlaneCount; ++i)
  {
    gl_ClipDistance[i] = dot(clippingPlanes[i], vec4(corner, 1.0));
  }
#endif
  EmitVertex();
}

void main()
{
  if (!(radiusVS[0] > 0.0))
  {
    return;
  }
  emitCorner(vec2(0.0, 2.0));
  emitCorner(vec2(-sqrt(3.0), -1.0));
  emitCorner(vec2(sqrt(3.0), -1.0));
  EndPrimitive();
}
