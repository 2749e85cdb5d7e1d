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
  // Blended normals lean over the horizon a little: that is not yet the back.
  bool splatFrontFacing = dot(splatNormal, splatTowardsCamera) > -0.1;
  // Disks stick out over the horizon. Where the surface turns away and only rims cover, the pixels
  // along the outline are left out; those within it never are.
  if (splatCovers &&
    splatWeight < 0.2 * (1.0 - abs(dot(splatNormal, splatTowardsCamera)) / 0.3))
  {
    for (int i = 0; i < 9; ++i)
    {
      ivec2 splatNeighbor = clamp(
        splatPixel + ivec2(i % 3 - 1, i / 3 - 1), ivec2(0), textureSize(splatColorSums, 0) - 1);
      splatCovers = splatCovers && texelFetch(splatColorSums, splatNeighbor, 0).a > 0.0;
    }
  }
