// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkScatteredIsopointFilter
 * @brief   extract isosurfaces as points, directly from scattered samples
 *
 * vtkScatteredIsopointFilter generates points on one or more isosurfaces of a scalar field given at
 * scattered samples. It does not resample the field, builds no tetrahedral mesh, and ignores the
 * connectivity of the input. Samples are the points of a vtkDataSet, the centers of its cells if
 * the contoured array is a cell array, or the leaves of a vtkHyperTreeGrid. By default all blocks
 * of a composite data set, or all levels of an AMR, form one cloud, so that the surface continues
 * across borders, gaps and overlaps of blocks (see SetContourBlocks()). The output is a vtkPolyData
 * of points with one vertex cell each. By default every point has a normal and the radius of a
 * splat; together the splats cover the surface.
 *
 * The algorithm is that of P. Rosenthal and L. Linsen, "Direct isosurface extraction from scattered
 * volume data", EuroVis 2006 [RL06]. A kd-tree partitions the bounding box of the samples into
 * regions, one for each sample position. Samples whose regions touch are neighbors. A neighbor is
 * dropped if a closer one lies in nearly the same direction (see SetAngle()). Each edge between a
 * sample below the isovalue and a remaining neighbor not below it gives one isopoint, by linear
 * interpolation. Unlike in [RL06], a node of the tree is split along the longest side of its
 * region, and only the part of the tree around the surface is built.
 *
 * By default each isopoint then moves to the zero of a polynomial fitted by weighted least squares
 * to the samples around it, or part of the way if the zero is uncertain (see SetProjection()). The
 * gradient of the polynomial, or in noise of a simpler one, gives the normal. Values of integer
 * arrays are taken as rounded, so that steps of 1 are not fitted as detail. Fits only depend on
 * samples in the regions that touch those of the edge's ends, and in regions that touch these.
 * Projection and the gap criterion are not part of [RL06]. docs/algorithm.md in the source
 * distribution defines the result exactly.
 *
 * The gap criterion (see SetDropGaps()) drops isopoints by their edges:
 * - The spacing behind the end x of an edge {x, y} is the distance from x to the second nearest
 *   sample position in a cone: within 54.7356 degrees (whose cosine is 1 / sqrt(3)) of the
 *   direction from y to x. It is infinite if there are fewer than two.
 * - An edge is weak if it is longer than twice the spacing behind both ends. It is strong if it is
 *   longer than four times that spacing, with the third nearest position instead of the second.
 * - The isopoints of strong edges are dropped, and those of weak edges that a chain of weak edges
 *   connects with a strong one. Consecutive edges of a chain share an end.
 *
 * Edges between a dense and a sparse region, to an isolated sample, and between lines or slices of
 * samples stay. Closed surfaces amid samples stay closed.
 *
 * The filter guarantees:
 * 1. The output, including the order of the points, depends only on the input and the options, to
 *    the last bit: not on the number of threads, the vtkSMPTools backend, or earlier updates.
 *    Points are ordered by isovalue (ascending), then by the lower and the higher sample id of
 *    their edge.
 * 2. A sample is below the isovalue v if its value is less than v; a value equal to v is not below.
 *    The contoured array of the output is v exactly, within the precision of its type: float and
 *    double arrays keep their type, others become double.
 * 3. These samples are skipped and counted (see GetNumberOfSkippedSamples()): samples with a
 *    non-finite coordinate or value; ghost and hidden points and cells; cells with a hidden point;
 *    cells covered by a finer level of an AMR, as its ghost arrays mark them (see
 *    vtkAMRUtilities::BlankCells()); points whose cells are all hidden or covered or, without a
 *    ghost array of the points, hidden, covered or ghosts; empty cells; masked leaves; and blocks
 *    without the contoured array.
 * 4. Coincident samples count as one sample, with the lowest of their ids and the mean of their
 *    values and attributes.
 * 5. All attributes of the points (or cells, if the contoured array is a cell array) are
 *    interpolated with the same weight, at the place on the edge nearest to the isopoint; strings
 *    and pedigree ids are copied from the nearer end. Dropped are global ids, ghost arrays, arrays
 *    whose length is not the number of points (or cells) and, as in vtkAppendFilter, arrays that
 *    not all blocks have with the same type. A computed array ("Normals", "Radius", ...) replaces
 *    an input array of the same name, with a warning.
 * 6. Each update gives at most one warning for each of these: isovalues outside the range of the
 *    array; isovalues in the range without a surface; all samples skipped; no fit at more than half
 *    of the points although fits were requested; splats apart at more than a tenth of their
 *    inner corners; each array that a computed one replaces; and pieces of several processes (see
 *    vtkScatteredContourFilter). If only some samples are skipped, there is a MessageEvent instead.
 *    There is neither if all skipped samples are ghosts or hidden, nor while the cause of the last
 *    update's message lasts. In a process group, the first rank reports for all.
 * 7. Invalid input, invalid options and a lack of memory give one error and an empty output; an
 *    abort gives an empty output. The filter can be updated again afterwards.
 *
 * Degenerate clouds are valid, but an input without points or cells is an error. The output has no
 * points for a single sample, for samples that all coincide, for a constant field, and for an
 * isovalue that is infinite or out of range. Two samples have one isopoint if the isovalue lies
 * between them, collinear samples one for each crossing along the line, coplanar samples a curve in
 * their plane. Lattices need no perturbation. -0 equals 0, as a coordinate and as a value.
 * Coordinates may be denormal, of any scale, or far from the origin: the tree uses only their order
 * and differences in double precision. Radii are clamped to the positive range of float.
 *
 * The tree is kept between updates (see SetKeepTree()). A further isovalue extends it as necessary,
 * another angle or output option uses it as is, and new values at the same positions (a time
 * series) keep its shape. It takes 20 bytes per sample if the points are float and float holds the
 * values exactly, otherwise up to 40, plus memory in proportion to the surface. The centers of
 * cells are stored too, except for images and rectilinear grids. Input arrays are not copied.
 *
 * @warning
 * The regions fill the bounding box of the samples. As in a Delaunay tetrahedralization, samples on
 * both sides of a void are therefore neighbors, and can give isopoints in the void. See
 * SetDropGaps().
 *
 * @warning
 * 64-bit integer values beyond 2^53 are rounded to double.
 *
 * @warning
 * Squared distances between samples are computed in double precision: the angle criterion never
 * drops neighbors closer than 1e-150 or farther apart than 1e150.
 *
 * @warning
 * Time is proportional to the number of pairs of neighbors, about 15 per sample. Samples on curves
 * that pass each other, such as two skew lines, can have many more, up to the square of their
 * number; large neighborhoods are then searched through bounding boxes instead of listed. Fits use
 * at most a few hundred samples: of more than 256 neighbors, one represents those close to each
 * other.
 *
 * @sa
 * vtkScatteredIsosurfaceFilter vtkContourFilter vtkPointGaussianMapper
 */

#ifndef vtkScatteredIsopointFilter_h
#define vtkScatteredIsopointFilter_h

#include "vtkScatteredContourFilter.h"
#include "vtkScatteredIsopointFiltersModule.h" // for the export macro

class VTKSCATTEREDISOPOINTFILTERS_EXPORT vtkScatteredIsopointFilter
  : public vtkScatteredContourFilter
{
public:
  static vtkScatteredIsopointFilter* New();
  vtkTypeMacro(vtkScatteredIsopointFilter, vtkScatteredContourFilter);

  ///@{
  /**
   * The angle of the angle criterion, in degrees: a neighbor of a sample is dropped if a closer
   * neighbor lies within this angle of its direction. An edge gives an isopoint if it remains at
   * either end. Smaller angles give more isopoints, slightly farther from the true surface. At 0 no
   * neighbor is dropped; at 180 only the nearest remain, and those exactly opposite to closer ones.
   * Range: 0 to 180; other values are an error in the next update. Default: 54.7, just below the
   * angle between an edge and a diagonal of a cube (54.7356), so that diagonals of lattices remain.
   */
  virtual void SetAngle(double degrees);
  virtual double GetAngle();
  ///@}

  ///@{
  /**
   * Whether to compute splats, which cover the surface. The splat of an isopoint is the fan of
   * triangles between it and each two consecutive corners of its Voronoi cell on the surface.
   * Splats bend with the surface, end where it ends or has a crease, and share most corners with
   * their neighbors. "Radius" is a point array. The others are cell arrays of the vertices, where
   * cell i belongs to point i; ParaView's menus hide them (vtkAbstractArray::GUI_HIDE()). Default:
   * on.
   * - "Radius" (one float, in units of the coordinates): the distance of the farthest corner, or
   *   the size of a disk for mappers that draw disks.
   * - "SplatAxis" (three floats, in units of the coordinates): a tangential vector t1 as long as
   *   the radius; t2 is normal x t1. It is the active vectors, so that transforms rotate it.
   * - "SplatPolygon" (40 floats, five for each of eight corners, counterclockwise seen from the tip
   *   of the normal N): a, b, h, u, v. The corner is at a t1 + b t2 + h Radius N from the isopoint
   *   and has the normal N + (u t1 + v t2) / Radius, not of length 1. Unused corners repeat the
   *   last one. All are 0, as is the radius, if another isopoint close by represents this one.
   */
  virtual void SetComputeSplats(vtkTypeBool compute);
  virtual vtkTypeBool GetComputeSplats();
  vtkBooleanMacro(ComputeSplats, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The number of isopoints used to fit the plane that gives a normal (NORMALS_FROM_PLANES, and
   * where the samples yield no gradient): the nearest within two rings of touching cells. More give
   * smoother normals and rounder edges. Range: 3 to 1000; other values are clamped. Default: 12.
   */
  virtual void SetNumberOfNeighbors(int number);
  virtual int GetNumberOfNeighbors();
  ///@}

  /**
   * Whether splats of the last update do not meet at so many corners that pictures may have holes.
   * The update warned then, unless the update before had.
   */
  vtkTypeBool AreSplatsApart();

protected:
  vtkScatteredIsopointFilter();
  ~vtkScatteredIsopointFilter() override = default;

private:
  vtkScatteredIsopointFilter(const vtkScatteredIsopointFilter&) = delete;
  void operator=(const vtkScatteredIsopointFilter&) = delete;
};

#endif
