// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkScatteredIsopointFilter
 * @brief   extract isosurfaces as points, straight from scattered samples
 *
 * vtkScatteredIsopointFilter takes anything with a scalar at points or cells, ignores how these are
 * connected, and generates points on one or more isosurfaces: no tetrahedra are built and nothing
 * is resampled. The samples are the points of a vtkDataSet of any kind, the centers of its cells
 * where the array is one of cells, or the leaves of a vtkHyperTreeGrid; those of all blocks of a
 * composite data set, or of all levels of an AMR, form one cloud, so that the surface runs across
 * borders, gaps and overlaps (see SetContourBlocks). The output is a vtkPolyData of points, each
 * with a vertex cell, a normal and the radius of a splat; together the splats cover the surface.
 *
 * The algorithm is that of Rosenthal and Linsen, "Direct isosurface extraction from scattered
 * volume data" (EuroVis 2006): a kd-tree parts space until each cell holds one position. Cells that
 * touch are neighbours. A neighbour is dropped if a closer one lies in nearly the same direction
 * (see SetAngle). Where the isovalue lies between a sample and a remaining neighbour, the isopoint
 * is interpolated linearly. Unlike the paper, a node is split along the longest side of its region,
 * and only the part of the tree that surrounds the surface is ever built.
 *
 * Going past the paper, each isopoint is then moved to the zero of a polynomial, fitted by weighted
 * least squares to the samples of the two cells its edge connects and of those that touch them (see
 * SetProjection). It is of degree two, or of degree three where that leaves residuals. On smooth
 * fields that is twenty to a hundred times closer to the true surface than linear interpolation,
 * and the fit's gradient is a better normal than a plane through nearby isopoints. Where samples
 * are noisy, degree three is no better than degree two, and points stay. On six scanned and
 * simulated volumes, of which it saw a quarter of the voxels, points came 2 to 53 % nearer to the
 * surface of all voxels than linear interpolation puts them, normals as near or nearer: that is why
 * CUBIC_FIT is the default. LINEAR_FIT, which smooths everything, is not safe so. CREASE_FIT also
 * fits two to four functions of degree one or two, of which the largest or the smallest counts, and
 * points go to the nearer sheet: of random samples of a cube, 0.3 % of the normals are then off by
 * more than five degrees instead of 20 %, and 0.1 % instead of 4 % of two balls joined.
 *
 * What is promised:
 * 1. The same samples, isovalues and angle give the same points, bit for bit and in the same order,
 *    whatever the number of threads, the vtkSMPTools backend, and what was asked for before.
 *    Points are ordered by isovalue (ascending), then by the lower and the higher id of the two
 *    samples they lie between.
 * 2. A sample is below an isovalue v if its value is less than v. Each pair of neighbours of which
 *    one is below gives one point. The point's scalar is v exactly, as the array's type holds it:
 *    float and double arrays keep their type, integer arrays become double.
 * 3. Samples with a non-finite coordinate or value, ghosts and hidden ones are left out and counted
 *    (GetNumberOfSkippedSamples). Hidden are also cells with a hidden point, cells covered by a
 *    finer level of an AMR (as its ghost arrays mark them: see vtkAMRUtilities::BlankCells), points
 *    that belong to such cells alone or, where the points have no ghost array, to these and ghost
 *    cells alone, empty cells, masked leaves, and blocks without the array.
 * 4. Samples at exactly one position count as one, with the lowest id among them and the mean of
 *    their values and attributes.
 * 5. All arrays of the points (or cells, if the contoured one is theirs) are interpolated with the
 *    same weight, that of the edge's place nearest to the point; arrays that cannot be (strings,
 * ids) are copied from the nearer end. Global ids, ghost arrays, arrays that are not as long as
 * there are points and, as by vtkAppendFilter, arrays that not all blocks have with the same type
 * are dropped. Arrays with the name of a computed one ("Normals", "Radius", ...) give way to it,
 * with a warning.
 * 6. Wrong use and a lack of memory give one error that says what to do, and an empty output; an
 *    abort gives an empty output. The filter works again afterwards.
 *
 * What becomes of degenerate clouds follows from this: no sample is an error; one sample, samples
 * at one position, a constant field, an infinite isovalue and one out of range have no points; two
 * samples have one between them where they lie on either side; collinear samples have one wherever
 * the field crosses along the line, coplanar ones a curve in their plane. -0 is 0, as a coordinate
 * and as a value; a value equal to the isovalue is not below it. A lattice is a cloud like any
 * other. Coordinates may be denormal, have any scale or lie far off the origin: nothing but their
 * order and differences in double counts; radii are kept within float's range. 64-bit integers
 * count as the nearest double. No order of the input changes the surface of samples at different
 * positions, other than in the last bits, and none makes it slow.
 *
 * The tree is kept between updates: another isovalue costs only what it adds, another angle or
 * output option nothing, and new values at the same positions (a time series) keep its shape. It
 * takes 20 bytes a sample for float points with a scalar that float holds, up to 40 otherwise, plus
 * what the surface needs, and the centers of cells other than those of images and rectilinear
 * grids. No array of the input is copied. See SetKeepTree.
 *
 * @warning
 * Regions fill the bounding box of the samples. Samples on both sides of a void are neighbours, as
 * in a Delaunay tetrahedrisation, and can put points into the void. See SetGapFactor.
 *
 * @warning
 * Distances between samples are squared in double: neighbours closer than 1e-150 or farther apart
 * than 1e150 escape the angle criterion.
 *
 * @warning
 * Time grows with the number of cells that touch. That is about 15 for each sample and stays so for
 * all that was found but samples on curves that pass each other, such as two skew lines, where
 * neighbourhoods are searched instead of listed. (A Delaunay tetrahedrisation of them has quadratic
 * size.) Fits take no more than a few hundred samples: where a cell touches more than 256 others,
 * one of those that lie close together as seen from it stands for all.
 *
 * @warning
 * 64-bit integer values beyond 2^53 are rounded to double.
 *
 * @sa vtkContourFilter vtkPointGaussianMapper
 */

#ifndef vtkScatteredIsopointFilter_h
#define vtkScatteredIsopointFilter_h

#include "vtkNew.h" // for the contour values
#include "vtkPolyDataAlgorithm.h"
#include "vtkScatteredIsopointFiltersModule.h" // for the export macro

#include <cstddef> // for std::size_t
#include <memory>  // for std::unique_ptr
#include <vector>  // for lists of blocks and surfaces

namespace isopoint
{
struct Execution;
struct ExtractedIsosurface;
} // namespace isopoint
class vtkContourValues;
class vtkDataObject;
struct vtkIsopointBlock;

class VTKSCATTEREDISOPOINTFILTERS_EXPORT vtkScatteredIsopointFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkScatteredIsopointFilter* New();
  vtkTypeMacro(vtkScatteredIsopointFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The isovalues, as in vtkContourFilter. Any numbers; repeated ones count once. A value
   * outside the scalar's range gives no points. Default: one, 0.
   */
  void SetValue(int i, double value);
  double GetValue(int i);
  double* GetValues();
  void GetValues(double* contourValues);
  void SetNumberOfContours(int number);
  vtkIdType GetNumberOfContours();
  void GenerateValues(int numContours, double range[2]);
  void GenerateValues(int numContours, double rangeStart, double rangeEnd);
  ///@}

  ///@{
  /**
   * The angle of the neighbourhood's criterion in degrees, 0 up to 180: a neighbour is dropped if
   * a closer one is seen from the sample within less than this angle of it. Smaller angles keep
   * more neighbours and give more points, a little farther from the true surface. Default: 54.7,
   * just under the 54.7356 degrees between an edge and a diagonal of a cube.
   */
  vtkSetMacro(Angle, double);
  vtkGetMacro(Angle, double);
  ///@}

  enum ProjectionMethod
  {
    NO_PROJECTION = 0,
    LINEAR_FIT = 1,
    QUADRATIC_FIT = 2,
    CUBIC_FIT = 3,
    CREASE_FIT = 4
  };

  ///@{
  /**
   * Whether and how isopoints are moved from their edges to where a least-squares polynomial
   * through the samples around has the isovalue: NO_PROJECTION (they stay where linear
   * interpolation puts them), LINEAR_FIT (an affine function, which smooths noise but flattens what
   * is curved), QUADRATIC_FIT (degree two), CUBIC_FIT (degree two, and three where that leaves
   * residuals of more than a five hundredth of the samples' distances) or CREASE_FIT (the same, and
   * where the samples tell of a crease two to four functions that meet there; for bodies with sharp
   * edges: where there are none it takes longer, and may see some that are not). No point moves
   * farther than half its edge's length; where no fit describes the samples, as in noise, it stays,
   * and is counted (GetNumberOfUnprojectedPoints): to tell that takes up to five times as long as
   * the extraction, with creases up to nine times, and more where there are many. What residuals
   * tell of is decided together with up to 255 isopoints around: where some of these are dropped,
   * others may move. Default: CUBIC_FIT.
   */
  vtkSetClampMacro(Projection, int, NO_PROJECTION, CREASE_FIT);
  vtkGetMacro(Projection, int);
  ///@}

  enum NormalMethods
  {
    NORMALS_FROM_FIELD = 0,
    NORMALS_FROM_PLANES = 1
  };

  ///@{
  /**
   * Where normals come from: NORMALS_FROM_FIELD (the gradient of the fit, which Projection chooses;
   * that of CUBIC_FIT with NO_PROJECTION; where no fit held, that of an affine function, or else
   * planes) or NORMALS_FROM_PLANES (the plane through the nearest isopoints, as in the paper; see
   * SetNumberOfNeighbors). Default: NORMALS_FROM_FIELD.
   */
  vtkSetClampMacro(NormalMethod, int, NORMALS_FROM_FIELD, NORMALS_FROM_PLANES);
  vtkGetMacro(NormalMethod, int);
  ///@}

  ///@{
  /**
   * Whether to compute the array "Gradients" (three floats): the contoured array's gradient, in its
   * units over the points', of the fit; where none held, that of an affine function through the
   * samples around, or else the slope along the point's edge. Default: off.
   */
  vtkSetMacro(ComputeGradients, vtkTypeBool);
  vtkGetMacro(ComputeGradients, vtkTypeBool);
  vtkBooleanMacro(ComputeGradients, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether to compute the array "ProjectionOrder" (one unsigned char), which tells what moved each
   * point: 0 nothing, 1 an affine function, 2 a polynomial of degree two, 3 one of degree
   * three, 4 functions that meet at a crease. Default: off.
   */
  vtkSetMacro(ComputeProjectionOrders, vtkTypeBool);
  vtkGetMacro(ComputeProjectionOrders, vtkTypeBool);
  vtkBooleanMacro(ComputeProjectionOrders, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether to compute the arrays "SplatAxis1" and "SplatAxis2" (three floats each, in the units of
   * the points), the half-axes of elliptical splats: long where the surface is flat, short where it
   * bends. SplatAxis1 is the longer, of the length Radius; SplatAxis1 x SplatAxis2 is along the
   * normal. Default: off.
   */
  vtkSetMacro(ComputeSplatAxes, vtkTypeBool);
  vtkGetMacro(ComputeSplatAxes, vtkTypeBool);
  vtkBooleanMacro(ComputeSplatAxes, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether to compute the array "SplatClip" (five floats a, b, c, d, e): of a splat beside a
   * crease, at the point q, only the places p with (a, b, c) . (p - q) + d >= 0 belong to the
   * surface. (a, b, c) is of length 1; d, in the units of the points and not negative, is the
   * distance of the point from the plane at which its splat ends. There the surface turns to the
   * side that the normal points to (e = 1), as in a groove, or to the other (e = -1). All are 0
   * where nothing is to be clipped. Default: off.
   */
  vtkSetMacro(ComputeSplatClips, vtkTypeBool);
  vtkGetMacro(ComputeSplatClips, vtkTypeBool);
  vtkBooleanMacro(ComputeSplatClips, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Drops points on edges across gaps in the cloud, as at a free surface or between groups of
   * boreholes: those longer than this many local spacings, measured behind both ends. Exactly: the
   * spacing behind the end x of an edge {x, y} is the distance from x to the 2nd nearest position
   * of a sample within 54.7356 degrees (its cosine is 1 / sqrt 3) of the direction from y to x,
   * infinite where there are fewer than two. An edge is dropped if it is longer than GapFactor
   * times the larger one of the spacings behind its ends. So edges stay that lead to a sample far
   * from all others, from fine regions to coarse ones, and across lines or slices that are farther
   * apart than their samples; not so where a line's samples scatter sideways as far as they are
   * apart along it. Sensible is 4: it drops the edges across voids of ten spacings and more, none
   * from uniform clouds, lattices or the leaf cells of adaptive grids, and up to a tenth from
   * slices, boreholes and ship casts. Smaller values drop more. 0: nothing is dropped, at no cost.
   * 0 or more, default: 0.
   */
  vtkSetMacro(GapFactor, double);
  vtkGetMacro(GapFactor, double);
  ///@}

  ///@{
  /**
   * Drops isopoints where they stand closer than the samples warrant, so that fewer and larger
   * splats cover the surface. Exactly: the points of each isovalue are taken in their order, and a
   * point is dropped if it is close to one that was kept. Two are close if a fit held around both
   * (see SetProjection; with NO_PROJECTION that of CUBIC_FIT), if their distance is less than the
   * reach r, MinimumSpacing times the smaller of the samples' spacings around them, if each lies
   * within r / 4 of the tangent plane of the other's fit, and if the fits' gradients differ by less
   * than 25 degrees (their cosine is 0.906 or more). A sample's spacing is the distance that two
   * fifths of its neighbours do not exceed, that around a point the mean over the ends of its edge.
   * So sheets close by and the two sides of a crease never thin each other out, a surface stays
   * dense where it bends sharply, and nothing is dropped where no fit holds, as in noise. Of a
   * sphere in random samples 0.25, 0.5, 0.75 and 1 leave 68, 46, 32 and 22 percent of the points.
   * Sensible is 0.5: no hole was seen in smooth surfaces of random, clustered or jittered samples,
   * and hardly more than without in those of samples on lines; larger values open some. At a border
   * the surface may end that much earlier. 0: nothing is dropped, at no cost. 0 up to 1, default:
   * 0.
   */
  vtkSetClampMacro(MinimumSpacing, double, 0.0, 1.0);
  vtkGetMacro(MinimumSpacing, double);
  ///@}

  ///@{
  /**
   * Whether to compute the array "Normals" (three floats, of length 1, active normals): they point
   * to falling values, as vtkContourFilter's do. Default: on.
   */
  vtkSetMacro(ComputeNormals, vtkTypeBool);
  vtkGetMacro(ComputeNormals, vtkTypeBool);
  vtkBooleanMacro(ComputeNormals, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether to compute the array "Radius" (one float, in the units of the points), half the longer
   * axis of a splat that covers what of the surface is nearer to this point than to others. It
   * reaches no farther than the spacing of the samples warrants: where no points bound it, as at
   * a border or around an isolated point, about that spacing. Default: on.
   */
  vtkSetMacro(ComputeRadii, vtkTypeBool);
  vtkGetMacro(ComputeRadii, vtkTypeBool);
  vtkBooleanMacro(ComputeRadii, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the output has the contoured array, which holds the isovalue of each point. Default:
   * on.
   */
  vtkSetMacro(ComputeScalars, vtkTypeBool);
  vtkGetMacro(ComputeScalars, vtkTypeBool);
  vtkBooleanMacro(ComputeScalars, vtkTypeBool);
  ///@}

  ///@{
  /**
   * How many of the nearest isopoints the plane is fitted through that gives a normal where the
   * field does not (see SetNormalMethod). More make for smoother normals and rounder edges. 3 up to
   * 1000, default 12.
   */
  vtkSetClampMacro(NumberOfNeighbors, int, 3, 1000);
  vtkGetMacro(NumberOfNeighbors, int);
  ///@}

  ///@{
  /**
   * The type of the output's points: vtkAlgorithm::SINGLE_PRECISION, DOUBLE_PRECISION, or
   * DEFAULT_PRECISION, the type of the input's points (double for images and rectilinear grids).
   * Computation is in double in any case. Default: DEFAULT_PRECISION.
   */
  vtkSetClampMacro(OutputPointsPrecision, int, SINGLE_PRECISION, DEFAULT_PRECISION);
  vtkGetMacro(OutputPointsPrecision, int);
  ///@}

  ///@{
  /**
   * Whether the tree is kept from one update to the next, so that further isovalues are found in
   * a fraction of the time, or freed at the end of each update. Default: on.
   */
  vtkSetMacro(KeepTree, vtkTypeBool);
  vtkGetMacro(KeepTree, vtkTypeBool);
  vtkBooleanMacro(KeepTree, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether each block of a composite input is contoured by itself: the output is then a composite
   * of the same structure with a vtkPolyData in place of each block that has the array (an AMR
   * becomes a vtkMultiBlockDataSet of levels), which GetOutputDataObject(0) returns. Off: all
   * blocks form one cloud, and the output is one vtkPolyData. Default: off.
   */
  vtkSetMacro(ContourBlocks, vtkTypeBool);
  vtkGetMacro(ContourBlocks, vtkTypeBool);
  vtkBooleanMacro(ContourBlocks, vtkTypeBool);
  ///@}

  ///@{
  /**
   * vtkSMPTools decides on the threads, with one exception: where its backend is "Sequential", as
   * it is by default in Debian's ParaView, and the environment variable VTK_SMP_BACKEND_IN_USE is
   * not set, the filter runs on all cores all the same, within VTK_SMP_MAX_THREADS and
   * vtkSMPTools::Initialize(). Off: "Sequential" is taken at its word. The output is the same in
   * any case. Default: on.
   */
  vtkSetMacro(UseAllCores, vtkTypeBool);
  vtkGetMacro(UseAllCores, vtkTypeBool);
  vtkBooleanMacro(UseAllCores, vtkTypeBool);
  ///@}

  /**
   * Input points (or cells, leaves) that took no part in the last update: non-finite, ghost or
   * hidden ones, and those of blocks without the array.
   */
  vtkGetMacro(NumberOfSkippedSamples, vtkIdType);

  /**
   * Isopoints of the output that the last update left where linear interpolation puts them: all of
   * them with NO_PROJECTION, and those around which no fit held.
   */
  vtkGetMacro(NumberOfUnprojectedPoints, vtkIdType);

  /**
   * Also counts changes of the contour values.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkScatteredIsopointFilter();
  ~vtkScatteredIsopointFilter() override;

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  vtkNew<vtkContourValues> ContourValues;
  double Angle;
  double GapFactor = 0.0;
  double MinimumSpacing = 0.0;
  int Projection = CUBIC_FIT;
  int NormalMethod = NORMALS_FROM_FIELD;
  vtkTypeBool ComputeGradients = 0;
  vtkTypeBool ComputeProjectionOrders = 0;
  vtkTypeBool ComputeSplatAxes = 0;
  vtkTypeBool ComputeSplatClips = 0;
  vtkTypeBool ComputeNormals = 1;
  vtkTypeBool ComputeRadii = 1;
  vtkTypeBool ComputeScalars = 1;
  int NumberOfNeighbors;
  int OutputPointsPrecision = DEFAULT_PRECISION;
  vtkTypeBool KeepTree = 1;
  vtkTypeBool ContourBlocks = 0;
  vtkTypeBool UseAllCores = 1;
  vtkIdType NumberOfSkippedSamples = 0;
  vtkIdType NumberOfUnprojectedPoints = 0;

private:
  vtkScatteredIsopointFilter(const vtkScatteredIsopointFilter&) = delete;
  void operator=(const vtkScatteredIsopointFilter&) = delete;

  class Internals;
  class KeptTree;

  void CheckParameters();
  void ExtractSafely(vtkDataObject* input, vtkDataObject* output);
  void ExtractBlocks(std::size_t begin, std::size_t end, KeptTree& kept, vtkPolyData* output);
  std::vector<isopoint::ExtractedIsosurface> ExtractIsovalues(
    const isopoint::Execution& execution, KeptTree& kept);
  void FillOutput(const isopoint::Execution& execution, const std::vector<vtkIsopointBlock>& blocks,
    std::vector<isopoint::ExtractedIsosurface> surfaces, vtkPolyData* output);

  std::unique_ptr<Internals> Kept;
};

#endif
