/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contours samples from a file and writes triangles that any viewer of meshes opens:
 *
 *   contour SAMPLES ISOVALUE SURFACE.ply
 *
 * SAMPLES holds four numbers of type float for each sample, its coordinates and its value. Both files
 * are in the byte order of this machine. */
#include "isopoint.h"

#include <stdio.h>
#include <stdlib.h>

static int fail(const char* message)
{
  fprintf(stderr, "contour: %s\n", message);
  return EXIT_FAILURE;
}

/* All numbers of a file, to be freed; null if it cannot be read. */
static float* read_samples(const char* path, int64_t* count)
{
  const size_t sample = 4 * sizeof(float);
  float* numbers = NULL;
  FILE* file = fopen(path, "rb");
  long size = -1;
  if (file && fseek(file, 0, SEEK_END) == 0)
    size = ftell(file);
  if (size >= 0)
    numbers = malloc((size_t)size + 1);
  *count = (int64_t)((size_t)(size > 0 ? size : 0) / sample);
  if (numbers)
  {
    rewind(file);
    if (fread(numbers, sample, (size_t)*count, file) != (size_t)*count)
    {
      free(numbers);
      numbers = NULL;
    }
  }
  if (file)
    fclose(file);
  return numbers;
}

/* Writes a mesh in the binary PLY format. @returns whether that succeeded */
static int write_ply(const char* path, const isopoint_array* points, const isopoint_array* normals,
  const isopoint_array* triangles)
{
  const float* point = points->data;
  const float* normal = normals->data;
  const int64_t* corner = triangles->data;
  int64_t i;
  int has_failed;
  const int one = 1;
  const char* order = *(const char*)&one ? "little" : "big"; /* endian */
  FILE* file = fopen(path, "wb");
  if (!file)
    return 0;
  fprintf(file,
    "ply\nformat binary_%s_endian 1.0\nelement vertex %lld\n"
    "property float x\nproperty float y\nproperty float z\n"
    "property float nx\nproperty float ny\nproperty float nz\n"
    "element face %lld\nproperty list uchar int vertex_indices\nend_header\n",
    order, (long long)points->count, (long long)triangles->count);
  for (i = 0; i < points->count; ++i)
  {
    fwrite(point + 3 * i, sizeof(float), 3, file);
    fwrite(normal + 3 * i, sizeof(float), 3, file);
  }
  for (i = 0; i < triangles->count; ++i)
  {
    const int32_t ids[3] = { (int32_t)corner[3 * i], (int32_t)corner[3 * i + 1],
      (int32_t)corner[3 * i + 2] };
    fputc(3, file);
    fwrite(ids, sizeof(int32_t), 3, file);
  }
  has_failed = ferror(file);
  return fclose(file) == 0 && !has_failed;
}

int main(int argc, char** argv)
{
  int64_t count = 0;
  int64_t i;
  float* samples;
  double isovalue;
  const char* message;
  int has_written = 0;
  isopoint_options options;
  isopoint_array positions;
  isopoint_array values;
  isopoint_array points;
  isopoint_array normals;
  isopoint_array triangles;
  isopoint_surface* surface = NULL;
  isopoint_extractor* extractor;

  if (argc != 4)
    return fail("usage: contour SAMPLES ISOVALUE SURFACE.ply");
  samples = read_samples(argv[1], &count);
  if (!samples)
    return fail("cannot read the samples");
  isovalue = strtod(argv[2], NULL);

  /* Positions and values alternate in one array: strides are in bytes. */
  positions.data = samples;
  positions.type = ISOPOINT_FLOAT;
  positions.components = 3;
  positions.count = count;
  positions.stride = 4 * sizeof(float);
  positions.component_stride = 0;
  values = positions;
  values.data = samples + 3;
  values.components = 1;

  isopoint_initialize_options(&options, sizeof options);
  options.triangles = 1;
  extractor = isopoint_create_extractor();
  if (!extractor || isopoint_set_samples(extractor, &positions, &values, NULL) ||
      isopoint_extract(extractor, &isovalue, 1, &options, &surface) ||
      isopoint_get_array(surface, ISOPOINT_ARRAY_POINTS, &points) ||
      isopoint_get_array(surface, ISOPOINT_ARRAY_NORMALS, &normals) ||
      isopoint_get_array(surface, ISOPOINT_ARRAY_TRIANGLES, &triangles))
  {
    fail(isopoint_get_error());
  }
  else
  {
    for (i = 0; (message = isopoint_get_message(surface, i, NULL)) != NULL; ++i)
      fprintf(stderr, "contour: %s\n", message);
    has_written = write_ply(argv[3], &points, &normals, &triangles);
    if (!has_written)
      fail("cannot write the surface");
    printf("%lld points, %lld triangles\n", (long long)points.count, (long long)triangles.count);
  }
  isopoint_destroy_surface(surface);
  isopoint_destroy_extractor(extractor);
  free(samples);
  return has_written ? EXIT_SUCCESS : EXIT_FAILURE;
}
