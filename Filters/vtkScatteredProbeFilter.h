// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkScatteredProbeFilter
 * @brief   interpolate scattered samples at the points of any data set
 *
 * vtkScatteredProbeFilter adds to the points of input 0 (a vtkDataSet, or each of a composite) all
 * numeric arrays of the samples of input 1, the source, as vtkPointInterpolator does. No radius or
 * kernel is to be chosen: by default the values are means of local polynomial fits, weighted by
 * their estimated errors (docs/algorithm.md, section 13). Points outside of the samples are null
 * points (see SetNullPointsStrategy()).
 *
 * Samples are the points of the source, the centers of its cells if it has arrays of cells only,
 * or the leaves of hyper tree grids, of all blocks. Which are skipped, the guarantees on threads
 * and the kept tree are those of vtkScatteredIsopointFilter. An array gets its value from the
 * samples where its numbers are finite.
 *
 * The output has the type and the structure of input 0. Arrays of the samples replace those of
 * input 0 with the same name, and stay active attributes, except global and process ids. They are
 * double, and those of integers stay within the range of their samples. With NEAREST, and where
 * they are ids, strings or nearest arrays (see AddNearestArray()), they keep their types. Left out
 * are ghost marks and, with a message, arrays of other values than numbers and strings, arrays that
 * not all blocks have with as many components, and those with the name of an array of the filter
 * itself. If input 0 consists of pieces, the output does too: the source is always requested as a
 * whole. The time steps are those of the source or, if it has none, of input 0.
 *
 * In a process group (see SetController()) each rank has its own part of input 0, perhaps none, and
 * the sources of all ranks form one cloud.
 *
 * @sa
 * vtkScatteredGridFilter vtkScatteredLineFilter vtkScatteredGradientFilter vtkPointInterpolator
 * vtkProbeFilter
 */

#ifndef vtkScatteredProbeFilter_h
#define vtkScatteredProbeFilter_h

#include "vtkScatteredAlgorithm.h"
#include "vtkScatteredIsopointFiltersModule.h" // for the export macro

#include <memory> // for std::unique_ptr
#include <set>    // for names of arrays
#include <string> // for the name of an array
#include <vector> // for names of arrays

class vtkIsopointProbing;

class VTKSCATTEREDISOPOINTFILTERS_EXPORT vtkScatteredProbeFilter : public vtkScatteredAlgorithm
{
public:
  static vtkScatteredProbeFilter* New();
  vtkTypeMacro(vtkScatteredProbeFilter, vtkScatteredAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The samples: a data object, or the output of a filter.
   */
  void SetSourceData(vtkDataObject* source);
  vtkDataObject* GetSource();
  void SetSourceConnection(vtkAlgorithmOutput* output);
  ///@}

  enum InterpolationMethods
  {
    BLEND = 0,
    CUBIC = 1,
    QUADRATIC = 2,
    AFFINE = 3,
    NEAREST = 4
  };

  ///@{
  /**
   * How values are computed from the samples around:
   * - BLEND: the mean of four fits of degree one to three, weighted by their estimated errors.
   * - CUBIC, QUADRATIC, AFFINE: a fit of this degree, by weighted least squares.
   * - NEAREST: the value of the nearest sample. Arrays keep their types.
   *
   * Values outside the enumeration are clamped. Default: BLEND.
   */
  vtkSetClampMacro(Interpolation, int, BLEND, NEAREST);
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

  enum Strategy
  {
    MASK_POINTS = 0,
    NULL_VALUE = 1,
    CLOSEST_POINT = 2
  };

  ///@{
  /**
   * What null points get, those outside of the samples:
   * - MASK_POINTS: NaN, or 0 in arrays that keep a type of integers, or an empty string; and 0 in
   * an array of char that is 1 at all other points (see SetValidPointsMaskArrayName()).
   * - NULL_VALUE: the NullValue.
   * - CLOSEST_POINT: the value of the nearest sample.
   *
   * Values outside the enumeration are clamped. Default: MASK_POINTS.
   */
  vtkSetClampMacro(NullPointsStrategy, int, MASK_POINTS, CLOSEST_POINT);
  vtkGetMacro(NullPointsStrategy, int);
  ///@}

  ///@{
  /**
   * The number of NULL_VALUE. Arrays of integers get 0 if they cannot hold it. Default: 0.
   */
  vtkSetMacro(NullValue, double);
  vtkGetMacro(NullValue, double);
  ///@}

  ///@{
  /**
   * The name of the array of MASK_POINTS. Default: "vtkValidPointMask".
   */
  vtkSetStdStringFromCharMacro(ValidPointsMaskArrayName);
  vtkGetCharFromStdStringMacro(ValidPointsMaskArrayName);
  ///@}

  ///@{
  /**
   * Whether null points, and cells with any of them, are marked as hidden in "vtkGhostType".
   * Filters and views then ignore them. Default: off.
   */
  vtkSetMacro(MarkBlankPointsAndCells, vtkTypeBool);
  vtkGetMacro(MarkBlankPointsAndCells, vtkTypeBool);
  vtkBooleanMacro(MarkBlankPointsAndCells, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the output has the arrays of the points, of the cells, and the field data of input 0.
   * Ghost marks are passed in any case. Default: field data alone, as in vtkProbeFilter.
   */
  vtkSetMacro(PassPointArrays, vtkTypeBool);
  vtkGetMacro(PassPointArrays, vtkTypeBool);
  vtkBooleanMacro(PassPointArrays, vtkTypeBool);
  vtkSetMacro(PassCellArrays, vtkTypeBool);
  vtkGetMacro(PassCellArrays, vtkTypeBool);
  vtkBooleanMacro(PassCellArrays, vtkTypeBool);
  vtkSetMacro(PassFieldArrays, vtkTypeBool);
  vtkGetMacro(PassFieldArrays, vtkTypeBool);
  vtkBooleanMacro(PassFieldArrays, vtkTypeBool);
  ///@}

protected:
  explicit vtkScatteredProbeFilter(int samplesPort = 1);
  ~vtkScatteredProbeFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /**
   * Gives the output its points, and the arrays that it has besides interpolated ones. Called when
   * the samples are loaded. Collective; may throw isopoint::UsageError and std::bad_alloc.
   */
  virtual void MakePlaces(vtkInformationVector** inputVector, vtkInformation* outputInfo);

  /**
   * The names of the arrays that the filter makes itself. Those of samples do not replace them.
   */
  virtual std::set<std::string> ListOwnArrays() const;

  /**
   * The names of the arrays to interpolate. Null: all.
   */
  virtual const std::set<std::string>* GetChosenArrays() const;

  /**
   * All options that ranks must share, as a text.
   */
  virtual std::string DescribeOptions() const;

  const std::unique_ptr<vtkIsopointProbing> Probing;

  int Interpolation = BLEND;
  std::vector<std::string> NearestArrays;
  int NullPointsStrategy = MASK_POINTS;
  double NullValue = 0.0;
  std::string ValidPointsMaskArrayName = "vtkValidPointMask";
  vtkTypeBool MarkBlankPointsAndCells = false;
  vtkTypeBool PassPointArrays = false;
  vtkTypeBool PassCellArrays = false;
  vtkTypeBool PassFieldArrays = true;

private:
  vtkScatteredProbeFilter(const vtkScatteredProbeFilter&) = delete;
  void operator=(const vtkScatteredProbeFilter&) = delete;

  const isopoint::SampleCounts& GetSampleCounts() const override;
  void FillOutput(vtkDataObject* output);
};

#endif
