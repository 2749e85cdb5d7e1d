// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkScatteredSurfaceFilter
 * @brief   base class of the filters that make surfaces from scattered samples
 *
 * vtkScatteredContourFilter extracts isosurfaces, vtkScatteredSliceFilter slices,
 * vtkScatteredBodyFilter the surface of the body of all samples. This class has their common
 * properties.
 *
 * @sa
 * vtkScatteredContourFilter vtkScatteredSliceFilter vtkScatteredBodyFilter
 */

#ifndef vtkScatteredSurfaceFilter_h
#define vtkScatteredSurfaceFilter_h

#include "vtkContourValues.h" // for inline methods of subclasses
#include "vtkNew.h"           // for the contour values
#include "vtkScatteredAlgorithm.h"
#include "vtkScatteredIsopointFiltersModule.h" // for the export macro

#include <memory> // for std::unique_ptr

namespace isopoint
{
struct Report;
}
class vtkPolyData;
struct vtkIsopointOptions;

class VTKSCATTEREDISOPOINTFILTERS_EXPORT vtkScatteredSurfaceFilter : public vtkScatteredAlgorithm
{
public:
  vtkTypeMacro(vtkScatteredSurfaceFilter, vtkScatteredAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The surface; null if the output is a composite (see
   * vtkScatteredContourFilter::SetContourBlocks()).
   */
  vtkPolyData* GetOutput() { return this->GetOutput(0); }
  vtkPolyData* GetOutput(int port);
  ///@}

  ///@{
  /**
   * Whether the surface ends at gaps between samples, as at voids or at the free surface of a
   * fluid. The classes say which gaps. If off, triangles extend to the convex hull of the samples.
   * Default: on.
   */
  virtual void SetDropGaps(vtkTypeBool drop);
  virtual vtkTypeBool GetDropGaps();
  vtkBooleanMacro(DropGaps, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The type of the output's points: vtkAlgorithm::SINGLE_PRECISION, DOUBLE_PRECISION, or
   * DEFAULT_PRECISION, which is single if the points of all blocks are float, otherwise double (as
   * for images, rectilinear grids and hyper tree grids). Computations are always in double
   * precision. Other values are clamped. Default: DEFAULT_PRECISION.
   */
  virtual void SetOutputPointsPrecision(int precision);
  virtual int GetOutputPointsPrecision();
  ///@}

  /**
   * The number of points that the last update made on all ranks, without ghosts.
   */
  vtkIdType GetNumberOfExtractedPoints() const;

  /**
   * The modification time, including that of the contour values.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkScatteredSurfaceFilter();
  ~vtkScatteredSurfaceFilter() override;

  vtkSmartPointer<vtkDataObject> NewOutput(vtkInformationVector** inputVector) override;

  vtkNew<vtkContourValues> ContourValues;
  const std::unique_ptr<vtkIsopointOptions> Options; // the values of the properties

private:
  vtkScatteredSurfaceFilter(const vtkScatteredSurfaceFilter&) = delete;
  void operator=(const vtkScatteredSurfaceFilter&) = delete;

  /// Of the last update; empty if it failed.
  virtual const isopoint::Report& GetReport() const = 0;
  const isopoint::SampleCounts& GetSampleCounts() const override;
};

#endif
