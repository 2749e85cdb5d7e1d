  ivec2 splatPixel = ivec2(gl_FragCoord.xy) - splatOrigin;
#ifdef SPLAT_SAMPLES
  vec2 splatPosition = vec2(splatPixel) + 0.5 + splatSamplePositions[gl_SampleID];
  splatPixel = splatVisiblePixel(splatPixel, splatPosition);
  bool splatIsInside = splatPixel.x >= 0;
  splatPixel = max(splatPixel, ivec2(0));
#else
  const bool splatIsInside = true;
#endif
  vec4 splatColorSum = texelFetch(splatColorSums, splatPixel, splatSample);
  float splatWeight = splatColorSum.a;
  bool splatCovers = splatIsInside && splatWeight > 0.0 &&
    texelFetch(splatVisibleDepth, splatPixel, splatSample).r < 1.0;
  // Of a pixel where ghosts alone are seen, the rank that has these draws the same, or selects them.
  if (splatGhosts == 1)
  {
    splatCovers = splatCovers && texelFetch(splatOwnSums, splatPixel, splatSample).r > 0.0;
  }
  else if (splatGhosts == 2)
  {
    splatCovers = splatCovers && texelFetch(splatIds, splatPixel, 0).a > 0.0;
  }
  vec4 splatSurfaceSum = texelFetch(splatSurfaceSums, splatPixel, splatSample);
  float splatDepthVC = splatCovers ? splatSurfaceSum.w / splatWeight : -1.0;
  vec4 vertexVC = vec4(splatPlaceAt(vec2(splatPixel) + 0.5, splatDepthVC), 1.0);
  vec3 splatTowardsCamera = splatViewAt(vertexVC.xyz);
  vec3 splatNormal = dot(splatSurfaceSum.xyz, splatSurfaceSum.xyz) > 0.0
    ? normalize(splatSurfaceSum.xyz)
    : splatTowardsCamera;
#ifdef SPLAT_SAMPLES
  vertexVC.xyz = splatOnPlane(vertexVC.xyz, splatNormal, splatPosition);
#endif
  vec4 splatPlaceDC = splatVCDCMatrix * vertexVC;
  float splatDepth = clamp(0.5 + 0.5 * splatPlaceDC.z / splatPlaceDC.w, 0.0, 1.0);
  // Splats extend beyond the horizon of the surface, where blended normals may point away from the
  // camera. There the visible side is determined from the normals of the surface around.
  float splatSlant = dot(splatNormal, splatTowardsCamera);
  {
    int splatAround = splatCovers && abs(splatSlant) < 0.3 ? 9 : 0;
    ivec2 splatLastPixel = ivec2(splatViewportSize) - 1;
    for (int i = 0; i < splatAround; ++i)
    {
      ivec2 splatNear =
        clamp(splatPixel + 3 * ivec2(i % 3 - 1, i / 3 - 1), ivec2(0), splatLastPixel);
      vec3 splatNearSum = texelFetch(splatSurfaceSums, splatNear, splatSample).xyz;
      vec3 splatNearNormal = splatNearSum / max(length(splatNearSum), 1e-30);
      if (dot(splatNearNormal, splatNormal) > 0.7)
      {
        splatSlant += dot(splatNearNormal, splatTowardsCamera);
      }
    }
  }
  bool splatFrontFacing = splatSlant >= 0.0;
