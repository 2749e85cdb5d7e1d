/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * isopoint: isosurfaces directly from scattered samples.
 *
 * Samples are points with one value each and no mesh, from particles, sensors or adaptive grids. An
 * extractor holds them in a tree; isopoint_extract() returns points on isosurfaces with normals and
 * splats, or triangles.
 *
 *   isopoint_extractor* extractor = isopoint_create_extractor();
 *   isopoint_array positions = { xyz, ISOPOINT_FLOAT, 3, count, 0, 0 };
 *   isopoint_array values = { temperatures, ISOPOINT_FLOAT, 1, count, 0, 0 };
 *   isopoint_surface* surface = NULL;
 *   isopoint_array points;
 *   double isovalue = 273.15;
 *   if (isopoint_set_samples(extractor, &positions, &values, NULL) ||
 *       isopoint_extract(extractor, &isovalue, 1, NULL, &surface) ||
 *       isopoint_get_array(surface, ISOPOINT_ARRAY_POINTS, &points))
 *     fprintf(stderr, "%s\n", isopoint_get_error());
 *   else
 *     write_points(points.data, points.count);
 *   isopoint_destroy_surface(surface);
 *   isopoint_destroy_extractor(extractor);
 *
 * Threads: use each extractor, surface and isopoint_neighborhoods on one thread at a time. Different
 * objects, also an extractor and what it made, may be used on different threads at the same time.
 * Results do not depend on the number of threads. A process forked from one that used several
 * threads uses one. In a process forked while a call was running, later calls that return a status
 * return ISOPOINT_FORKED, because they could deadlock.
 *
 * Errors: functions that can fail return an isopoint_status, and isopoint_get_error() returns the
 * cause and the remedy. Pointers to objects are written only on success. Lack of memory is an error
 * like others.
 *
 * Memory for results: the caller provides it and its size in bytes, which may be more than needed.
 * It is aligned as the numbers are, and overlaps no other argument. Tuples are contiguous. After a
 * failure it may be partly written.
 *
 * Versions: a program runs with each library 1.x that has the functions it calls, whichever version
 * 1.x of this header it was compiled with. Names, numbers, parameters and structures stay, but later
 * versions may append members to isopoint_options and isopoint_probe_options, with the default 0, and
 * add functions, statuses, message codes and arrays: treat a status that you do not know as an error.
 * A library refuses an option that it does not know unless it is 0.
 */
#ifndef isopoint_h
#define isopoint_h

#include <stddef.h>
#include <stdint.h>

#define ISOPOINT_VERSION "1.0.0"
#define ISOPOINT_VERSION_NUMBER 10000 /* 10000 major + 100 minor + patch */

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

/* -------------------------------------------------------------------------------- */
/* Types */

/* Samples, with a tree that is kept between extractions. */
typedef struct isopoint_extractor isopoint_extractor;

/* The result of an extraction. Owns its arrays. */
typedef struct isopoint_surface isopoint_surface;

/* Why a call failed. */
typedef enum isopoint_status
{
  ISOPOINT_OK = 0,
  ISOPOINT_INVALID_ARGUMENT = 1, /* such as a null pointer, an isovalue, too many samples, or triangles
                                    of samples on curves, which have too many tetrahedra */
  ISOPOINT_OUT_OF_MEMORY = 2,
  ISOPOINT_CANCELED = 3,       /* by the callback */
  ISOPOINT_INTERNAL_ERROR = 4, /* a defect of the library */
  ISOPOINT_INVALID_ARRAY = 5,  /* the type, size or memory of an array or a result */
  ISOPOINT_INVALID_OPTION = 6, /* unknown, out of range, or not together with another one */
  ISOPOINT_INVALID_ORDER = 7,  /* another call has to come first */
  ISOPOINT_FORKED = 8,         /* this process was forked during a call */
  ISOPOINT_LAST_STATUS = 0x7fffffff /* of no call: gives the type its size */
} isopoint_status;

/* The types of numbers in arrays. */
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

/* `count` tuples of `components` numbers. Strides are in bytes, possibly negative; 0:
 * contiguous. */
typedef struct isopoint_array
{
  const void* data;         /* null if there are no numbers */
  int32_t type;             /* an isopoint_type */
  int32_t components;       /* 1 or more */
  int64_t count;            /* 0 or more */
  int64_t stride;           /* from one tuple to the next; 0: components times component_stride */
  int64_t component_stride; /* from one number of a tuple to the next; 0: size of the type */
} isopoint_array;

/* -------------------------------------------------------------------------------- */
/* Options */

typedef enum isopoint_projection
{
  ISOPOINT_PROJECTION_NONE = 0,      /* none: points stay where linear interpolation puts them */
  ISOPOINT_PROJECTION_LINEAR = 1,    /* an affine function */
  ISOPOINT_PROJECTION_QUADRATIC = 2, /* a polynomial of degree two */
  ISOPOINT_PROJECTION_CUBIC = 3,     /* of degree two or three */
  ISOPOINT_PROJECTION_CREASE = 4     /* the same, or several polynomials that meet at a crease */
} isopoint_projection;

typedef enum isopoint_normal_method
{
  ISOPOINT_NORMALS_AUTOMATIC = -1, /* FROM_FIELD if a fit is needed anyway, otherwise FROM_PLANES */
  ISOPOINT_NORMALS_FROM_FIELD = 0,      /* gradients of the fits */
  ISOPOINT_NORMALS_FROM_PLANES = 1      /* planes through the nearest points, or triangles */
} isopoint_normal_method;

typedef enum isopoint_precision
{
  ISOPOINT_PRECISION_SINGLE = 0,
  ISOPOINT_PRECISION_DOUBLE = 1,
  ISOPOINT_PRECISION_INPUT = 2 /* as the samples' positions */
} isopoint_precision;

/* What to extract. isopoint_initialize_options() sets `size` and all defaults. 0 is off, 1 is on.
 * docs/properties.md has all details. */
typedef struct isopoint_options
{
  /* All options must be within their ranges, even those without effect, such as options of points
   * when triangles are extracted. */
  uint64_t size;                     /* of this struct, in bytes */
  int32_t triangles;                 /* 0: points; 1: triangles. Default: 0 */
  int32_t projection;                /* an isopoint_projection: how points move. Default: CUBIC */
  int32_t normal_method;             /* an isopoint_normal_method. Default: AUTOMATIC */
  int32_t drop_gaps;                 /* whether the surface ends at gaps. Default: 1 */
  int32_t compute_normals;           /* Default: 1 */
  int32_t compute_gradients;         /* Default: 0 */
  int32_t compute_projection_orders; /* Default: 0 */
  int32_t output_points_precision;   /* an isopoint_precision. Default: INPUT */
  /* Points only: */
  int32_t number_of_neighbors; /* points used to fit a plane, 3 to 1000. Default: 12 */
  int32_t compute_splats;      /* whether to compute splats of points. Default: 1 */
  double angle;                /* of the angle criterion, in degrees, 0 to 180. Default: 54.7 */
  /* Triangles only: whether to keep the tetrahedra near the surface, unless there are many, which
   * speeds up the next isovalue. The result is the same. */
  int32_t keep_tetrahedra; /* Default: 1 */
  /* Triangles only: whether to merge vertices and flip edges, which gives fewer and well-shaped
   * triangles. 0: the exact isosurface of the Delaunay tetrahedralization. */
  int32_t regularize; /* Default: 1 */
  /* Triangles only. 1, for slices: the surface ends where the body ends. Gaps begin only at edges
   * across a void, not at flat tetrahedra on the convex hull. Vertices of the rim do not merge. */
  int32_t keep_hull_slivers; /* Default: 0 */
  /* Triangles only: whether the surface is that of the body of the samples at or above the isovalue,
   * closed by caps where the samples end. Not with projection CREASE. */
  int32_t capping; /* Default: 0 */
  /* Triangles only: leaves out connected components, such as droplets, with less than this share of
   * the area of the isovalue's largest one. With capping, a bubble (of negative volume) is left out
   * only together with the component around it. From 0 to 1. */
  double minimum_piece_size; /* Default: 0 */
} isopoint_options;

/* Sets all options to their defaults. @param size sizeof(isopoint_options) */
ISOPOINT_API void isopoint_initialize_options(isopoint_options* options, size_t size);

/* -------------------------------------------------------------------------------- */
/* Extractors */

/* The version of the loaded library, possibly another one than that of this header. */
ISOPOINT_API const char* isopoint_version(void);
ISOPOINT_API int32_t isopoint_version_number(void);

/* A new extractor without samples, or null if memory is lacking. */
ISOPOINT_API isopoint_extractor* isopoint_create_extractor(void);

/* Frees an extractor; its surfaces remain valid. Null is ignored. */
ISOPOINT_API void isopoint_destroy_extractor(isopoint_extractor* extractor);

/* The message of the last failed call on this thread, cause and remedy; "" if none failed. It is
 * valid until the next call fails. */
ISOPOINT_API const char* isopoint_get_error(void);

/* Sets the maximum number of threads. 0 (the default) means all available cores. Larger numbers are
 * reduced to that. Available are the cores of the process's affinity mask, within its container's
 * quota; processes that an MPI launcher started on this machine share them. Without oneTBB, or if it
 * fails, calls run on one thread. */
ISOPOINT_API isopoint_status isopoint_set_extractor_threads(
  isopoint_extractor* extractor, int32_t threads);

/* Receives the share of a call that is done, 0 to 1, ascending. */
typedef void (*isopoint_progress_callback)(void* user, double fraction);

/* Asked every few tens of milliseconds whether to cancel a call. Nonzero ends it: it returns
 * ISOPOINT_CANCELED, and its object stays usable. */
typedef int (*isopoint_cancel_callback)(void* user);

/* Sets the callbacks of later calls that load, extract or probe, or removes them with null, the
 * default. They run on the thread of the call, must not use its object, and have to return, not by
 * exceptions or longjmp(). */
ISOPOINT_API isopoint_status isopoint_set_extractor_callbacks(isopoint_extractor* extractor,
  isopoint_progress_callback progress, isopoint_cancel_callback is_canceled, void* user);

/* Sets the name of the values, such as "temperature", for messages and their causes. It is copied.
 * @param name in UTF-8; null or "", the default: messages say "the array" */
ISOPOINT_API isopoint_status isopoint_set_value_name(
  isopoint_extractor* extractor, const char* name);

/* Says whether values and isovalues are those of a user, negated, as for a body at or below an
 * isovalue: messages then show the user's numbers.
 * @param are_negated 0, the default: they are not */
ISOPOINT_API isopoint_status isopoint_set_values_negated(
  isopoint_extractor* extractor, int32_t are_negated);

/* Loads samples, which replace all former ones. Arrays are read only during the call. If positions,
 * types and skipped samples are the same as before, the tree is kept and only values are replaced:
 * a later time step takes a fraction of the time.
 *
 * Samples with a non-finite position or value are skipped; see isopoint_get_message(). Coincident
 * samples are one, with the mean value; but the tree counts each, so that repeated samples can change
 * which samples are neighbors. 64-bit integers are rounded to double. Integer values
 * are assumed to be rounded: their standard error is 1/sqrt(12). Fits do not try to resolve smaller
 * differences. If an array cannot be used, the extractor keeps its former samples; after other errors
 * it has none.
 * O(n)
 * @param positions of type float or double, three components
 * @param values of any type, one component, as many as positions; null if there is nothing to extract
 * @param excluded null, or one ISOPOINT_UINT8 per sample; samples that are not 0 are skipped */
ISOPOINT_API isopoint_status isopoint_set_samples(isopoint_extractor* extractor,
  const isopoint_array* positions, const isopoint_array* values, const isopoint_array* excluded);

/* The number of samples used, and the number of samples skipped. */
ISOPOINT_API int64_t isopoint_get_sample_count(const isopoint_extractor* extractor);
ISOPOINT_API int64_t isopoint_get_skipped_count(const isopoint_extractor* extractor);

/* The range of the values of the samples used; NaN if there are none. */
ISOPOINT_API void isopoint_get_value_range(const isopoint_extractor* extractor, double range[2]);

/* -------------------------------------------------------------------------------- */
/* Values at places */

typedef enum isopoint_probe_method
{
  ISOPOINT_PROBE_BLEND = 0,     /* the mean of four fits, weighted by their estimated errors */
  ISOPOINT_PROBE_CUBIC = 1,     /* a polynomial of degree three: linear in the values */
  ISOPOINT_PROBE_QUADRATIC = 2, /* of degree two: linear in the values */
  ISOPOINT_PROBE_AFFINE = 3,    /* of degree one, by least squares: linear in the values */
  ISOPOINT_PROBE_NEAREST = 4    /* the nearest sample */
} isopoint_probe_method;

/* What places outside the samples get. Places without finite coordinates always get the number. */
typedef enum isopoint_probe_outside
{
  ISOPOINT_PROBE_OUTSIDE_NUMBER = 0,     /* a number */
  ISOPOINT_PROBE_OUTSIDE_NEAREST = 1,    /* the value of the nearest sample */
  ISOPOINT_PROBE_OUTSIDE_EXTRAPOLATE = 2 /* what the method gives: no other place counts as outside */
} isopoint_probe_outside;

/* How to probe places. isopoint_initialize_probe_options() sets `size` and all defaults. */
typedef struct isopoint_probe_options
{
  uint64_t size;         /* of this struct, in bytes */
  int32_t method;        /* an isopoint_probe_method. Default: BLEND */
  int32_t outside;       /* an isopoint_probe_outside. Default: NUMBER */
  double outside_number; /* for NUMBER. Default: NaN */
} isopoint_probe_options;

/* Sets all options to their defaults. @param size sizeof(isopoint_probe_options) */
ISOPOINT_API void isopoint_initialize_probe_options(isopoint_probe_options* options, size_t size);

/* Memory for the results of one array. */
typedef struct isopoint_probe_result
{
  /* One tuple per place, with the components of the array: double, or with ISOPOINT_PROBE_NEAREST the
   * type of the array. */
  void* values;
  size_t values_size; /* in bytes */
  double* gradients; /* null, or three numbers for each component of each place; null for NEAREST */
  size_t gradients_size; /* in bytes */
} isopoint_probe_result;

typedef enum isopoint_place_flag
{
  ISOPOINT_PLACE_OUTSIDE = 1, /* of the samples */
  ISOPOINT_PLACE_FLAT = 2     /* the samples around are in a plane, on a line or at one position */
} isopoint_place_flag;

/* Interpolates arrays at places: a fit to the nearest samples, its value and its gradient. Search
 * and weights are computed once for all arrays. The values of isopoint_set_samples() take no part,
 * but samples that it skipped, also for their values, do not exist: pass null values to keep them.
 *
 * Outside: a place is outside if all 27 nearest samples lie on one side of it, or if its nearest
 * sample s is farther than 0.9 d, d being the distance from s to the eighth nearest sample of the
 * place. Within 0.001 d of s it is inside. Places whose coordinates are not finite, or whose squared
 * distances overflow, are outside. Gradients outside are NaN where the value is `outside_number`, and 0
 * where it is that of the nearest sample.
 *
 * Flat: where samples are in a plane or on a line, results are those at the nearest point of it, and
 * gradients have no part across.
 *
 * Missing values: samples whose value in an array is not finite are ignored for that array only, so
 * a place can be outside for one array and inside for another. If none of the samples considered has
 * a value (64 with ISOPOINT_PROBE_BLEND, 48 with CUBIC, 27 with QUADRATIC and NEAREST, 13 with
 * AFFINE), the array gets `outside_number`, whatever `outside` says. Coincident samples count as one,
 * with the mean value; ISOPOINT_PROBE_NEAREST takes the first one that has a value.
 *
 * Components: ISOPOINT_PROBE_BLEND fits all components of an array alike, so that turned vectors
 * give turned results. Its values exceed the range of the samples around only at extrema that these
 * show.
 * Integers are assumed to be rounded. Values of an array of integers stay within the range of each
 * component in the samples in use. With ISOPOINT_PROBE_NEAREST, as for ids, they get
 * `outside_number` without its fraction, or 0 if their type cannot hold it.
 *
 * Cost: O(log n) for each place after O(n) for the first, except where very many samples have the
 * same distance.
 * @param places of type float or double, three components
 * @param arrays `array_count` arrays, each of as many tuples as there were samples
 * @param options null for the defaults
 * @param results `array_count`
 * @param flags null, or memory for the sum of the ISOPOINT_PLACE_... of each place
 * @param flags_size in bytes */
ISOPOINT_API isopoint_status isopoint_probe(isopoint_extractor* extractor,
  const isopoint_array* places, const isopoint_array* arrays, int64_t array_count,
  const isopoint_probe_options* options, const isopoint_probe_result* results, uint8_t* flags,
  size_t flags_size);

/* The samples around places, kept so that later arrays, such as those of other time steps, cost only
 * the products with weights; with ISOPOINT_PROBE_BLEND, the fits. Takes 0.3 kB a place with
 * ISOPOINT_PROBE_BLEND, up to 1.7 kB with other methods, and memory for all samples around; twice as
 * much while they are found. */
typedef struct isopoint_neighborhoods isopoint_neighborhoods;

/* Finds the samples around places. Parameters as isopoint_probe().
 * @param neighborhoods receives an object, to be freed by isopoint_destroy_neighborhoods(). It
 * remains valid if the extractor is destroyed or gets other samples */
ISOPOINT_API isopoint_status isopoint_find_neighborhoods(isopoint_extractor* extractor,
  const isopoint_array* places, const isopoint_probe_options* options,
  isopoint_neighborhoods** neighborhoods);

/* Set the maximum number of threads and the callbacks of calls on neighborhoods, as
 * isopoint_set_extractor_threads() and isopoint_set_extractor_callbacks() do. At first they have the
 * extractor's number of threads and no callbacks. */
ISOPOINT_API isopoint_status isopoint_set_neighborhoods_threads(
  isopoint_neighborhoods* neighborhoods, int32_t threads);
ISOPOINT_API isopoint_status isopoint_set_neighborhoods_callbacks(
  isopoint_neighborhoods* neighborhoods, isopoint_progress_callback progress,
  isopoint_cancel_callback is_canceled, void* user);

/* isopoint_probe() for the places of neighborhoods, with the same results. */
ISOPOINT_API isopoint_status isopoint_probe_neighborhoods(
  const isopoint_neighborhoods* neighborhoods, const isopoint_array* arrays, int64_t array_count,
  const isopoint_probe_result* results, uint8_t* flags, size_t flags_size);

/* Weights of samples: a sparse matrix with a row for each place, in compressed rows. Its product
 * with an array is the value at each place; for integers, before it is limited to their range.
 * Coincident samples share a weight, except with ISOPOINT_PROBE_NEAREST. */
typedef struct isopoint_weights
{
  int64_t row_count;
  const int64_t* row_begins;      /* the first entry of each row, and the end: row_count + 1 */
  const int64_t* samples;         /* the sample of each entry */
  const double* values;           /* the weight of each entry in the value */
  const double* gradients;        /* its three weights in the gradient */
} isopoint_weights;

/* The weights of neighborhoods, computed at the first call, in one thread and without callbacks; not
 * with ISOPOINT_PROBE_BLEND, which is not linear in the values. Rows of places outside have the
 * nearest sample with ISOPOINT_PROBE_OUTSIDE_NEAREST, and are empty otherwise, or if the place is not
 * finite. Samples whose value is not finite have weights, too. The memory is valid until the
 * neighborhoods are destroyed. */
ISOPOINT_API isopoint_status isopoint_get_weights(
  isopoint_neighborhoods* neighborhoods, isopoint_weights* weights);

/* Frees neighborhoods. Null is ignored. */
ISOPOINT_API void isopoint_destroy_neighborhoods(isopoint_neighborhoods* neighborhoods);

/* -------------------------------------------------------------------------------- */
/* Surfaces */

/* Extracts isosurfaces: for each distinct isovalue, ascending, the points where edges between
 * neighboring samples cross it. The first extraction takes O(n) to build the levels of the tree
 * that are larger than the surface; further ones only process samples near the surface.
 * @param isovalues `count` numbers, at most 2^24, possibly infinite but not NaN
 * @param options null for the defaults
 * @param surface receives a surface, to be freed by isopoint_destroy_surface(). If it has no points,
 * isopoint_get_message() says why. After ISOPOINT_INTERNAL_ERROR the extractor has no samples
 *
 * Slices: to slice samples along a plane or another implicit function, pass the function's values at
 * the samples, as double, to isopoint_set_samples(), and extract triangles without projection and
 * normals, but with keep_hull_slivers. The function of a plane is dot(position, normal): to move the
 * plane along its normal, change the isovalue. Interpolate arrays at the points by isopoint_probe()
 * with ISOPOINT_PROBE_OUTSIDE_EXTRAPOLATE: isopoint_interpolate() is inaccurate at rims, because
 * edges of slivers on the convex hull are long.
 *
 * Bodies: for the closed surface of all samples pass any values, such as zeros, and extract triangles
 * without projection and normals, but with capping, at the isovalue -INFINITY. */
ISOPOINT_API isopoint_status isopoint_extract(isopoint_extractor* extractor,
  const double* isovalues, int64_t count, const isopoint_options* options,
  isopoint_surface** surface);

/* Frees a surface and its arrays. Null is ignored. */
ISOPOINT_API void isopoint_destroy_surface(isopoint_surface* surface);

/* Set the maximum number of threads and the callbacks of isopoint_interpolate(),
 * isopoint_make_splat_mesh() and isopoint_average_at_splat_vertices(), as
 * isopoint_set_extractor_threads() and isopoint_set_extractor_callbacks() do. At first a surface has
 * the number of threads of its extractor, or 0, and no callbacks. Short calls report no progress. */
ISOPOINT_API isopoint_status isopoint_set_surface_threads(
  isopoint_surface* surface, int32_t threads);
ISOPOINT_API isopoint_status isopoint_set_surface_callbacks(isopoint_surface* surface,
  isopoint_progress_callback progress, isopoint_cancel_callback is_canceled, void* user);

/* What a message is about. A surface with keep_hull_slivers and without capping is a slice; one with
 * capping at the isovalue -INFINITY alone is a body. Messages name each isovalue without a surface;
 * slices have one only if all are empty. */
typedef enum isopoint_message_code
{
  ISOPOINT_MESSAGE_SKIPPED_SAMPLES = 1,    /* some are not finite; not a warning */
  ISOPOINT_MESSAGE_NO_SAMPLES = 2,         /* there are none, or all are skipped */
  ISOPOINT_MESSAGE_CONSTANT_VALUES = 3,    /* no surface: all values are the same */
  ISOPOINT_MESSAGE_ISOVALUE_OUTSIDE = 4,   /* no surface: no values are below, or none are above */
  ISOPOINT_MESSAGE_TOO_FEW_SAMPLES = 5,    /* no surface: there are fewer than four */
  ISOPOINT_MESSAGE_ALL_IN_GAPS = 6,        /* no surface: all of it is in gaps between samples */
  ISOPOINT_MESSAGE_NO_CROSSING = 7,        /* no surface for another reason, such as samples in one plane */
  ISOPOINT_MESSAGE_POINTS_WITHOUT_FIT = 8, /* no fit moved most points */
  ISOPOINT_MESSAGE_SPLATS_APART = 9,       /* many splats do not meet */
  ISOPOINT_MESSAGE_BEYOND_FLOAT = 10,      /* float cannot hold positions or splats */
  ISOPOINT_MESSAGE_NO_ISOVALUES = 11,      /* no surface: there are no isovalues */
  ISOPOINT_MESSAGE_ONLY_AT_SAMPLES = 12,   /* a slice is only where samples are on it; not a warning */
  ISOPOINT_MESSAGE_ROUNDED_POSITIONS = 13, /* float32 is too coarse for positions so far from the origin */
  ISOPOINT_MESSAGE_DIFFERENT_VALUES = 14,  /* samples at one position have different values; not a warning */
  ISOPOINT_MESSAGE_ISOVALUE_AT_END = 15    /* no surface: at an end of the values; a warning if there is none at all */
} isopoint_message_code;

/* A message for the user about a result, such as skipped samples or an isovalue without a surface:
 * a sentence, and the remedy. Null if there is no message of this index. The message and its cause
 * (below) are valid until the surface is destroyed, or isopoint_join_messages() changes them.
 * @param index from 0
 * @param is_warning null, or receives 1 if the result is not what was requested, otherwise 0 */
ISOPOINT_API const char* isopoint_get_message(
  const isopoint_surface* surface, int64_t index, int32_t* is_warning);

/* The isopoint_message_code of this index, or 0 if there is none. */
ISOPOINT_API int32_t isopoint_get_message_code(const isopoint_surface* surface, int64_t index);

/* A key of the cause of the message of this index, or null if there is none. The key stays the same
 * in later extractions while the cause lasts, even if figures in the message change: programs that
 * extract time steps can show each message once. It is not for display and may change with the
 * version. */
ISOPOINT_API const char* isopoint_get_message_cause(
  const isopoint_surface* surface, int64_t index);

/* Merges the statistics of `other` into those of `surface`, whose messages then describe both: for
 * blocks of one data set that are contoured separately. An isovalue without points in one of them
 * causes no message if the other one has some.
 * @param other extracted with the same isovalues and options */
ISOPOINT_API isopoint_status isopoint_join_messages(
  isopoint_surface* surface, const isopoint_surface* other);

/* The number of points that no fit moved; all points without a projection. */
ISOPOINT_API int64_t isopoint_get_unprojected_count(const isopoint_surface* surface);

/* The number of crossing edges (for triangles, crossing tetrahedra) dropped in gaps. */
ISOPOINT_API int64_t isopoint_get_dropped_count(const isopoint_surface* surface);

/* The arrays of a surface. Points are ordered by isovalue, then by edge; those that
 * ISOPOINT_PROJECTION_CREASE adds to triangles follow. Positions beyond the range of float are
 * infinite in float arrays. */
typedef enum isopoint_array_id
{
  ISOPOINT_ARRAY_POINTS = 0,            /* three float or double */
  ISOPOINT_ARRAY_ISOVALUES = 1,         /* double: the isovalue of each point */
  ISOPOINT_ARRAY_NORMALS = 2,           /* three float, of length 1, towards decreasing values */
  ISOPOINT_ARRAY_GRADIENTS = 3,         /* three float, in units of values per unit of positions */
  ISOPOINT_ARRAY_PROJECTION_ORDERS = 4, /* uint8: the ISOPOINT_PROJECTION_... that moved the point */
  /* For a regularized vertex, merged from several crossings, the edge of the nearest crossing: */
  ISOPOINT_ARRAY_EDGES = 5,             /* two int64: the samples at its ends, lower number first; for a
                                     vertex of a cap at a sample, twice the same */
  ISOPOINT_ARRAY_EDGE_PARAMETERS = 6,   /* double: the position of the point on its edge, 0 to 1 */
  ISOPOINT_ARRAY_TRIANGLES = 7,         /* three int64: points, counterclockwise seen from lower values */
  /* The splat of a point p with normal n is a fan of triangles from p to each two consecutive of
   * eight corners. Let r be its radius, t1 its axis, and t2 the cross product n x t1. */
  ISOPOINT_ARRAY_RADII = 8,      /* float: r, the distance of the farthest corner; 0 without corners */
  ISOPOINT_ARRAY_SPLAT_AXES = 9, /* three float: t1, tangential and as long as r */
  /* 40 float: a, b, h, u, v of each corner. The corner is at p + a t1 + b t2 + h r n and has the
   * normal n + (u t1 + v t2) / r, not of length 1. Counterclockwise seen from the tip of n. Unused
   * corners repeat the last one. All are 0 if the splat of a close point takes the place of this one. */
  ISOPOINT_ARRAY_SPLAT_POLYGONS = 10,
  /* After isopoint_make_splat_mesh(): */
  ISOPOINT_ARRAY_SPLAT_VERTICES = 11,       /* three float or double, as points */
  ISOPOINT_ARRAY_SPLAT_VERTEX_NORMALS = 12, /* three float */
  ISOPOINT_ARRAY_SPLAT_VERTEX_POINTS = 13,  /* int64: the point of each vertex */
  ISOPOINT_ARRAY_SPLAT_TRIANGLES = 14,      /* three int64: vertices */
  ISOPOINT_ARRAY_CAPS = 15 /* uint8: with capping, whether each triangle is part of a cap */
} isopoint_array_id;

/* An array of a surface. Its memory is valid until the surface is destroyed or, for a splat mesh,
 * until the next mesh is made. Arrays that the options did not request have no tuples. */
ISOPOINT_API isopoint_status isopoint_get_array(
  const isopoint_surface* surface, int32_t array_id, isopoint_array* array);

/* Interpolates an array of the samples at the points of a surface, keeping components and type.
 * Integers are rounded to the nearest, after conversion to double. Coincident samples are averaged.
 * @param surface made by isopoint_extract()
 * @param of_samples as many tuples as there were samples in isopoint_set_samples()
 * @param result memory for one tuple per point
 * @param size of this memory, in bytes */
ISOPOINT_API isopoint_status isopoint_interpolate(
  const isopoint_surface* surface, const isopoint_array* of_samples, void* result, size_t size);

/* Makes a surface from points with splats of an earlier surface, for example from a file, or a
 * subset of them, to make a splat mesh. It only has these arrays. O(n)
 * @param points three float or double
 * @param normals, axes, polygons one tuple per point, with types and components as their arrays
 * @param surface receives a surface, to be freed by isopoint_destroy_surface() */
ISOPOINT_API isopoint_status isopoint_create_surface(const isopoint_array* points,
  const isopoint_array* normals, const isopoint_array* axes, const isopoint_array* polygons,
  isopoint_surface** surface);

/* Makes the triangles of all splats, for mesh renderers; replaces former ones unless it fails.
 * Splats do not share vertices. Requires compute_normals and compute_splats. O(n log n)
 * @param scale factor on the size of splats, greater than 0; 1 closes the surface */
ISOPOINT_API isopoint_status isopoint_make_splat_mesh(isopoint_surface* surface, double scale);

/* Averages an array of the points at the vertices of splats: splats that meet at a vertex have
 * equal weight, so that colors are smooth across them.
 * @param of_points of type float or double, one tuple per point
 * @param result memory for one tuple per vertex, of the same type
 * @param size of this memory, in bytes */
ISOPOINT_API isopoint_status isopoint_average_at_splat_vertices(
  const isopoint_surface* surface, const isopoint_array* of_points, void* result, size_t size);

#ifdef __cplusplus
}
#endif

#endif
