  ivec2 splatPixel = ivec2(gl_FragCoord.xy) - splatOrigin;
  vec4 splatColorSum = texelFetch(splatColorSums, splatPixel, 0);
  float splatWeight = splatColorSum.a;
  bool splatCovers = splatWeight > 0.0;
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
  // Disks stick out over the horizon, where blended normals lean over it, too. Which side is seen
  // there is what the surface around tells, and along the outline pixels that only rims cover are
  // left out; those within the outline never are.
  float splatSlant = dot(splatNormal, splatTowardsCamera);
  if (splatCovers && abs(splatSlant) < 0.3)
  {
    bool splatAtOutline = false;
    float splatSide = splatSlant;
    ivec2 splatLastPixel = textureSize(splatColorSums, 0) - 1;
    for (int i = 0; i < 9; ++i)
    {
      ivec2 splatDirection = ivec2(i % 3 - 1, i / 3 - 1);
      ivec2 splatNext = clamp(splatPixel + splatDirection, ivec2(0), splatLastPixel);
      splatAtOutline = splatAtOutline || texelFetch(splatColorSums, splatNext, 0).a <= 0.0;
      ivec2 splatNear = clamp(splatPixel + 3 * splatDirection, ivec2(0), splatLastPixel);
      vec3 splatNearSum = texelFetch(splatSurfaceSums, splatNear, 0).xyz;
      vec3 splatNearNormal = splatNearSum / max(length(splatNearSum), 1e-30);
      if (dot(splatNearNormal, splatNormal) > 0.7)
      {
        splatSide += dot(splatNearNormal, splatTowardsCamera);
      }
    }
    splatSlant = splatSide < 0.0 ? -abs(splatSlant) : abs(splatSlant);
    splatCovers = !(splatAtOutline && splatWeight < 0.2 * (1.0 - abs(splatSlant) / 0.3));
  }
  bool splatFrontFacing = splatSlant >= 0.0;
