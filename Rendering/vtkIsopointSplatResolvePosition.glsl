  ivec2 splatPixel = ivec2(gl_FragCoord.xy) - splatOrigin;
  vec4 splatColorSum = texelFetch(splatColorSums, splatPixel, 0);
  float splatWeight = splatColorSum.a;
  bool splatCovers = texelFetch(splatVisibleDepth, splatPixel, 0).r < 1.0 && splatWeight > 0.0;
  // Of a pixel where ghosts alone are seen, the rank that has these draws the same, or selects them.
  if (splatGhosts == 1)
  {
    splatCovers = splatCovers && texelFetch(splatOwnSums, splatPixel, 0).r > 0.0;
  }
  else if (splatGhosts == 2)
  {
    splatCovers = splatCovers && texelFetch(splatIds, splatPixel, 0).a > 0.0;
  }
  vec4 splatSurfaceSum = texelFetch(splatSurfaceSums, splatPixel, 0);
  float splatDepthVC = splatCovers ? splatSurfaceSum.w / splatWeight : -1.0;
  vec4 splatPlaceDC = splatVCDCMatrix * vec4(0.0, 0.0, splatDepthVC, 1.0);
  vec2 splatScreen = 2.0 * (vec2(splatPixel) + 0.5) / splatViewportSize - 1.0;
  vec4 vertexVC = vec4((splatScreen * splatPlaceDC.w - splatPlaceDC.xy) /
      vec2(splatVCDCMatrix[0][0], splatVCDCMatrix[1][1]), splatDepthVC, 1.0);
  float splatDepth = clamp(0.5 + 0.5 * splatPlaceDC.z / splatPlaceDC.w, 0.0, 1.0);
  vec3 splatTowardsCamera =
    splatCameraParallel == 1 ? vec3(0.0, 0.0, 1.0) : normalize(-vertexVC.xyz);
  vec3 splatNormal = dot(splatSurfaceSum.xyz, splatSurfaceSum.xyz) > 0.0
    ? normalize(splatSurfaceSum.xyz)
    : splatTowardsCamera;
  // Splats extend beyond the horizon of the surface, where blended normals may point away from the
  // camera. There the visible side is determined from the normals of the surface around.
  float splatSlant = dot(splatNormal, splatTowardsCamera);
  if (splatCovers && abs(splatSlant) < 0.3)
  {
    ivec2 splatLastPixel = textureSize(splatSurfaceSums, 0) - 1;
    for (int i = 0; i < 9; ++i)
    {
      ivec2 splatNear =
        clamp(splatPixel + 3 * ivec2(i % 3 - 1, i / 3 - 1), ivec2(0), splatLastPixel);
      vec3 splatNearSum = texelFetch(splatSurfaceSums, splatNear, 0).xyz;
      vec3 splatNearNormal = splatNearSum / max(length(splatNearSum), 1e-30);
      if (dot(splatNearNormal, splatNormal) > 0.7)
      {
        splatSlant += dot(splatNearNormal, splatTowardsCamera);
      }
    }
  }
  bool splatFrontFacing = splatSlant >= 0.0;
