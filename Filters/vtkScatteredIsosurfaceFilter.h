// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkScatteredIsosurfaceFilter
 * @brief   extract isosurfaces as triangles, directly from scattered samples
 *
 * vtkScatteredIsosurfaceFilter generates triangles on one or more isosurfaces of a scalar field
 * given at scattered samples. They are the marching tetrahedra of the Delaunay tetrahedralization
 * of all samples, which is not built: the filter tetrahedralizes only samples near the surface, and
 * certifies each tetrahedron that crosses the isovalue against all samples. docs/triangles.md in
 * the source distribution defines the result and proves that it is the same. By default the
 * triangles are then made fewer and well shaped (see SetRegularize()).
 *
 * Inputs, samples, isovalues, blocks, errors, the kept tree and the guarantees are those of
 * vtkScatteredIsopointFilter, except for the following. In the output, a vtkPolyData (or a
 * composite; see SetContourBlocks()),
 * 1. with RegularizeOff(), each edge of the tetrahedralization that crosses the isovalue has one
 *    point. Points are ordered by isovalue, then by the lower and the higher sample id of their
 *    edge. Edges that end at a sample with the isovalue share one point there, in the place of the
 *    first of them, and triangles without area are left out. With RegularizeOn(), a point
 *    represents several of these edges: it is ordered by the edge crossed nearest to it, and its
 *    arrays are means over all of them.
 * 2. triangles are ordered by isovalue, then by their points, the lowest first. Their right-hand
 *    normals point to decreasing values, as in vtkContourFilter. All coordinates and triangles
 *    depend only on the input and the options, to the last bit.
 * 3. the surface has borders only at gaps and at the outside of the cloud; with DropGapsOff(), only
 *    at the convex hull of the samples. Each other edge has two triangles, or four where the
 *    surface touches itself in samples with the isovalue.
 *
 * Projection moves points as it does isopoints, unless a triangle would turn over: then its points
 * stay and are counted (see GetNumberOfUnprojectedPoints()). Normals are those of the field
 * (NORMALS_FROM_FIELD), or means of the normals of the triangles around (NORMALS_FROM_PLANES, and
 * where the samples yield no gradient).
 *
 * CREASE_FIT adds points on the edges and at the corners of bodies, after all others; they have
 * the interpolated arrays of a point nearby. Points there may be merged. With ComputeNormals,
 * points on edges are repeated for each side, which shades the sides sharply: the surface then has
 * borders with coincident points. See docs/triangles.md.
 *
 * DropGaps drops the tetrahedra with edges longer than twice the spacing of the samples behind both
 * ends, if they are connected, across facets, with the outside of the samples' convex hull or with
 * a tetrahedron with an edge longer than four times that. See docs/triangles.md.
 *
 * If all samples are coplanar there are no tetrahedra, and the output is empty.
 *
 * In a process group (see SetController()), each triangle that one process would find is in the
 * output of one rank, with its points. Points at seams are in several outputs, and counted on one
 * rank. Downstream requests for ghost levels add as many rings of triangles of other ranks, marked
 * in vtkGhostType, as are all points that are counted on other ranks.
 *
 * @warning
 * If samples are noise or lie on a few curves, most tetrahedra cross the isovalue, and the filter
 * takes as long as the tetrahedralization of all samples.
 *
 * @sa
 * vtkScatteredIsopointFilter vtkContourFilter vtkDelaunay3D
 */

#ifndef vtkScatteredIsosurfaceFilter_h
#define vtkScatteredIsosurfaceFilter_h

#include "vtkScatteredContourFilter.h"
#include "vtkScatteredIsopointFiltersModule.h" // for the export macro

class VTKSCATTEREDISOPOINTFILTERS_EXPORT vtkScatteredIsosurfaceFilter
  : public vtkScatteredContourFilter
{
public:
  static vtkScatteredIsosurfaceFilter* New();
  vtkTypeMacro(vtkScatteredIsosurfaceFilter, vtkScatteredContourFilter);

  ///@{
  /**
   * Whether to merge points and flip edges, so that triangles are well shaped. Points nearest to
   * the same sample become one point at their mean, short edges are merged too, both if that keeps
   * the topology, and edges are flipped to be Delaunay. This leaves about a third of the points and
   * triangles, and takes less time. If off, the output is the exact isosurface of the Delaunay
   * tetrahedralization (marching tetrahedra). See docs/triangles.md. Default: on.
   */
  virtual void SetRegularize(vtkTypeBool regularize);
  virtual vtkTypeBool GetRegularize();
  vtkBooleanMacro(Regularize, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the surface is that of the body of the samples at or above the isovalue: closed by caps
   * where the samples end, with outward normals, and 2-manifold. The body is the union of the
   * tetrahedra that are not in gaps, as docs/triangles.md defines them for bodies; with
   * DropGapsOff() it is the convex hull. Vertices of caps at samples have the arrays of the sample.
   * The cell array IsCap is 1 in caps. An isovalue of minus infinity gives the body of all samples.
   * Not with the projection CREASE_FIT, ComputeGradientsOn() or NORMALS_FROM_FIELD. Default: off.
   */
  virtual void SetCapping(vtkTypeBool capping);
  virtual vtkTypeBool GetCapping();
  vtkBooleanMacro(Capping, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The least area of a connected component, as a share of the area of the isovalue's largest one.
   * Smaller ones, such as droplets, are left out. With CappingOn(), bubbles, with a negative
   * volume, stay unless they are within one that is left out. From 0, for none, to 1. Default: 0.
   */
  virtual void SetMinimumPieceSize(double share);
  virtual double GetMinimumPieceSize();
  ///@}

protected:
  vtkScatteredIsosurfaceFilter();
  ~vtkScatteredIsosurfaceFilter() override = default;

private:
  vtkScatteredIsosurfaceFilter(const vtkScatteredIsosurfaceFilter&) = delete;
  void operator=(const vtkScatteredIsosurfaceFilter&) = delete;
};

#endif
