// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkScatteredContourFilter
 * @brief   base class of the filters that extract isosurfaces from scattered samples
 *
 * vtkScatteredIsopointFilter extracts points, vtkScatteredIsosurfaceFilter triangles. Their
 * documentation describes inputs, samples and guarantees; this class has the common properties.
 * If the filter has a controller (see SetController()), the outputs of all ranks together, as a set
 * of points with all their arrays, equal the output of one process for the samples of all ranks,
 * bit for bit, for any distribution of them. Each point is in the output of one rank. If ghost
 * levels of the output are requested, regardless of how many, the points within 24 rings of
 * neighbors around a rank's points (five without splats) follow these, with all their arrays,
 * marked in "vtkGhostType" as DUPLICATEPOINT and their vertices as DUPLICATECELL.
 *
 * If a piece of the output is requested (UpdatePiece(), or a writer of pieces), the filter requests
 * its whole input and extracts the whole surface. The piece is a share of the points, or of the
 * triangles with their points, in the order of the output, without ghosts. All pieces together are
 * the surface, and counts refer to all of them. Several processes without a controller (see
 * SetController()) get pieces of one surface only if each reads the whole input. If their samples
 * differ, each gets a piece of the surface of its own samples, and the first one gives a warning:
 * set a controller, or update without pieces.
 *
 * @sa
 * vtkScatteredIsopointFilter vtkScatteredIsosurfaceFilter
 */

#ifndef vtkScatteredContourFilter_h
#define vtkScatteredContourFilter_h

#include "vtkScatteredIsopointFiltersModule.h" // for the export macro
#include "vtkScatteredSurfaceFilter.h"

#include <memory> // for std::unique_ptr

class vtkIsopointContouring;

class VTKSCATTEREDISOPOINTFILTERS_EXPORT vtkScatteredContourFilter
  : public vtkScatteredSurfaceFilter
{
public:
  vtkTypeMacro(vtkScatteredContourFilter, vtkScatteredSurfaceFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The isovalues, in units of the contoured array, as in vtkContourFilter. Repeated values count
   * once. Values that are infinite or out of range give no points; NaN is an error. Default: one
   * value, 0.
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
   * Whether and how isopoints move from their edges to the zero of a polynomial, which is fitted by
   * weighted least squares to the samples around:
   * - NO_PROJECTION: isopoints stay where linear interpolation on the edge puts them.
   * - LINEAR_FIT: an affine function. It smooths noise, but also flattens curved surfaces.
   * - QUADRATIC_FIT: degree two.
   * - CUBIC_FIT: degree two if that describes the nearest samples almost exactly, otherwise degree
   *   three, or two where no cubic holds.
   * - CREASE_FIT: as CUBIC_FIT or, where the field is not smooth, the maximum or minimum of two to
   *   four polynomials of degree one or two, if these describe the samples far better. For bodies
   *   with sharp edges; it is slower and may detect false creases in other fields.
   *
   * Except with LINEAR_FIT, outliers such as samples beyond a step have less weight, and an
   * isopoint moves only part of the way if the standard error of the zero, estimated from residuals
   * of samples left out, is not small compared with the move. On average, fits are therefore no
   * worse than linear interpolation in noise and at steps. No isopoint moves by more than half the
   * length of its edge. Isopoints stay, and are counted (see GetNumberOfUnprojectedPoints()), if
   * the samples determine no polynomial, if its zero is not close or contradicts the edge, or if
   * noise hides even the direction of the gradient.
   *
   * A fit depends only on the samples in the regions that touch those of the edge's ends, and in
   * regions that touch these. Changes farther away have no effect unless they change the tree here.
   * Values outside the enumeration are clamped. Default: CUBIC_FIT.
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
   * - AUTOMATIC_NORMALS: NORMALS_FROM_FIELD if fits are made anyway, for a Projection other than
   *   NO_PROJECTION or for ComputeGradients; otherwise the faster NORMALS_FROM_PLANES.
   * - NORMALS_FROM_FIELD: the gradient of the fit that Projection selects (CUBIC_FIT for
   *   NO_PROJECTION), or of a simpler polynomial through the samples if both agree within the error
   *   of the former: an affine function, as in noise, or one of degree two. Without a fit, the
   *   gradient of an affine function. If the samples do not determine one, or its gradient
   *   contradicts the edge, NORMALS_FROM_PLANES.
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
   * the isopoint, in units of the array per unit of the coordinates. It is that of the fit or a
   * simpler polynomial, as for NORMALS_FROM_FIELD, or the slope along the isopoint's edge. Default:
   * off.
   */
  virtual void SetComputeGradients(vtkTypeBool compute);
  virtual vtkTypeBool GetComputeGradients();
  vtkBooleanMacro(ComputeGradients, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether to compute the array "ProjectionOrder" (one unsigned char), the fit that moved the
   * isopoint: 0 none, 1 affine, 2 quadratic, 3 cubic, 4 polynomials that meet at a crease. Default:
   * off.
   */
  virtual void SetComputeProjectionOrders(vtkTypeBool compute);
  virtual vtkTypeBool GetComputeProjectionOrders();
  vtkBooleanMacro(ComputeProjectionOrders, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether to compute the array "Normals" (three floats, the active normals): unit vectors towards
   * decreasing values, as in vtkContourFilter. See SetNormalMethod(). Default: on.
   */
  virtual void SetComputeNormals(vtkTypeBool compute);
  virtual vtkTypeBool GetComputeNormals();
  vtkBooleanMacro(ComputeNormals, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the output has the contoured array, filled with isovalues, as active scalars. Default:
   * on.
   */
  virtual void SetComputeScalars(vtkTypeBool compute);
  virtual vtkTypeBool GetComputeScalars();
  vtkBooleanMacro(ComputeScalars, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether to contour each block of a composite input separately. If on, the output is a composite
   * of the same structure with a vtkPolyData for each block that has the contoured array (for an
   * AMR, a vtkMultiBlockDataSet of levels); use GetOutputDataObject(0). If off, all blocks form one
   * cloud, and the output is one vtkPolyData. No effect on other inputs. In a process group, a
   * block is the data of all ranks at its place in the tree of blocks, which must be the same on
   * all ranks; blocks may be null on some ranks, or the whole composite empty. Default: off.
   */
  virtual void SetContourBlocks(vtkTypeBool separately);
  virtual vtkTypeBool GetContourBlocks();
  vtkBooleanMacro(ContourBlocks, vtkTypeBool);
  ///@}

  /**
   * The number of points in the last output that no fit moved: with NO_PROJECTION all, otherwise
   * those without a fit. In noise most points move, if only by a little.
   */
  vtkIdType GetNumberOfUnprojectedPoints() const;

  /**
   * The number of crossing edges (for triangles, crossing tetrahedra) that the last update dropped
   * because they lie in gaps. See SetDropGaps().
   */
  vtkIdType GetNumberOfDroppedInGaps() const;

protected:
  vtkScatteredContourFilter();
  ~vtkScatteredContourFilter() override;

  vtkSmartPointer<vtkDataObject> NewOutput(vtkInformationVector** inputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  const isopoint::Report& GetReport() const override;

private:
  vtkScatteredContourFilter(const vtkScatteredContourFilter&) = delete;
  void operator=(const vtkScatteredContourFilter&) = delete;

  std::unique_ptr<vtkIsopointContouring> Contouring;
};

#endif
