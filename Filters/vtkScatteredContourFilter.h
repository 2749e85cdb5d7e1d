// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkScatteredContourFilter
 * @brief   what the filters that extract isosurfaces from scattered samples have in common
 *
 * vtkScatteredIsopointFilter extracts points, vtkScatteredIsosurfaceFilter triangles. Their inputs
 * and samples, and the guarantees that both give, are described there; the properties that both
 * have are here.
 *
 * An update that fails reports one error and leaves the output empty. Update() returns 1 all the
 * same. GetErrorCode() tells programs what failed, on all ranks: EINVAL for invalid input or
 * options, ENOMEM for a lack of memory, vtkErrorCode::UnknownError for a bug. It is 0 after an
 * update that succeeded, and after an abort, which leaves the output empty as well. It stays as it
 * is where the filter does not run, as without an input. The pipeline takes the empty output for
 * the result: call Modified() to try again.
 *
 * If a piece of the output is requested (UpdatePiece(), or a writer of pieces), the filter asks for
 * its whole input and extracts the whole surface. The piece is its share of the points, or of the
 * triangles with their points, in the order of the output, without ghosts. All pieces together are
 * the surface. Counts are those of all pieces. Several processes without a controller (see
 * SetController()) get the pieces of one surface if each of them reads the whole input. If they
 * have different samples, each gets only a piece of the surface of its own samples, and the first
 * one a warning: give them a controller, or update without pieces.
 *
 * @sa
 * vtkScatteredIsopointFilter vtkScatteredIsosurfaceFilter
 */

#ifndef vtkScatteredContourFilter_h
#define vtkScatteredContourFilter_h

#include "vtkContourValues.h" // for inline methods
#include "vtkNew.h"           // for the contour values
#include "vtkPolyDataAlgorithm.h"
#include "vtkScatteredIsopointFiltersModule.h" // for the export macro

#include <memory> // for std::unique_ptr

class vtkIsopointUpdate;
class vtkMultiProcessController;
struct vtkIsopointOptions;

class VTKSCATTEREDISOPOINTFILTERS_EXPORT vtkScatteredContourFilter : public vtkPolyDataAlgorithm
{
public:
  vtkTypeMacro(vtkScatteredContourFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The isovalues, in units of the contoured array, as in vtkContourFilter. Repeated values count
   * once. An infinite value, or one outside the range of the array, gives no points; NaN is an
   * error. Default: one value, 0.
   */
  void SetValue(int i, double value) { this->ContourValues->SetValue(i, value); }
  double GetValue(int i) { return this->ContourValues->GetValue(i); }
  double* GetValues() { return this->ContourValues->GetValues(); }
  void GetValues(double* contourValues) { this->ContourValues->GetValues(contourValues); }
  void SetNumberOfContours(int number) { this->ContourValues->SetNumberOfContours(number); }
  vtkIdType GetNumberOfContours() { return this->ContourValues->GetNumberOfContours(); }
  void GenerateValues(int numContours, double range[2])
  {
    this->ContourValues->GenerateValues(numContours, range);
  }
  void GenerateValues(int numContours, double rangeStart, double rangeEnd)
  {
    this->ContourValues->GenerateValues(numContours, rangeStart, rangeEnd);
  }
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
  virtual void SetProjection(int method);
  virtual int GetProjection();
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
  virtual void SetNormalMethod(int method);
  virtual int GetNormalMethod();
  ///@}

  ///@{
  /**
   * Whether to compute the array "Gradients" (three floats): the gradient of the contoured array at
   * the isopoint, in units of the array per unit of the coordinates. It is that of the fit or of a
   * simpler polynomial, as for NORMALS_FROM_FIELD; where there is neither, it is the slope along
   * the isopoint's edge. Default: off.
   */
  virtual void SetComputeGradients(vtkTypeBool compute);
  virtual vtkTypeBool GetComputeGradients();
  vtkBooleanMacro(ComputeGradients, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether to compute the array "ProjectionOrder" (one unsigned char), the kind of fit that moved
   * the isopoint: 0 none, 1 affine, 2 quadratic, 3 cubic, 4 polynomials that meet at a crease.
   * Default: off.
   */
  virtual void SetComputeProjectionOrders(vtkTypeBool compute);
  virtual vtkTypeBool GetComputeProjectionOrders();
  vtkBooleanMacro(ComputeProjectionOrders, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the surface ends where the spacing of the samples jumps, as at voids or at the free
   * surface of a fluid. Dropped are the isopoints on edges longer than twice the spacing of the
   * samples behind both ends, if these edges are connected, through others like them, with one that
   * is longer than four times that. The spacing behind the end x of an edge {x, y} is the distance
   * from x to the second nearest sample position (the third nearest for the factor of four) within
   * 54.7356 degrees (whose cosine is 1 / sqrt(3)) of the direction from y to x; it is infinite if
   * there are fewer. Edges with an end in common are connected. So edges between a dense and a
   * sparse region, to an isolated sample, and between lines or slices of samples remain, and closed
   * surfaces amid samples stay closed. For triangles see vtkScatteredIsosurfaceFilter. Default: on.
   */
  virtual void SetDropGaps(vtkTypeBool drop);
  virtual vtkTypeBool GetDropGaps();
  vtkBooleanMacro(DropGaps, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether to compute the array "Normals" (three floats, the active normals): unit vectors that
   * point to decreasing values, as those of vtkContourFilter do. See SetNormalMethod(). Default:
   * on.
   */
  virtual void SetComputeNormals(vtkTypeBool compute);
  virtual vtkTypeBool GetComputeNormals();
  vtkBooleanMacro(ComputeNormals, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the output has the contoured array, whose values are the isovalues, as its active
   * scalars. Default: on.
   */
  virtual void SetComputeScalars(vtkTypeBool compute);
  virtual vtkTypeBool GetComputeScalars();
  vtkBooleanMacro(ComputeScalars, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The type of the output's points: vtkAlgorithm::SINGLE_PRECISION, DOUBLE_PRECISION, or
   * DEFAULT_PRECISION, which is single if the points of all blocks are float, else double (as for
   * images, rectilinear grids and hyper tree grids). All computation is in double precision. Other
   * values are clamped. Default: DEFAULT_PRECISION.
   */
  virtual void SetOutputPointsPrecision(int precision);
  virtual int GetOutputPointsPrecision();
  ///@}

  ///@{
  /**
   * Whether to keep the tree from one update to the next, which makes further isovalues much
   * faster, or to free it at the end of each update. The output is the same. Default: on.
   */
  virtual void SetKeepTree(vtkTypeBool keep);
  virtual vtkTypeBool GetKeepTree();
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
  virtual void SetContourBlocks(vtkTypeBool separately);
  virtual vtkTypeBool GetContourBlocks();
  vtkBooleanMacro(ContourBlocks, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The processes (ranks) whose inputs form one cloud, in the order of the ranks.
   * The outputs of all ranks are then, as a set of points with all their arrays, what one process
   * yields for that cloud, bit for bit, however the cloud is dealt out; each point is in the output
   * of one rank. All ranks have to update the filter, with the same options. A rank may have no
   * samples. If ghost levels are requested of the output, however many, the points within 24
   * rings of neighbors around those of a rank (five without splats) follow behind these, with all
   * their arrays, marked in "vtkGhostType" as DUPLICATEPOINT and their vertices as DUPLICATECELL.
   * Null, or a controller of one process: the filter runs on its own. Default: null. In
   * ParaView filters have the global controller.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() const;
  ///@}

  /**
   * Calls SetController() with the global controller, or with null. For callers that cannot pass an
   * object, such as ParaView's proxies.
   */
  void SetUseGlobalController(bool use);

  ///@{
  /**
   * Whether to run on all cores if vtkSMPTools was merely built with "Sequential" as its default
   * backend, as in Debian's ParaView. This is assumed if "Sequential" is the active backend and the
   * environment variable VTK_SMP_BACKEND_IN_USE is not set. The number of threads then stays within
   * VTK_SMP_MAX_THREADS and the argument of vtkSMPTools::Initialize(). If off, with any other
   * backend, or if built without oneTBB, vtkSMPTools determines the threads. The output is the
   * same. Default: on.
   */
  virtual void SetUseAllCores(vtkTypeBool use);
  virtual vtkTypeBool GetUseAllCores();
  vtkBooleanMacro(UseAllCores, vtkTypeBool);
  ///@}

  /**
   * The number of input points (or cells, or leaves) of the last update, skipped ones included.
   */
  vtkIdType GetNumberOfSamples() const;

  /**
   * The number of points that the last update extracted, those of all ranks, without ghosts.
   */
  vtkIdType GetNumberOfExtractedPoints() const;

  /**
   * The number of input points (or cells, or leaves) that took no part in the last update: see
   * guarantee 3.
   */
  vtkIdType GetNumberOfSkippedSamples() const;

  /**
   * The number of points in the output of the last update that no fit moved: all of them with
   * NO_PROJECTION, otherwise those around which no fit holds. In noise most points move, if only by
   * a little.
   */
  vtkIdType GetNumberOfUnprojectedPoints() const;

  /**
   * The number of edges across isosurfaces that the last update left out since they lie in gaps; of
   * triangles, of tetrahedra. See SetDropGaps().
   */
  vtkIdType GetNumberOfDroppedInGaps() const;

  /**
   * The modification time, including that of the contour values.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkScatteredContourFilter();
  ~vtkScatteredContourFilter() override;

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  vtkNew<vtkContourValues> ContourValues;
  const std::unique_ptr<vtkIsopointOptions> Options; // the values of all properties

private:
  vtkScatteredContourFilter(const vtkScatteredContourFilter&) = delete;
  void operator=(const vtkScatteredContourFilter&) = delete;

  std::unique_ptr<vtkIsopointUpdate> LastUpdate;
};

#endif
