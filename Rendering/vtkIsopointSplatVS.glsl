//VTK::System::Dec

// SPDX-License-Identifier: GPL-3.0-or-later
// Computes two conjugate half-axes of a splat's ellipse in view coordinates whose projections on
// the screen are orthogonal. Where the shorter one is less than about half a pixel, it is
// lengthened without a change of the other one, so that no splat falls between pixel centers.
//VTK::Define::Dec

in vec3 centerMC;
in float radius; // 0: not drawn; negative: of a ghost
#ifdef SPLAT_NORMALS
in vec3 normalMC;
#endif
#ifdef SPLAT_ELLIPSES
in vec3 axis1MC;
in vec3 axis2MC;
#endif
#ifdef SPLAT_GROWTH
in float growth; // factor on the splat's size
#endif
#ifdef SPLAT_CLIPS
in vec4 clipMC; // clipping plane: normal divided by the radius, the center's distance in radii
in float clipTurn; // 1: the face across the crease is on the normal's side, -1: on the other side
#endif
#ifdef SPLAT_COLORS
in vec4 color;
#endif

uniform mat4 MCVCMatrix;
uniform mat3 normalMatrix;
uniform mat4 VCDCMatrix;
uniform vec2 viewportSize; // in pixels
uniform float radiusScale;
uniform float reach; // factor on the half-axes, applied after they were lengthened
uniform float viewScale; // length in view coordinates of a unit length in model coordinates
uniform float minimumHalfAxis; // in pixels
uniform vec4 plainColor; // of splats without a color of their own
uniform int cameraParallel;
uniform int culledFacing; // 1: front faces are not drawn, -1: back faces, 0: all are

out vec3 centerVS;
#ifdef SPLAT_SAMPLES
out vec2 centerPixelsVS; // the center on the screen
out float slantVS; // squared cosine between the normal and the direction to the camera
#endif
out vec3 axis1VS;
out vec3 axis2VS;
out vec3 normalVS;
out vec4 colorVS;
out float radiusVS; // along the view, in view coordinates
#ifdef SPLAT_CLIPS
out vec3 clipVS; // distance from the plane, in radii: of the center, and its change along each axis
flat out int isBehindCreaseVS; // 1 where the face across the crease hides this one
#endif
flat out uint pointIdVS;
#ifdef SPLAT_GHOSTS
flat out float ownVS; // 0: of a ghost, else 1
#endif

// Two unit vectors orthogonal to a unit vector and to each other, continuous except at z = 0
// [DBC+17].
void tangents(vec3 n, out vec3 t1, out vec3 t2)
{
  float s = n.z >= 0.0 ? 1.0 : -1.0;
  float a = -1.0 / (s + n.z);
  float b = n.x * n.y * a;
  t1 = vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
  t2 = vec3(b, s + n.y * n.y * a, -n.y);
}

// The projection of an offset from the center on the screen, in pixels.
vec2 toPixels(vec3 offset, vec4 centerDC)
{
  vec4 offsetDC = VCDCMatrix * vec4(offset, 0.0);
  return 0.5 * viewportSize * (offsetDC.xy - centerDC.xy / centerDC.w * offsetDC.w) / centerDC.w;
}

// The offset parallel to the screen whose projection has a given length in pixels.
vec3 fromPixels(vec2 pixels, vec4 centerDC)
{
  return vec3(
    pixels * centerDC.w / (0.5 * viewportSize * vec2(VCDCMatrix[0][0], VCDCMatrix[1][1])), 0.0);
}

void main()
{
  vec4 centerVC = MCVCMatrix * vec4(centerMC, 1.0);
  vec3 center = centerVC.xyz;
  vec3 towardsCamera = cameraParallel == 1 ? vec3(0.0, 0.0, 1.0) : normalize(-center);
#ifdef SPLAT_GROWTH
  float scale = radiusScale * growth;
#else
  float scale = radiusScale;
#endif
#ifdef SPLAT_GHOSTS
  float r = abs(radius) * scale;
  ownVS = radius < 0.0 ? 0.0 : 1.0;
#else
  float r = max(radius, 0.0) * scale;
#endif
  float radiusVC = r * viewScale;
  vec3 normal = vec3(0.0);
  vec3 axis1;
  vec3 axis2;
  bool hasNormal = false;
#ifdef SPLAT_NORMALS
  normal = normalMatrix * normalMC;
  // Decided before the division by the length, since OpenGL leaves open what follows of 0 / 0. False
  // also where the transform is singular.
  hasNormal = dot(normal, normal) > 0.0;
  normal = normalize(normal);
  tangents(normalize(normalMC), axis1, axis2);
  axis1 = mat3(MCVCMatrix) * (axis1 * r);
  axis2 = mat3(MCVCMatrix) * (axis2 * r);
#endif
  if (!hasNormal)
  {
    normal = towardsCamera;
    tangents(normal, axis1, axis2);
    axis1 *= radiusVC;
    axis2 *= radiusVC;
  }
#ifdef SPLAT_ELLIPSES
  if (dot(axis1MC, axis1MC) > 0.0 && dot(axis2MC, axis2MC) > 0.0)
  {
    axis1 = mat3(MCVCMatrix) * (axis1MC * scale);
    axis2 = mat3(MCVCMatrix) * (axis2MC * scale);
  }
#endif

  vec4 centerDC = VCDCMatrix * vec4(center, 1.0);
  if (centerDC.w > 0.0)
  {
    vec2 p1 = toPixels(axis1, centerDC);
    vec2 p2 = toPixels(axis2, centerDC);
    // Cosine and sine of half the angle of the vector (difference, 2 x product).
    float product = dot(p1, p2);
    float halfDifference = 0.5 * (dot(p1, p1) - dot(p2, p2));
    float size = length(vec2(halfDifference, product));
    float cosine = size > 0.0 ? sqrt(max(0.5 + 0.5 * halfDifference / size, 0.0)) : 1.0;
    float sine = size > 0.0 ? sqrt(max(0.5 - 0.5 * halfDifference / size, 0.0)) : 0.0;
    sine = product < 0.0 ? -sine : sine;
    vec3 longer = cosine * axis1 + sine * axis2;
    vec3 shorter = cosine * axis2 - sine * axis1;
    vec2 longerPixels = cosine * p1 + sine * p2;
    vec2 shorterPixels = cosine * p2 - sine * p1;
    if (length(longerPixels) < minimumHalfAxis)
    {
      longerPixels = vec2(minimumHalfAxis, 0.0);
      longer = fromPixels(longerPixels, centerDC);
      shorter = fromPixels(vec2(0.0, minimumHalfAxis), centerDC);
    }
    else if (length(longerPixels) < 2.0 && length(shorterPixels) < minimumHalfAxis)
    {
      vec2 direction = normalize(vec2(-longerPixels.y, longerPixels.x));
      shorter = fromPixels(direction * minimumHalfAxis, centerDC);
    }
    axis1 = longer;
    axis2 = shorter;
  }

  bool facesCamera = dot(normal, towardsCamera) >= 0.0;
  bool culled = facesCamera ? culledFacing == 1 : culledFacing == -1;

  centerVS = center;
#ifdef SPLAT_SAMPLES
  slantVS = dot(normal, towardsCamera) * dot(normal, towardsCamera);
  centerPixelsVS = (0.5 + 0.5 * centerDC.xy / centerDC.w) * viewportSize;
#endif
  axis1VS = reach * axis1;
  axis2VS = reach * axis2;
  normalVS = normal;
  // The radius along the view ray: where the transform flattens the surface, the distance between
  // its two sides shrinks by the same factor.
  radiusVS = culled ? 0.0 : r / length(towardsCamera * normalMatrix);
#ifdef SPLAT_CLIPS
  // Planes are transformed by the transposed inverse, as normals are.
  vec3 clip = normalMatrix * clipMC.xyz;
  clipVS = vec3(clipMC.w, dot(clip, axis1VS), dot(clip, axis2VS));
  bool turnsTowardsCamera = hasNormal && facesCamera == (clipTurn > 0.0);
  isBehindCreaseVS = turnsTowardsCamera && dot(clip, towardsCamera) < 0.0 ? 1 : 0;
#endif
#ifdef SPLAT_COLORS
  colorVS = color;
#else
  colorVS = plainColor;
#endif
  pointIdVS = uint(gl_VertexID);
  gl_Position = centerDC;
}
