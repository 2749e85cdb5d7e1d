// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkScatteredIsosurfaceFilter
 * @brief   extract isosurfaces as triangles, directly from scattered samples
 *
 * vtkScatteredIsosurfaceFilter generates triangles on one or more isosurfaces of a scalar field
 * that is given at scattered samples. They are those of the Delaunay tetrahedralization of all
 * samples (marching tetrahedra), which it does not build: only samples near the surface are
 * tetrahedralized, and each tetrahedron that crosses the isovalue is certified against all samples.
 * docs/triangles.md in the source distribution defines the result and proves that it is the same.
 * By default they are then made fewer and well shaped (see SetRegularize()).
 *
 * Inputs, samples, isovalues, blocks, errors and what is kept between updates are those of
 * vtkScatteredIsopointFilter, and so are the guarantees of its class documentation, except for the
 * following. In the output, a vtkPolyData (or a composite; see SetContourBlocks()),
 *
 * 1. with RegularizeOff(), each edge of the tetrahedralization that crosses the isovalue has one
 *    point. Points are ordered by isovalue, then by the lower and the higher sample id of their
 *    edge. Where samples have the isovalue, the edges that end at one of them share one point
 *    there, in the place of the first of them, and triangles without area are left out. With
 *    RegularizeOn(), a point stands for several of these edges: it is ordered by the one that is
 *    crossed nearest to it, and its arrays are means over all of them.
 * 2. triangles are ordered by isovalue, then by their points, the lowest first. Their right-hand
 *    normals point to decreasing values, as those of vtkContourFilter do. All coordinates and
 *    triangles depend on the input and the options alone, to the last bit.
 * 3. the surface has no border but where it meets a gap or the outside of the cloud; with
 *    DropGapsOff(), where it meets the convex hull of the samples. Each other edge has two
 *    triangles, or four where the surface touches itself in samples that have the isovalue.
 *
 * Projection moves points as it does isopoints, except where that would turn a triangle over: then
 * its points stay and are counted (see GetNumberOfUnprojectedPoints()). Normals are those of the
 * field (NORMALS_FROM_FIELD), or the means of the normals of the triangles around (with
 * NORMALS_FROM_PLANES, and where the samples yield no gradient).
 *
 * CREASE_FIT adds points on the edges and at the corners of bodies, behind all others; they have
 * the interpolated arrays of a point nearby. Points there may be merged. With ComputeNormals,
 * points on edges are repeated for each side, so that these are shaded sharply: the surface then
 * has borders there, whose points coincide. docs/triangles.md has the rule.
 *
 * DropGaps leaves out the triangles of tetrahedra with edges longer than twice the spacing of the
 * samples behind both ends, if they are connected, across facets, with the outside of the samples'
 * convex hull or with a tetrahedron with an edge longer than four times that. docs/triangles.md has
 * the rule.
 *
 * Samples that are all coplanar have no tetrahedra: the output is then empty.
 *
 * On several ranks (see SetController()) each triangle of one process is in the output of one rank,
 * with its points; those at seams are in several outputs, and counted on one rank. Downstream
 * requests for ghost levels add as many rings of triangles of other ranks, marked in vtkGhostType,
 * as are all points that are counted on other ranks.
 *
 * @warning
 * Where samples are in noise or stand on a few curves, most tetrahedra cross the isovalue, and it
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
   * Whether points are merged and edges of triangles flipped, so that triangles are well shaped:
   * points that are nearest to one sample become one point at their mean, short edges are merged
   * likewise, both where that keeps the topology, and edges are flipped to be Delaunay. That leaves
   * about a third of the points and triangles, and takes less time. Off: the exact isosurface of
   * the Delaunay tetrahedralization (marching tetrahedra). docs/triangles.md has the rule.
   * Default: on.
   */
  virtual void SetRegularize(vtkTypeBool regularize);
  virtual vtkTypeBool GetRegularize();
  vtkBooleanMacro(Regularize, vtkTypeBool);
  ///@}

protected:
  vtkScatteredIsosurfaceFilter();
  ~vtkScatteredIsosurfaceFilter() override = default;

private:
  vtkScatteredIsosurfaceFilter(const vtkScatteredIsosurfaceFilter&) = delete;
  void operator=(const vtkScatteredIsosurfaceFilter&) = delete;
};

#endif
