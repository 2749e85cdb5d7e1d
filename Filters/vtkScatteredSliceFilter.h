// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkScatteredSliceFilter
 * @brief   slice scattered samples by an implicit function
 *
 * vtkScatteredSliceFilter generates triangles where an implicit function has given values, with all
 * arrays of the samples, straight from scattered samples: vtkCutter for data without cells. The
 * slice is the isosurface of the function's values at the samples in their Delaunay
 * tetrahedralization, as vtkScatteredIsosurfaceFilter extracts it, and ends where the samples end.
 * Samples on the slice count as above it: without samples below, such as on the first layer of a
 * lattice, it is empty.
 * docs/triangles.md in the source distribution defines it, and where it ends with DropGapsOn():
 * a full convex body keeps its whole section.
 *
 * Samples are the points of the input, the centers of its cells if it has arrays of cells only, or
 * the leaves of hyper tree grids, of all blocks. Which are skipped, and the guarantees on threads,
 * ranks, order and the kept tree, are those of vtkScatteredIsosurfaceFilter.
 *
 * Points on planes are exact, up to rounding. With another function, including a vtkPlane with a
 * transform, they move onto it along the way to the sample at the end of their edge on its other
 * side. Triangles face against the function's gradient.
 *
 * Integers are rounded, and stay within the range of their samples. Ids and strings are those of
 * the nearest sample. Left out are, with a message, arrays that not all blocks have. A function
 * that is not finite at a sample with a finite position is an error.
 *
 * Moving a plane along its normal keeps the tree and all values. Other changes of the function keep
 * the tree.
 *
 * @sa
 * vtkScatteredIsosurfaceFilter vtkScatteredProbeFilter vtkCutter
 */

#ifndef vtkScatteredSliceFilter_h
#define vtkScatteredSliceFilter_h

#include "vtkScatteredIsopointFiltersModule.h" // for the export macro
#include "vtkScatteredSurfaceFilter.h"
#include "vtkSmartPointer.h" // for the function

#include <memory> // for std::unique_ptr
#include <string> // for names of arrays
#include <vector>

class vtkImplicitFunction;
class vtkIsopointSlicing;

class VTKSCATTEREDISOPOINTFILTERS_EXPORT vtkScatteredSliceFilter : public vtkScatteredSurfaceFilter
{
public:
  static vtkScatteredSliceFilter* New();
  vtkTypeMacro(vtkScatteredSliceFilter, vtkScatteredSurfaceFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The function. Without one, updates fail. Default: null.
   */
  virtual void SetCutFunction(vtkImplicitFunction* function);
  vtkImplicitFunction* GetCutFunction();
  ///@}

  ///@{
  /**
   * The values of the function on slices, as in vtkCutter: for a vtkPlane distances along its
   * normal. Repeated values count once. Default: one value, 0.
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

  enum InterpolationMethods
  {
    FITS = 0,
    LINEAR = 1,
    NEAREST = 2
  };

  ///@{
  /**
   * Where the arrays of points come from. They keep their types:
   * - FITS: local polynomial fits, as in vtkScatteredProbeFilter with BLEND; at rims they
   *   extrapolate. Where no sample has a finite value, LINEAR.
   * - LINEAR: linear interpolation along the edges of the tetrahedralization. At rims, edges of
   *   slivers on the convex hull may be far too long for that.
   * - NEAREST: the value of the nearest sample, as for numbers of materials.
   *
   * Values outside the enumeration are clamped. Default: FITS.
   */
  vtkSetClampMacro(Interpolation, int, FITS, NEAREST);
  vtkGetMacro(Interpolation, int);
  ///@}

  ///@{
  /**
   * The names of arrays whose values are those of the nearest sample by any method, in their type:
   * numbers of materials and the like. Global ids, pedigree ids, process ids, arrays of type
   * vtkIdType and strings are such arrays in any case. Default: none.
   */
  void AddNearestArray(const char* name);
  void ClearNearestArrays();
  int GetNumberOfNearestArrays();
  const char* GetNearestArray(int i);
  ///@}

  ///@{
  /**
   * Whether to merge points and flip edges, so that triangles are well shaped; see
   * vtkScatteredIsosurfaceFilter. Default: on.
   */
  virtual void SetRegularize(vtkTypeBool regularize);
  virtual vtkTypeBool GetRegularize();
  vtkBooleanMacro(Regularize, vtkTypeBool);
  ///@}

  /**
   * The modification time, including those of the function and of its values.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkScatteredSliceFilter();
  ~vtkScatteredSliceFilter() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  vtkSmartPointer<vtkImplicitFunction> CutFunction;
  int Interpolation = FITS;
  std::vector<std::string> NearestArrays;

private:
  vtkScatteredSliceFilter(const vtkScatteredSliceFilter&) = delete;
  void operator=(const vtkScatteredSliceFilter&) = delete;

  const isopoint::Report& GetReport() const override;

  const std::unique_ptr<vtkIsopointSlicing> Slicing;
};

#endif
