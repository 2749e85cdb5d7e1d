// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkScatteredIsopointFilter
 * @brief   extract isosurfaces as points, directly from scattered samples
 *
 * vtkScatteredIsopointFilter generates points on one or more isosurfaces of a scalar field that is
 * given at scattered samples. It neither resamples the field nor builds a tetrahedral mesh, and
 * ignores the connectivity of the input. The samples are the points of a vtkDataSet, the centers
 * of its cells if the contoured array is a cell array, or the leaves of a vtkHyperTreeGrid. By
 * default all blocks of a composite data set, or all levels of an AMR, form one cloud, so that the
 * surface continues across borders, gaps and overlaps of blocks (see SetContourBlocks()). The
 * output is a vtkPolyData of points with one vertex cell each. By default every point has a normal
 * and the radius of a splat; together the splats cover the surface.
 *
 * The algorithm is that of P. Rosenthal and L. Linsen, "Direct isosurface extraction from scattered
 * volume data", EuroVis 2006 [RL06]. A kd-tree partitions the bounding box of the samples into
 * regions, one for each sample position. Samples whose regions touch are neighbors. A neighbor is
 * dropped if a closer one lies in nearly the same direction (see SetAngle()). Each edge between a
 * sample below the isovalue and a remaining neighbor not below it gives one isopoint, by linear
 * interpolation. Unlike in [RL06], a node of the tree is split along the longest side of its
 * region, and only the part of the tree around the surface is built.
 *
 * By default each isopoint is then moved to the zero of a polynomial, which is fitted by weighted
 * least squares to the samples around it, and by less than that where the samples leave doubt about
 * the zero (see SetProjection()). The gradient of the polynomial gives the normal, in noise that of
 * a simpler one. Values of an array of an integer type count as rounded: steps of 1 between them
 * are taken for no detail. What is fitted depends on samples next to the isopoint alone: in the
 * regions that touch those of its edge's ends, and in regions that touch these. This step, thinning
 * (see SetMinimumSpacing()) and the gap criterion (see SetDropGaps()) have no counterpart in
 * [RL06]. docs/algorithm.md in the source distribution defines the result exactly.
 *
 * The filter guarantees:
 * 1. The output depends on the input and the options alone, to the last bit and including the order
 *    of the points: not on the number of threads, the vtkSMPTools backend, or earlier updates.
 *    Points are ordered by isovalue (ascending), then by the lower and the higher sample id of
 *    their edge.
 * 2. A sample is below the isovalue v if its value is less than v; a value equal to v is not below.
 *    The contoured array of the output is v exactly, as far as its type holds it: an array of float
 *    or double keeps its type, others become double.
 * 3. These take no part and are counted (see GetNumberOfSkippedSamples()): samples with a
 *    non-finite coordinate or value; ghost and hidden points and cells; cells with a hidden point;
 *    cells covered by a finer level of an AMR, as its ghost arrays mark them (see
 *    vtkAMRUtilities::BlankCells()); points all of whose cells are hidden or covered or, if there
 *    is no ghost array of the points, hidden, covered or ghosts; empty cells; masked leaves; and
 *    blocks without the contoured array.
 * 4. Coincident samples count as one sample, with the lowest of their ids and the mean of their
 *    values and attributes.
 * 5. All attributes of the points (or cells, if the contoured array is a cell array) are
 *    interpolated with one weight, that of the place on the edge nearest to the isopoint; strings
 *    and pedigree ids are copied from the nearer end. The following are dropped: global ids, ghost
 *    arrays, arrays whose length is not the number of points (or cells), and, as by
 *    vtkAppendFilter, arrays that not all blocks have with the same type. A computed array
 *    ("Normals", "Radius", ...) replaces an input array of its name, with a warning.
 * 6. There is one warning for an update of each of these: isovalues outside the range of the array;
 *    skipped samples, unless all of them are ghosts or hidden; and more than half of the points
 *    left where linear interpolation puts them although fits were requested. On several ranks the
 *    first one reports what all of them found.
 * 7. Invalid input, invalid options and a lack of memory give one error and an empty output; an
 *    abort gives an empty output. The filter can be updated again afterwards.
 *
 * Degenerate clouds are no special cases. An input without points or cells is an error. The output
 * has no points for a single sample, samples that all coincide, a constant field, and an isovalue
 * that is infinite or out of range. Two samples have one isopoint if the isovalue lies between
 * them, collinear samples one for each crossing along the line, coplanar samples a curve in their
 * plane. Lattices need no perturbation. -0 equals 0, as a coordinate and as a value. Coordinates
 * may be denormal, of any scale, or far from the origin: the tree uses only their order and
 * differences in double precision. Radii are clamped to the positive range of float.
 *
 * The tree is kept between updates (see SetKeepTree()). A further isovalue extends it where
 * necessary, another angle or output option uses it as it is, and new values at the same positions
 * (a time series) keep its shape. It takes 20 bytes per sample if the points are float and float
 * holds the values exactly, and up to 40 otherwise, plus memory in proportion to the surface. The
 * centers of cells are stored as well, except for images and rectilinear grids. Input arrays are
 * not copied.
 *
 * @warning
 * The regions fill the bounding box of the samples. Samples on both sides of a void are therefore
 * neighbors, as in a Delaunay tetrahedralization, and can give isopoints in the void. See
 * SetDropGaps().
 *
 * @warning
 * 64-bit integer values beyond 2^53 are rounded to double.
 *
 * @warning
 * Squared distances between samples are computed in double precision: neighbors closer than 1e-150
 * or farther apart than 1e150 escape the angle criterion.
 *
 * @warning
 * Time is proportional to the number of pairs of neighbors, which is about 15 per sample. Samples
 * on curves that pass each other, such as two skew lines, can have many more, in all up to the
 * square of their number; large neighborhoods are then searched through bounding boxes instead of
 * listed. Fits use at most a few hundred samples: of more than 256 neighbors, those close to each
 * other are represented by one.
 *
 * @sa
 * vtkScatteredIsosurfaceFilter vtkContourFilter vtkPointGaussianMapper
 */

#ifndef vtkScatteredIsopointFilter_h
#define vtkScatteredIsopointFilter_h

#include "vtkNew.h" // for the contour values
#include "vtkPolyDataAlgorithm.h"
#include "vtkScatteredIsopointFiltersModule.h" // for the export macro

#include <cstddef> // for std::size_t
#include <memory>  // for std::unique_ptr
#include <set>     // for isovalues
#include <string>  // for messages
#include <vector>  // for lists of blocks and surfaces

namespace isopoint
{
struct Execution;
struct ExtractedIsosurface;
class Team;
} // namespace isopoint
class vtkCompositeDataSet;
class vtkContourValues;
class vtkDataObject;
class vtkIsopointEndSamples;
class vtkIsopointStructure;
class vtkMultiProcessController;
struct vtkIsopointBlock;
struct vtkIsopointMessage;

class VTKSCATTEREDISOPOINTFILTERS_EXPORT vtkScatteredIsopointFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkScatteredIsopointFilter* New();
  vtkTypeMacro(vtkScatteredIsopointFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The isovalues, in units of the contoured array, as in vtkContourFilter. Repeated values count
   * once. An infinite value, or one outside the range of the array, gives no points; NaN is an
   * error. Default: one value, 0.
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
   * The angle of the angle criterion, in degrees: a neighbor of a sample is dropped if a closer
   * neighbor lies within this angle of its direction. An edge gives an isopoint if it remains at
   * either end. Smaller angles give more isopoints, at a slightly larger distance from the true
   * surface. At 0 no neighbor is dropped; at 180 only the nearest remain, and those exactly
   * opposite to closer ones. Range: 0 to 180; other values are an error in the next update.
   * Default: 54.7, just below the angle between an edge and a diagonal of a cube (54.7356), so that
   * diagonals of lattices remain.
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
   * Whether and how isopoints are moved from their edges to the zero of a polynomial, fitted by
   * weighted least squares to the samples around:
   * - NO_PROJECTION: isopoints stay where linear interpolation on the edge puts them.
   * - LINEAR_FIT: an affine function. It smooths noise, but also flattens curved surfaces.
   * - QUADRATIC_FIT: degree two.
   * - CUBIC_FIT: degree two where that describes the nearest samples almost exactly, else degree
   *   three, or two where no cubic holds.
   * - CREASE_FIT: as CUBIC_FIT; where the field is not smooth, the maximum or minimum of two to
   * four polynomials of degree one or two, if these describe the samples far better. For bodies
   * with sharp edges; in fields without creases it takes longer and may detect false ones.
   *
   * Except with LINEAR_FIT, samples that lie far off what the others indicate, such as those beyond
   * a step, count less, and an isopoint moves by less than the whole way where the standard error
   * of the zero, as residuals of samples left out indicate it, is not small beside that way. So
   * fits are not worse on average than linear interpolation in noise and at steps. No isopoint is
   * moved by more than half the length of its edge. Where the samples determine no polynomial,
   * where it has no zero close by or contradicts the edge, and in noise so strong that not even the
   * direction of the gradient is known, isopoints stay and are counted (see
   * GetNumberOfUnprojectedPoints()).
   *
   * A fit depends on nothing but the samples in the regions that touch those of the edge's ends,
   * and in regions that touch these: changes farther away, with the tree around as it was, change
   * nothing. Values outside the enumeration are clamped. Default: CUBIC_FIT.
   */
  vtkSetClampMacro(Projection, int, NO_PROJECTION, CREASE_FIT);
  vtkGetMacro(Projection, int);
  ///@}

  enum NormalMethods
  {
    AUTOMATIC_NORMALS = -1,
    NORMALS_FROM_FIELD = 0,
    NORMALS_FROM_PLANES = 1
  };

  ///@{
  /**
   * The source of the normals:
   * - AUTOMATIC_NORMALS: NORMALS_FROM_FIELD where fits are made for other reasons as well, that is
   *   with any Projection but NO_PROJECTION, with ComputeGradients or with a MinimumSpacing;
   *   NORMALS_FROM_PLANES otherwise, which takes less time.
   * - NORMALS_FROM_FIELD: the gradient of the fit that Projection selects (of CUBIC_FIT with
   *   NO_PROJECTION), or that of a simpler polynomial through the samples where both agree within
   * the error of the former: of an affine function, as in noise, or of degree two. Where no fit
   * holds, it is that of an affine function. Where the samples determine no affine function either,
   * or its gradient contradicts the edge, NORMALS_FROM_PLANES.
   * - NORMALS_FROM_PLANES: the least-squares plane through the nearest isopoints, as in [RL06] (see
   *   SetNumberOfNeighbors()).
   *
   * Values outside the enumeration are clamped. Default: AUTOMATIC_NORMALS.
   */
  vtkSetClampMacro(NormalMethod, int, AUTOMATIC_NORMALS, NORMALS_FROM_PLANES);
  vtkGetMacro(NormalMethod, int);
  ///@}

  ///@{
  /**
   * Whether to compute the array "Gradients" (three floats): the gradient of the contoured array at
   * the isopoint, in units of the array per unit of the coordinates. It is that of the fit or of a
   * simpler polynomial, as for NORMALS_FROM_FIELD; where there is neither, it is the slope along
   * the isopoint's edge. Default: off.
   */
  vtkSetMacro(ComputeGradients, vtkTypeBool);
  vtkGetMacro(ComputeGradients, vtkTypeBool);
  vtkBooleanMacro(ComputeGradients, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether to compute the array "ProjectionOrder" (one unsigned char), the kind of fit that moved
   * the isopoint: 0 none, 1 affine, 2 quadratic, 3 cubic, 4 polynomials that meet at a crease.
   * Default: off.
   */
  vtkSetMacro(ComputeProjectionOrders, vtkTypeBool);
  vtkGetMacro(ComputeProjectionOrders, vtkTypeBool);
  vtkBooleanMacro(ComputeProjectionOrders, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the surface ends where the spacing of the samples jumps, as at voids, at the free
   * surface of a fluid, or between groups of boreholes. Dropped are the isopoints on edges longer
   * than twice the spacing of the samples behind both ends, if these edges are connected, through
   * others like them, with one that is longer than four times that. The spacing behind the end x of
   * an edge {x, y} is the distance from x to the second nearest sample position (the third nearest
   * for the factor of four) within 54.7356 degrees (whose cosine is 1 / sqrt(3)) of the direction
   * from y to x; it is infinite if there are fewer. Edges with an end in common are connected. So
   * edges between a dense and a sparse region, to an isolated sample, and between lines or slices
   * of samples remain, and closed surfaces amid samples stay closed. For triangles see
   * vtkScatteredIsosurfaceFilter. Default: on.
   */
  vtkSetMacro(DropGaps, vtkTypeBool);
  vtkGetMacro(DropGaps, vtkTypeBool);
  vtkBooleanMacro(DropGaps, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The minimum spacing of isopoints on one sheet of the surface, in units of the sample spacing.
   * Fewer isopoints with larger splats then cover the surface. Isopoints are taken in the order of
   * the output, and one is dropped if it is close to one that was kept. Let r be MinimumSpacing
   * times the smaller of the sample spacings around two isopoints; these are close if
   * - around both a fit describes a smooth surface (see SetProjection(); that of CUBIC_FIT with
   *   NO_PROJECTION): one of degree two or more, whose gradient differs beyond doubt from that of
   * an affine function,
   * - their distance is less than r,
   * - each lies within r / 4 of the tangent plane of the other, and
   * - the gradients of their fits differ by less than 25 degrees (their cosine is 0.906 or more).
   *
   * The sample spacing around an isopoint is the mean, over the ends of its edge, of the distance
   * within which two fifths of the neighbors lie. Thus neither sheets close to each other nor the
   * two sides of a crease thin each other out, the surface stays dense where it is strongly curved,
   * and nothing is dropped where no fit holds, in noise, or with LINEAR_FIT.
   *
   * 0.5 is a sensible value: it keeps about half of the isopoints and opened no holes in smooth
   * surfaces in tests; larger values open some. About 70 percent remain at 0.25, 20 percent at 1.
   * The surface may end earlier at its border, by up to the minimum spacing. 0 drops nothing.
   * Range: 0 to 1; other values are clamped, and NaN is an error in the next update. Default: 0.
   */
  vtkSetClampMacro(MinimumSpacing, double, 0.0, 1.0);
  vtkGetMacro(MinimumSpacing, double);
  ///@}

  ///@{
  /**
   * Whether to compute the array "Normals" (three floats, the active normals): unit vectors that
   * point to decreasing values, as those of vtkContourFilter do. See SetNormalMethod(). Default:
   * on.
   */
  vtkSetMacro(ComputeNormals, vtkTypeBool);
  vtkGetMacro(ComputeNormals, vtkTypeBool);
  vtkBooleanMacro(ComputeNormals, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether to compute splats, which cover the surface: the splat of an isopoint is the fan of
   * triangles between it and each two consecutive corners of the part of the surface that is nearer
   * to it than to others. Splats bend as the surface does, end where it ends or has a crease, and
   * share most corners with their neighbors. Default: on.
   *
   * - "Radius" (one float, positive, in units of the coordinates) is the distance of the farthest
   *   corner, the size of a disk for mappers that draw such.
   * - "SplatAxis" (three floats, in units of the coordinates) is a tangential vector t1 as long as
   *   the radius; t2 is normal x t1.
   * - "SplatPolygon" (40 floats, five for each of eight corners, counterclockwise seen from the tip
   *   of the normal N): a, b, h, u, v, so that the corner is at a t1 + b t2 + h Radius N from the
   *   isopoint and has the normal N + (u t1 + v t2) / Radius, not of length 1. Further corners
   *   repeat the last one. All are 0 at an isopoint at whose position there is an earlier one.
   */
  vtkSetMacro(ComputeSplats, vtkTypeBool);
  vtkGetMacro(ComputeSplats, vtkTypeBool);
  vtkBooleanMacro(ComputeSplats, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the output has the contoured array, whose values are the isovalues, as its active
   * scalars. Default: on.
   */
  vtkSetMacro(ComputeScalars, vtkTypeBool);
  vtkGetMacro(ComputeScalars, vtkTypeBool);
  vtkBooleanMacro(ComputeScalars, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The number of nearest isopoints to which the plane is fitted that gives a normal
   * (NORMALS_FROM_PLANES, and where the samples yield no gradient): the nearest within two rings of
   * touching cells. More give smoother normals and rounder
   * edges. Range: 3 to 1000; other values are clamped. Default: 12.
   */
  vtkSetClampMacro(NumberOfNeighbors, int, 3, 1000);
  vtkGetMacro(NumberOfNeighbors, int);
  ///@}

  ///@{
  /**
   * The type of the output's points: vtkAlgorithm::SINGLE_PRECISION, DOUBLE_PRECISION, or
   * DEFAULT_PRECISION, which is single if the points of all blocks are float, else double (as for
   * images, rectilinear grids and hyper tree grids). All computation is in double precision. Other
   * values are clamped. Default: DEFAULT_PRECISION.
   */
  vtkSetClampMacro(OutputPointsPrecision, int, SINGLE_PRECISION, DEFAULT_PRECISION);
  vtkGetMacro(OutputPointsPrecision, int);
  ///@}

  ///@{
  /**
   * Whether to keep the tree from one update to the next, which makes further isovalues much
   * faster, or to free it at the end of each update. The output is the same. Default: on.
   */
  vtkSetMacro(KeepTree, vtkTypeBool);
  vtkGetMacro(KeepTree, vtkTypeBool);
  vtkBooleanMacro(KeepTree, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether to contour each block of a composite input separately. If on, the output is a composite
   * of the same structure, with a vtkPolyData for each block that has the contoured array (for an
   * AMR, a vtkMultiBlockDataSet of levels); use GetOutputDataObject(0). If off, all blocks form one
   * cloud, and the output is one vtkPolyData. Without effect on other inputs. On several ranks a
   * block is what all of them have at its place in the tree of blocks, which has to be the same on
   * all; blocks may be null on some of them, as may a whole composite be empty. Default: off.
   */
  vtkSetMacro(ContourBlocks, vtkTypeBool);
  vtkGetMacro(ContourBlocks, vtkTypeBool);
  vtkBooleanMacro(ContourBlocks, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The processes (ranks) whose inputs form one cloud, those of one rank after those of the other.
   * The outputs of all ranks are then, as a set of points with all their arrays, what one process
   * yields for that cloud, bit for bit, however the cloud is dealt out; each point is in the output
   * of one rank. All ranks have to update the filter, with the same options. A rank may have no
   * samples. If ghost levels are requested of the output, however many, the points within five
   * rings of neighbors around those of a rank follow behind these, with all their arrays, marked in
   * "vtkGhostType" as DUPLICATEPOINT and their vertices as DUPLICATECELL. Null, or a controller of
   * one process: the filter runs on its own. Default: the global controller when the filter is
   * created (that of MPI in ParaView's servers and in pvbatch).
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() const;
  ///@}

  ///@{
  /**
   * Whether to run on all cores if vtkSMPTools was merely built with "Sequential" as its default
   * backend, as in Debian's ParaView. This is assumed if "Sequential" is the active backend and the
   * environment variable VTK_SMP_BACKEND_IN_USE is not set. The number of threads then stays within
   * VTK_SMP_MAX_THREADS and the argument of vtkSMPTools::Initialize(). If off, or with any other
   * backend, vtkSMPTools determines the threads. The output is the same. Default: on.
   */
  vtkSetMacro(UseAllCores, vtkTypeBool);
  vtkGetMacro(UseAllCores, vtkTypeBool);
  vtkBooleanMacro(UseAllCores, vtkTypeBool);
  ///@}

  /**
   * The number of input points (or cells, or leaves) of the last update, skipped ones included.
   */
  vtkGetMacro(NumberOfSamples, vtkIdType);

  /**
   * The number of points that the last update extracted, those of all ranks, without ghosts.
   */
  vtkGetMacro(NumberOfExtractedPoints, vtkIdType);

  /**
   * The number of input points (or cells, or leaves) that took no part in the last update: see
   * guarantee 3.
   */
  vtkGetMacro(NumberOfSkippedSamples, vtkIdType);

  /**
   * The number of points in the output of the last update that no fit moved: all of them with
   * NO_PROJECTION, otherwise those around which no fit holds. In noise most points move, if only by
   * a little.
   */
  vtkGetMacro(NumberOfUnprojectedPoints, vtkIdType);

  /**
   * The number of edges across isosurfaces that the last update left out since they lie in gaps; of
   * triangles, of tetrahedra. See SetDropGaps().
   */
  vtkGetMacro(NumberOfDroppedInGaps, vtkIdType);

  /**
   * The modification time, including that of the contour values.
   */
  vtkMTimeType GetMTime() override;

  /**
   * Whether the points are connected by triangles, as a subclass does; false here.
   */
  virtual bool ExtractsTriangles() const { return false; }

protected:
  vtkScatteredIsopointFilter();
  ~vtkScatteredIsopointFilter() override;

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  vtkNew<vtkContourValues> ContourValues;
  double Angle;
  double MinimumSpacing = 0.0;
  int Projection = CUBIC_FIT;
  int NormalMethod = AUTOMATIC_NORMALS;
  vtkTypeBool DropGaps = 1;
  vtkTypeBool ComputeGradients = 0;
  vtkTypeBool ComputeProjectionOrders = 0;
  vtkTypeBool ComputeNormals = 1;
  vtkTypeBool ComputeSplats = 1;
  vtkTypeBool ComputeScalars = 1;
  int NumberOfNeighbors;
  int OutputPointsPrecision = DEFAULT_PRECISION;
  vtkTypeBool KeepTree = 1;
  vtkTypeBool ContourBlocks = 0;
  vtkTypeBool UseAllCores = 1;
  vtkIdType NumberOfSamples = 0;
  vtkIdType NumberOfExtractedPoints = 0;
  vtkIdType NumberOfSkippedSamples = 0;
  vtkIdType NumberOfUnprojectedPoints = 0;
  vtkIdType NumberOfDroppedInGaps = 0;

private:
  vtkScatteredIsopointFilter(const vtkScatteredIsopointFilter&) = delete;
  void operator=(const vtkScatteredIsopointFilter&) = delete;

  class Internals;
  class KeptTree;

  void ExtractSafely(vtkDataObject* input, vtkDataObject* output);
  void ExtractInput(vtkDataObject* input, vtkDataObject* output);
  /// Each leaf of a composite input separately.
  void ExtractLeaves(vtkDataObject* input, vtkCompositeDataSet* output);
  /// The same on one of several ranks, which all call it. @throws on all of them, if on any
  void ExtractOnRanks(vtkDataObject* input, vtkDataObject* output);
  void CollectOnRanks(
    isopoint::Team& team, const isopoint::Execution& execution, vtkDataObject* input);
  /// Each leaf of all ranks' inputs together, separately.
  void ExtractLeavesOnRanks(isopoint::Team& team, const isopoint::Execution& execution,
    const vtkIsopointStructure& structure, vtkDataObject* input, vtkDataObject* output);
  /// The cloud of some blocks of each rank, perhaps none, with the kept tree of this number.
  void ExtractBlocksOnRanks(isopoint::Team& team, const isopoint::Execution& execution,
    std::size_t begin, std::size_t end, std::size_t tree, vtkPolyData* output);
  /// Of an update whose blocks have been collected.
  void StartCounting();
  void CountSkippedSamples(const std::vector<vtkIsopointBlock>& blocks, std::size_t skipped);
  void ReportProblem(const std::string& problem);
  /// Warns of what the update found out about samples and points, on the first rank alone.
  void ClearCounts();
  void ReportFindings();
  void ReportMessages(const std::vector<vtkIsopointMessage>& messages);
  void ConnectRanks();
  std::set<double> GetIsovalues();
  /// The progress after loading this many samples, and after each isovalue.
  std::vector<double> ExpectProgress(std::size_t count, bool isTreeKept);
  void ExtractBlocks(std::size_t begin, std::size_t end, KeptTree& kept, vtkPolyData* output);
  /// One surface for each isovalue, then, if there are any, its ghosts for each.
  std::vector<isopoint::ExtractedIsosurface> ExtractIsovalues(
    const isopoint::Execution& execution, KeptTree& kept, const std::vector<double>& progress);
  void FillOutput(const isopoint::Execution& execution, const vtkIsopointEndSamples& samples,
    const std::vector<isopoint::ExtractedIsosurface>& surfaces, bool haveFloatPositions,
    vtkPolyData* output);

  std::unique_ptr<Internals> Kept;
};

#endif
