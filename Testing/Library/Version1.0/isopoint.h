/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The declarations of version 1.0. This file stays as it is. */
#ifndef isopoint_h
#define isopoint_h
#include <stddef.h>
#include <stdint.h>
#define ISOPOINT_VERSION "1.0.0"
#define ISOPOINT_VERSION_NUMBER 10000
#if defined(ISOPOINT_STATIC)
#define ISOPOINT_API
#elif defined(_WIN32)
#ifdef ISOPOINT_BUILDS_LIBRARY
#define ISOPOINT_API __declspec(dllexport)
#else
#define ISOPOINT_API __declspec(dllimport)
#endif
#else
#define ISOPOINT_API __attribute__((visibility("default")))
#endif
#ifdef __cplusplus
extern "C"
{
#endif
typedef struct isopoint_extractor isopoint_extractor;
typedef struct isopoint_surface isopoint_surface;
typedef enum isopoint_status
{
  ISOPOINT_OK = 0,
  ISOPOINT_INVALID_ARGUMENT = 1,
  ISOPOINT_OUT_OF_MEMORY = 2,
  ISOPOINT_CANCELED = 3,
  ISOPOINT_INTERNAL_ERROR = 4,
  ISOPOINT_INVALID_ARRAY = 5,
  ISOPOINT_INVALID_OPTION = 6,
  ISOPOINT_INVALID_ORDER = 7,
  ISOPOINT_FORKED = 8,
  ISOPOINT_LAST_STATUS = 0x7fffffff
} isopoint_status;
typedef enum isopoint_type
{
  ISOPOINT_FLOAT = 0,
  ISOPOINT_DOUBLE = 1,
  ISOPOINT_INT8 = 2,
  ISOPOINT_UINT8 = 3,
  ISOPOINT_INT16 = 4,
  ISOPOINT_UINT16 = 5,
  ISOPOINT_INT32 = 6,
  ISOPOINT_UINT32 = 7,
  ISOPOINT_INT64 = 8,
  ISOPOINT_UINT64 = 9
} isopoint_type;
typedef struct isopoint_array
{
  const void* data;
  int32_t type;
  int32_t components;
  int64_t count;
  int64_t stride;
  int64_t component_stride;
} isopoint_array;
typedef enum isopoint_projection
{
  ISOPOINT_PROJECTION_NONE = 0,
  ISOPOINT_PROJECTION_LINEAR = 1,
  ISOPOINT_PROJECTION_QUADRATIC = 2,
  ISOPOINT_PROJECTION_CUBIC = 3,
  ISOPOINT_PROJECTION_CREASE = 4
} isopoint_projection;
typedef enum isopoint_normal_method
{
  ISOPOINT_NORMALS_AUTOMATIC = -1,
  ISOPOINT_NORMALS_FROM_FIELD = 0,
  ISOPOINT_NORMALS_FROM_PLANES = 1
} isopoint_normal_method;
typedef enum isopoint_precision
{
  ISOPOINT_PRECISION_SINGLE = 0,
  ISOPOINT_PRECISION_DOUBLE = 1,
  ISOPOINT_PRECISION_INPUT = 2
} isopoint_precision;
typedef struct isopoint_options
{
  uint64_t size;
  int32_t triangles;
  int32_t projection;
  int32_t normal_method;
  int32_t drop_gaps;
  int32_t compute_normals;
  int32_t compute_gradients;
  int32_t compute_projection_orders;
  int32_t output_points_precision;
  int32_t number_of_neighbors;
  int32_t compute_splats;
  double angle;
  int32_t keep_tetrahedra;
  int32_t regularize;
  int32_t keep_hull_slivers;
  int32_t capping;
  double minimum_piece_size;
} isopoint_options;
ISOPOINT_API void isopoint_initialize_options(isopoint_options* options, size_t size);
ISOPOINT_API const char* isopoint_version(void);
ISOPOINT_API int32_t isopoint_version_number(void);
ISOPOINT_API isopoint_extractor* isopoint_create_extractor(void);
ISOPOINT_API void isopoint_destroy_extractor(isopoint_extractor* extractor);
ISOPOINT_API const char* isopoint_get_error(void);
ISOPOINT_API isopoint_status isopoint_set_extractor_threads(
  isopoint_extractor* extractor, int32_t threads);
typedef void (*isopoint_progress_callback)(void* user, double fraction);
typedef int (*isopoint_cancel_callback)(void* user);
ISOPOINT_API isopoint_status isopoint_set_extractor_callbacks(isopoint_extractor* extractor,
  isopoint_progress_callback progress, isopoint_cancel_callback is_canceled, void* user);
ISOPOINT_API isopoint_status isopoint_set_value_name(
  isopoint_extractor* extractor, const char* name);
ISOPOINT_API isopoint_status isopoint_set_samples(isopoint_extractor* extractor,
  const isopoint_array* positions, const isopoint_array* values, const isopoint_array* excluded);
ISOPOINT_API int64_t isopoint_get_sample_count(const isopoint_extractor* extractor);
ISOPOINT_API int64_t isopoint_get_skipped_count(const isopoint_extractor* extractor);
ISOPOINT_API void isopoint_get_value_range(const isopoint_extractor* extractor, double range[2]);
typedef enum isopoint_probe_method
{
  ISOPOINT_PROBE_BLEND = 0,
  ISOPOINT_PROBE_CUBIC = 1,
  ISOPOINT_PROBE_QUADRATIC = 2,
  ISOPOINT_PROBE_AFFINE = 3,
  ISOPOINT_PROBE_NEAREST = 4
} isopoint_probe_method;
typedef enum isopoint_probe_outside
{
  ISOPOINT_PROBE_OUTSIDE_NUMBER = 0,
  ISOPOINT_PROBE_OUTSIDE_NEAREST = 1,
  ISOPOINT_PROBE_OUTSIDE_EXTRAPOLATE = 2
} isopoint_probe_outside;
typedef struct isopoint_probe_options
{
  uint64_t size;
  int32_t method;
  int32_t outside;
  double outside_number;
} isopoint_probe_options;
ISOPOINT_API void isopoint_initialize_probe_options(isopoint_probe_options* options, size_t size);
typedef struct isopoint_probe_result
{
  void* values;
  size_t values_size;
  double* gradients;
  size_t gradients_size;
} isopoint_probe_result;
typedef enum isopoint_place_flag
{
  ISOPOINT_PLACE_OUTSIDE = 1,
  ISOPOINT_PLACE_FLAT = 2
} isopoint_place_flag;
ISOPOINT_API isopoint_status isopoint_probe(isopoint_extractor* extractor,
  const isopoint_array* places, const isopoint_array* arrays, int64_t array_count,
  const isopoint_probe_options* options, const isopoint_probe_result* results, uint8_t* flags,
  size_t flags_size);
typedef struct isopoint_neighborhoods isopoint_neighborhoods;
ISOPOINT_API isopoint_status isopoint_find_neighborhoods(isopoint_extractor* extractor,
  const isopoint_array* places, const isopoint_probe_options* options,
  isopoint_neighborhoods** neighborhoods);
ISOPOINT_API isopoint_status isopoint_set_neighborhoods_threads(
  isopoint_neighborhoods* neighborhoods, int32_t threads);
ISOPOINT_API isopoint_status isopoint_set_neighborhoods_callbacks(
  isopoint_neighborhoods* neighborhoods, isopoint_progress_callback progress,
  isopoint_cancel_callback is_canceled, void* user);
ISOPOINT_API isopoint_status isopoint_probe_neighborhoods(
  const isopoint_neighborhoods* neighborhoods, const isopoint_array* arrays, int64_t array_count,
  const isopoint_probe_result* results, uint8_t* flags, size_t flags_size);
typedef struct isopoint_weights
{
  int64_t row_count;
  const int64_t* row_begins;
  const int64_t* samples;
  const double* values;
  const double* gradients;
} isopoint_weights;
ISOPOINT_API isopoint_status isopoint_get_weights(
  isopoint_neighborhoods* neighborhoods, isopoint_weights* weights);
ISOPOINT_API void isopoint_destroy_neighborhoods(isopoint_neighborhoods* neighborhoods);
ISOPOINT_API isopoint_status isopoint_extract(isopoint_extractor* extractor,
  const double* isovalues, int64_t count, const isopoint_options* options,
  isopoint_surface** surface);
ISOPOINT_API void isopoint_destroy_surface(isopoint_surface* surface);
ISOPOINT_API isopoint_status isopoint_set_surface_threads(
  isopoint_surface* surface, int32_t threads);
ISOPOINT_API isopoint_status isopoint_set_surface_callbacks(isopoint_surface* surface,
  isopoint_progress_callback progress, isopoint_cancel_callback is_canceled, void* user);
typedef enum isopoint_message_code
{
  ISOPOINT_MESSAGE_SKIPPED_SAMPLES = 1,
  ISOPOINT_MESSAGE_NO_SAMPLES = 2,
  ISOPOINT_MESSAGE_CONSTANT_VALUES = 3,
  ISOPOINT_MESSAGE_ISOVALUE_OUTSIDE = 4,
  ISOPOINT_MESSAGE_TOO_FEW_SAMPLES = 5,
  ISOPOINT_MESSAGE_ALL_IN_GAPS = 6,
  ISOPOINT_MESSAGE_NO_CROSSING = 7,
  ISOPOINT_MESSAGE_POINTS_WITHOUT_FIT = 8,
  ISOPOINT_MESSAGE_SPLATS_APART = 9,
  ISOPOINT_MESSAGE_BEYOND_FLOAT = 10,
  ISOPOINT_MESSAGE_NO_ISOVALUES = 11,
  ISOPOINT_MESSAGE_ONLY_AT_SAMPLES = 12
} isopoint_message_code;
ISOPOINT_API const char* isopoint_get_message(
  const isopoint_surface* surface, int64_t index, int32_t* is_warning);
ISOPOINT_API int32_t isopoint_get_message_code(const isopoint_surface* surface, int64_t index);
ISOPOINT_API const char* isopoint_get_message_cause(
  const isopoint_surface* surface, int64_t index);
ISOPOINT_API isopoint_status isopoint_join_messages(
  isopoint_surface* surface, const isopoint_surface* other);
ISOPOINT_API int64_t isopoint_get_unprojected_count(const isopoint_surface* surface);
ISOPOINT_API int64_t isopoint_get_dropped_count(const isopoint_surface* surface);
typedef enum isopoint_array_id
{
  ISOPOINT_ARRAY_POINTS = 0,
  ISOPOINT_ARRAY_ISOVALUES = 1,
  ISOPOINT_ARRAY_NORMALS = 2,
  ISOPOINT_ARRAY_GRADIENTS = 3,
  ISOPOINT_ARRAY_PROJECTION_ORDERS = 4,
  ISOPOINT_ARRAY_EDGES = 5,
  ISOPOINT_ARRAY_EDGE_PARAMETERS = 6,
  ISOPOINT_ARRAY_TRIANGLES = 7,
  ISOPOINT_ARRAY_RADII = 8,
  ISOPOINT_ARRAY_SPLAT_AXES = 9,
  ISOPOINT_ARRAY_SPLAT_POLYGONS = 10,
  ISOPOINT_ARRAY_SPLAT_VERTICES = 11,
  ISOPOINT_ARRAY_SPLAT_VERTEX_NORMALS = 12,
  ISOPOINT_ARRAY_SPLAT_VERTEX_POINTS = 13,
  ISOPOINT_ARRAY_SPLAT_TRIANGLES = 14,
  ISOPOINT_ARRAY_CAPS = 15
} isopoint_array_id;
ISOPOINT_API isopoint_status isopoint_get_array(
  const isopoint_surface* surface, int32_t array_id, isopoint_array* array);
ISOPOINT_API isopoint_status isopoint_interpolate(
  const isopoint_surface* surface, const isopoint_array* of_samples, void* result, size_t size);
ISOPOINT_API isopoint_status isopoint_create_surface(const isopoint_array* points,
  const isopoint_array* normals, const isopoint_array* axes, const isopoint_array* polygons,
  isopoint_surface** surface);
ISOPOINT_API isopoint_status isopoint_make_splat_mesh(isopoint_surface* surface, double scale);
ISOPOINT_API isopoint_status isopoint_average_at_splat_vertices(
  const isopoint_surface* surface, const isopoint_array* of_points, void* result, size_t size);
#ifdef __cplusplus
}
#endif
#endif
