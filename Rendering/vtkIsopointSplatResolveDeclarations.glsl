uniform sampler2D splatVisibleDepth; // less than 1 where there are splats
uniform sampler2D splatSurfaceSums; // weight x (normal, z) in view coordinates
uniform sampler2D splatColorSums; // weight x color; alpha: the weight
uniform sampler2D splatOpacitySums; // weight x opacity
uniform sampler2D splatOwnSums; // weight, without that of ghosts
uniform sampler2D splatColorMap;
uniform sampler2D splatIds; // lower and upper 16 bits of the point's id, the block's id, 0: a ghost
uniform int splatColoring; // 0: the material's color, 1: colors, 2: coordinates in the color map
uniform int splatGhosts; // 0: none, 1: blended, 2: also among the ids
uniform int splatOpacities; // 1: each splat has its own opacity
uniform ivec2 splatOrigin; // of the viewport, in pixels
uniform vec2 splatViewportSize;
uniform mat4 splatVCDCMatrix;
uniform int splatCameraParallel;
