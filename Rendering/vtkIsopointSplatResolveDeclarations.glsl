#ifdef SPLAT_SAMPLES
#define splatSums sampler2DMS
#define splatSample gl_SampleID
uniform vec2 splatSamplePositions[SPLAT_SAMPLES]; // in pixels, from the pixel's center
#else
#define splatSums sampler2D
#define splatSample 0 // the level
#endif
uniform splatSums splatVisibleDepth; // less than 1 where there are splats
uniform splatSums splatSurfaceSums; // weight x (normal, z) in view coordinates
uniform splatSums splatOutlineSums; // weight x (offset from the splat's center in pixels, squared slant)
uniform splatSums splatColorSums; // weight x color; alpha: the weight
uniform splatSums splatOpacitySums; // weight x opacity
uniform splatSums splatOwnSums; // weight, without that of ghosts
uniform sampler2D splatColorMap;
uniform sampler2D splatIds; // lower and upper 16 bits of the point's id, the block's id, 0: a ghost
uniform int splatColoring; // 0: the material's color, 1: colors, 2: coordinates in the color map
uniform int splatGhosts; // 0: none, 1: blended, 2: also among the ids
uniform int splatOpacities; // 1: each splat has its own opacity
uniform ivec2 splatOrigin; // of the viewport, in pixels
uniform vec2 splatViewportSize;
uniform mat4 splatVCDCMatrix;
uniform int splatCameraParallel;

// The place in view coordinates that is seen at a place on the screen, in pixels.
vec3 splatPlaceAt(vec2 pixels, float depth)
{
  vec4 placeDC = splatVCDCMatrix * vec4(0.0, 0.0, depth, 1.0);
  vec2 screen = 2.0 * pixels / splatViewportSize - 1.0;
  return vec3((screen * placeDC.w - placeDC.xy) /
      vec2(splatVCDCMatrix[0][0], splatVCDCMatrix[1][1]), depth);
}

// The direction to the camera.
vec3 splatViewAt(vec3 place)
{
  return splatCameraParallel == 1 ? vec3(0.0, 0.0, 1.0) : normalize(-place);
}

#ifdef SPLAT_SAMPLES
// Where a plane is seen at a place on the screen, in pixels: each sample has its own depth, so that
// intersections with other surfaces are smooth. Planes seen edge-on are taken as less slanted.
vec3 splatOnPlane(vec3 place, vec3 normal, vec2 pixels)
{
  vec3 onRay = splatPlaceAt(pixels, place.z);
  vec3 ray = splatPlaceAt(pixels, place.z + 1.0) - onRay;
  float slant = dot(normal, ray) / length(ray);
  slant = (slant < 0.0 ? -1.0 : 1.0) * max(abs(slant), 0.1);
  return onRay + dot(normal, place - onRay) / (slant * length(ray)) * ray;
}

// The blended normal at a pixel, zero where there are no splats, and the cosine between it and the
// direction to the camera.
vec4 splatNormalAt(ivec2 pixel)
{
  ivec2 inside = clamp(pixel, ivec2(0), ivec2(splatViewportSize) - 1);
  vec4 sum = texelFetch(splatSurfaceSums, inside, gl_SampleID);
  float weight = texelFetch(splatColorSums, inside, gl_SampleID).a;
  if (inside != pixel || !(weight > 0.0) || !(dot(sum.xyz, sum.xyz) > 0.0))
  {
    return vec4(0.0);
  }
  vec3 normal = normalize(sum.xyz);
  return vec4(normal, dot(normal, splatViewAt(splatPlaceAt(vec2(pixel) + 0.5, sum.w / weight))));
}

// Splats reach out beyond the horizon of a curved surface. A splat of a sphere lies where the sphere's
// normal is the splat's: the sphere's center is a radius behind that of the splat. On the screen the
// average center of the splats that are blended at a sample is known from their average offset and
// their average normal, and a sample farther from it than the radius is not of this surface, but of
// that seen next to it. The sphere's curvature in pixels is that of normals on the pixels inside.
ivec2 splatVisiblePixel(ivec2 pixel, vec2 position)
{
  vec4 here = splatNormalAt(pixel);
  bool isSlanted = abs(here.w) <= 0.5 && here.xyz != vec3(0.0);
  // Some drivers evaluate both branches of a condition, but end a loop without iterations.
  int around = isSlanted ? 9 : 0;
  float facing = here.w;
  for (int i = 0; i < around; ++i)
  {
    vec4 near = splatNormalAt(pixel + 3 * ivec2(i % 3 - 1, i / 3 - 1));
    facing += dot(near.xyz, here.xyz) > 0.7 ? near.w : 0.0;
  }
  vec3 normal = facing < 0.0 ? -here.xyz : here.xyz;
  vec2 outwards = normal.xy / max(length(normal.xy), 1e-6);
  // Of the line, the sum of weights, of distances, of their squares, of sines, of products.
  float count = 0.0;
  float sumX = 0.0;
  float sumXX = 0.0;
  float sumY = 0.0;
  float sumXY = 0.0;
  float least = 1.0;
  int inside = isSlanted ? 4 : 0;
  for (int i = 0; i < inside; ++i)
  {
    ivec2 tap = ivec2(floor(position - (1.5 + 1.5 * float(i)) * outwards));
    vec4 there = splatNormalAt(tap);
    if (dot(there.xyz, here.xyz) < 0.7)
    {
      break;
    }
    float x = dot(vec2(tap) + 0.5 - position, outwards);
    float y = sqrt(max(1.0 - there.w * there.w, 0.0));
    least = min(least, y);
    count += 1.0;
    sumX += x;
    sumXX += x * x;
    sumY += y;
    sumXY += x * y;
  }
  if (count < 2.0 || least > 0.999)
  {
    return pixel;
  }
  float slope = (count * sumXY - sumX * sumY) / (count * sumXX - sumX * sumX);
  vec3 average = texelFetch(splatOutlineSums, pixel, gl_SampleID).xyz /
    texelFetch(splatColorSums, pixel, gl_SampleID).a;
  vec2 offset = average.xy + position - (vec2(pixel) + 0.5);
  float across = sqrt(max(1.0 - average.z, 0.0));
  bool isBeyond = slope > 0.0 && across + slope * dot(offset, outwards) > 1.0 - 0.05 * slope;
  int outside = isBeyond ? 4 : 0;
  for (int i = 1; i < outside; ++i)
  {
    ivec2 tap = ivec2(floor(position + float(i) * outwards));
    vec4 there = splatNormalAt(tap);
    if (there.xyz == vec3(0.0))
    {
      return ivec2(-1);
    }
    if (dot(there.xyz, normal) < 0.7)
    {
      return tap;
    }
  }
  return pixel;
}
#endif
