/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * isopoint: isosurfaces straight from scattered samples.
 *
 * Samples are points with one value each, without a mesh: of particles, sensors, adaptive grids. An
 * extractor holds them in a tree; isopoint_extract() yields points on isosurfaces with normals and
 * splats, or triangles.
 *
 *   isopoint_extractor* extractor = isopoint_create_extractor();
 *   isopoint_array positions = { xyz, ISOPOINT_FLOAT, 3, count, 0, 0 };
 *   isopoint_array values = { temperatures, ISOPOINT_FLOAT, 1, count, 0, 0 };
 *   isopoint_surface* surface = NULL;
 *   isopoint_array points;
 *   isopoint_options options;
 *   double isovalue = 273.15;
 *   isopoint_initialize_options(&options, sizeof options);
 *   if (isopoint_set_samples(extractor, &positions, &values, NULL) ||
 *       isopoint_extract(extractor, &isovalue, 1, &options, &surface) ||
 *       isopoint_get_array(surface, ISOPOINT_POINTS, &points))
 *     fprintf(stderr, "%s\n", isopoint_get_error());
 *   ...
 *   isopoint_destroy_surface(surface);
 *   isopoint_destroy_extractor(extractor);
 *
 * Threads: two extractors, and two surfaces, may be used on two threads at the same time; one
 * extractor, or one surface, on one thread at a time. An extractor and a surface of it may be used on
 * two. Results do not depend on the number of threads.
 *
 * Errors: functions that can fail return an isopoint_status. isopoint_get_error() then has the
 * cause and the remedy. Outputs through pointers are written only where a function succeeds. No
 * function ends the program, not even for lack of memory.
 */
#ifndef isopoint_h
#define isopoint_h

#include <stddef.h>
#include <stdint.h>

#define ISOPOINT_VERSION "1.0.0"

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

/* Samples, and what is kept of them from one extraction to the next. */
typedef struct isopoint_extractor isopoint_extractor;

/* The result of one extraction, which owns its arrays. */
typedef struct isopoint_surface isopoint_surface;

typedef enum isopoint_status
{
  ISOPOINT_OK = 0,
  ISOPOINT_INVALID_ARGUMENT = 1, /* an array, an option or an isovalue cannot be used */
  ISOPOINT_OUT_OF_MEMORY = 2,
  ISOPOINT_CANCELED = 3, /* by the callback */
  ISOPOINT_INTERNAL_ERROR = 4
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

/* `count` tuples of `components` numbers. Strides are in bytes, negative ones included, and are 0
 * where numbers follow each other. */
typedef struct isopoint_array
{
  const void* data;         /* null if there are no numbers */
  int32_t type;             /* an isopoint_type */
  int32_t components;       /* 1 or more */
  int64_t count;            /* 0 or more */
  int64_t stride;           /* from one tuple to the next; 0: components times the next one */
  int64_t component_stride; /* from one number of a tuple to the next; 0: the size of the type */
} isopoint_array;

/* -------------------------------------------------------------------------------- */
/* Options */

enum
{
  ISOPOINT_PROJECTION_NONE = 0,      /* points stay where linear interpolation puts them */
  ISOPOINT_PROJECTION_LINEAR = 1,    /* an affine function */
  ISOPOINT_PROJECTION_QUADRATIC = 2, /* a polynomial of degree two */
  ISOPOINT_PROJECTION_CUBIC = 3,     /* of degree two or three */
  ISOPOINT_PROJECTION_CREASE = 4     /* the same, or several that meet at a crease */
};

enum
{
  ISOPOINT_NORMALS_AUTOMATIC = -1, /* from the field where a fit is made anyway */
  ISOPOINT_NORMALS_FROM_FIELD = 0,      /* gradients of the fits */
  ISOPOINT_NORMALS_FROM_PLANES = 1      /* planes through the nearest points, or of the triangles */
};

enum
{
  ISOPOINT_PRECISION_SINGLE = 0,
  ISOPOINT_PRECISION_DOUBLE = 1,
  ISOPOINT_PRECISION_INPUT = 2 /* that of the samples' positions */
};

/* What to extract. isopoint_initialize_options() sets `size` and all defaults. Later versions may add
 * options at the end, and still accept the size of this version. 0 and 1 stand for off and on.
 * docs/properties.md describes each option at length. */
typedef struct isopoint_options
{
  uint64_t size;                     /* of this struct, in bytes */
  int32_t triangles;                 /* 0: points; 1: triangles. Default: 0 */
  int32_t projection;                /* how points move to the zero of a fit. Default: CUBIC */
  int32_t normal_method;             /* where normals come from. Default: AUTOMATIC */
  int32_t drop_gaps;                 /* whether the surface ends at gaps. Default: 1 */
  int32_t compute_normals;           /* Default: 1 */
  int32_t compute_gradients;         /* Default: 0 */
  int32_t compute_projection_orders; /* Default: 0 */
  int32_t output_points_precision;   /* Default: INPUT */
  /* Of points alone: */
  int32_t number_of_neighbors; /* of planes that give normals, 3 to 1000. Default: 12 */
  int32_t compute_splats;      /* of the same points, around their normals. Default: 1 */
  double angle;           /* of the angle criterion, in degrees, 0 to 180. Default: 54.7 */
  double minimum_spacing; /* of points, in sample spacings, 0 to 1; 0: keep all. Default: 0 */
  /* Of triangles: whether the tetrahedra near the surface are kept for the next isovalue, which is
   * faster then, unless they are many. The result is the same. */
  int32_t keep_tetrahedra; /* Default: 1 */
  /* Of triangles: whether vertices are merged, and edges flipped, to fewer and well-shaped ones. 0:
   * the exact isosurface of the Delaunay tetrahedralization. */
  int32_t regularize; /* Default: 1 */
} isopoint_options;

/* Sets all options to their defaults. @param size sizeof(isopoint_options) */
ISOPOINT_API void isopoint_initialize_options(isopoint_options* options, size_t size);

/* -------------------------------------------------------------------------------- */
/* Extractors */

/* The version of the library that is loaded, which may be later than ISOPOINT_VERSION. */
ISOPOINT_API const char* isopoint_version(void);

/* An extractor without samples, or null if memory is lacking. */
ISOPOINT_API isopoint_extractor* isopoint_create_extractor(void);

/* Frees an extractor, or nothing if it is null. Its surfaces stay. */
ISOPOINT_API void isopoint_destroy_extractor(isopoint_extractor* extractor);

/* The message of the last call on this thread that failed: the cause, then the remedy; "" if none
 * has. It is valid until the next call fails. */
ISOPOINT_API const char* isopoint_get_error(void);

/* How many threads to use at most: 0, the default, and numbers above stand for all cores that the
 * process may use: those that it is bound to, within its container's quota and its share of those of
 * processes that a launcher of MPI started beside it. One thread alone is used where the library was
 * built without oneTBB, or if that could not start. */
ISOPOINT_API isopoint_status isopoint_set_threads(isopoint_extractor* extractor, int32_t threads);

/* Callbacks, called on the thread of the call alone. Null, the default: none.
 * @param progress(user, fraction) the share of the present call that is done, 0 to 1, ascending
 * @param cancels(user) every few tens of milliseconds: nonzero ends the call, which returns
 * ISOPOINT_CANCELED. The extractor remains usable.
 * They apply to isopoint_set_samples(), isopoint_extract() and isopoint_make_splat_mesh(), of surfaces
 * that were extracted from then on, too: `user` has to outlive these. They must not use the extractor
 * or surface of the call. */
ISOPOINT_API isopoint_status isopoint_set_callbacks(isopoint_extractor* extractor,
  void (*progress)(void* user, double fraction), int (*cancels)(void* user), void* user);

/* Loads samples in place of any former ones. Arrays are read during the call alone. Where the
 * positions, the types and the samples that take part are those of the last call, the tree is kept,
 * and only values are replaced: a later time step takes a fraction of the time.
 *
 * Samples whose position or value is not finite take no part; see isopoint_get_message(). Those at
 * one position count as one, with their mean value. Values of 64-bit integers are rounded to
 * double. Values of integer types are taken as rounded: fits ignore details below 1 / sqrt(12).
 * O(n).
 * @param positions of type float or double, three components
 * @param values of any type, one component, as many as positions
 * @param excluded null, or an array of ISOPOINT_UINT8 with one component for each sample, which
 * takes no part where it is not 0
 * After an error the extractor has no samples. */
ISOPOINT_API isopoint_status isopoint_set_samples(isopoint_extractor* extractor,
  const isopoint_array* positions, const isopoint_array* values, const isopoint_array* excluded);

/* The samples that take part, and those that do not. */
ISOPOINT_API int64_t isopoint_get_sample_count(const isopoint_extractor* extractor);
ISOPOINT_API int64_t isopoint_get_skipped_count(const isopoint_extractor* extractor);

/* Least and greatest value of the samples that take part; NaN if there are none. */
ISOPOINT_API void isopoint_get_value_range(const isopoint_extractor* extractor, double range[2]);

/* -------------------------------------------------------------------------------- */
/* Surfaces: their calls use the threads and callbacks that the extractor had when it made them. */

/* Extracts isosurfaces: for each isovalue, once and ascending, the points where edges between
 * neighboring samples cross it. The first extraction takes O(n) for the levels of the tree that
 * are larger than the surface, further ones what lies near the surface.
 * @param isovalues `count` numbers, infinite ones included, without NaN
 * @param options null: the defaults
 * @param surface receives a surface, to be freed by isopoint_destroy_surface(). It may have no
 * points; then isopoint_get_message() says why, if there are isovalues */
ISOPOINT_API isopoint_status isopoint_extract(isopoint_extractor* extractor,
  const double* isovalues, int64_t count, const isopoint_options* options,
  isopoint_surface** surface);

/* Frees a surface and its arrays, or nothing if it is null. */
ISOPOINT_API void isopoint_destroy_surface(isopoint_surface* surface);

/* What the user may have to know of a result, such as that samples were left out or that an
 * isovalue has no surface: a sentence, and the remedy. Null if there is no message of this number.
 * @param index from 0 on
 * @param is_warning null, or receives 1 if the result is not what was asked for, else 0 */
ISOPOINT_API const char* isopoint_get_message(
  const isopoint_surface* surface, int64_t index, int32_t* is_warning);

/* The points that no fit moved: all of them without a projection. */
ISOPOINT_API int64_t isopoint_get_unprojected_count(const isopoint_surface* surface);

/* The edges, or tetrahedra of triangles, that were left out since they lie in gaps. */
ISOPOINT_API int64_t isopoint_get_dropped_count(const isopoint_surface* surface);

/* The arrays of a surface. Points are ordered by isovalue, then by their edges; of triangles with
 * ISOPOINT_PROJECTION_CREASE, points that are added at creases follow. Positions beyond the range of
 * float have infinite numbers in arrays of float. */
typedef enum isopoint_array_id
{
  ISOPOINT_POINTS = 0,            /* three float or double */
  ISOPOINT_ISOVALUES = 1,         /* double: that of each point */
  ISOPOINT_NORMALS = 2,           /* three float, of length 1, to decreasing values */
  ISOPOINT_GRADIENTS = 3,         /* three float, in units of values per unit of positions */
  ISOPOINT_PROJECTION_ORDERS = 4, /* uint8: the ISOPOINT_PROJECTION_... that moved each point */
  /* Of a regularized vertex, which several crossings have become, the edge of the nearest one: */
  ISOPOINT_EDGES = 5,             /* two int64: the samples at its ends, the lower number first */
  ISOPOINT_EDGE_PARAMETERS = 6,   /* double: where on its edge a point is, from 0 to 1 */
  ISOPOINT_TRIANGLES = 7,         /* three int64: points, counterclockwise seen from lower values */
  /* The splat of a point p with the normal n is a fan of triangles from p to each two consecutive
   * of eight corners. Let r be its radius, t1 its axis, and t2 the cross product n x t1. */
  ISOPOINT_RADII = 8,      /* float: r, the distance of the farthest corner; 0 without corners */
  ISOPOINT_SPLAT_AXES = 9, /* three float: t1, tangential and as long as r */
  /* 40 float: a, b, h, u, v of each corner, which is at p + a t1 + b t2 + h r n and has the normal
   * n + (u t1 + v t2) / r, not of length 1. Counterclockwise seen from the tip of n; further corners
   * repeat the last one; all are 0 at a point that another one close by represents. */
  ISOPOINT_SPLAT_POLYGONS = 10,
  /* After isopoint_make_splat_mesh(): */
  ISOPOINT_SPLAT_VERTICES = 11,       /* three float or double, as points */
  ISOPOINT_SPLAT_VERTEX_NORMALS = 12, /* three float */
  ISOPOINT_SPLAT_VERTEX_POINTS = 13,  /* int64: the point of each vertex */
  ISOPOINT_SPLAT_TRIANGLES = 14       /* three int64: vertices */
} isopoint_array_id;

/* An array of a surface, whose memory is valid until the surface is destroyed; of a splat mesh,
 * until the next one is made. It has no tuples where the options did not ask for it. */
ISOPOINT_API isopoint_status isopoint_get_array(
  const isopoint_surface* surface, int32_t array_id, isopoint_array* array);

/* Interpolates an array of the samples at the points of a surface, as many components and of the
 * same type: integers are rounded to the nearest, those of 64 bits to double first. Samples at one
 * position have their mean.
 * @param of_samples as many tuples as samples were passed to isopoint_set_samples()
 * @param result memory for a tuple of each point, one after the other */
ISOPOINT_API isopoint_status isopoint_interpolate(
  const isopoint_surface* surface, const isopoint_array* of_samples, void* result);

/* Makes a surface of points with splats that were kept from an earlier one, such as those in a file or
 * a part of them, to make a splat mesh of it. It has these arrays alone, and runs on all cores. O(n)
 * @param points three float or double
 * @param normals, axes, polygons one tuple for each point, of types and components as in
 * isopoint_array_id
 * @param surface receives a surface, to be freed by isopoint_destroy_surface() */
ISOPOINT_API isopoint_status isopoint_create_surface(const isopoint_array* points,
  const isopoint_array* normals, const isopoint_array* axes, const isopoint_array* polygons,
  isopoint_surface** surface);

/* Makes the triangles of all splats, for renderers of meshes, in place of former ones: each splat
 * has vertices of its own. Needs compute_normals and compute_splats. After an error the former ones
 * stay. O(n log n)
 * @param scale factor on the size of splats, greater than 0; 1 closes the surface */
ISOPOINT_API isopoint_status isopoint_make_splat_mesh(isopoint_surface* surface, double scale);

/* The means of an array of the points at the vertices of splats, where splats that meet at one
 * vertex count alike, so that colors are smooth across them.
 * @param of_points of type float or double, a tuple for each point
 * @param result memory for a tuple of each vertex, one after the other, of the same type */
ISOPOINT_API isopoint_status isopoint_average_at_splat_vertices(
  const isopoint_surface* surface, const isopoint_array* of_points, void* result);

#ifdef __cplusplus
}
#endif

#endif
