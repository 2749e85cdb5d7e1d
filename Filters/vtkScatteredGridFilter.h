// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkScatteredGridFilter
 * @brief   interpolate scattered samples at the points of an image
 *
 * vtkScatteredGridFilter is a vtkScatteredProbeFilter whose places are a vtkImageData in the bounds
 * of the samples, as vtkResampleToImage. Its only input, the samples, is what the source is there.
 * Points outside of the samples are hidden, as are cells with any of them (see
 * SetMarkBlankPointsAndCells(), on by default here), so that contours and volumes end where the
 * samples do. Hidden points have the value of the nearest sample (CLOSEST_POINT is the default
 * here), because NaN would spread to the normals of contours. Axes along which the bounds have no
 * length get one layer of points. By default voxels are cubes, with 100 points along the longest
 * side. Where bounds change later, the numbers of points stay, until the filter or its input is
 * modified.
 *
 * If a piece of the output is requested, it is a box of the image. In a process group (see
 * SetController()) the bounds are those of the samples of all ranks.
 *
 * @sa
 * vtkScatteredProbeFilter vtkResampleToImage
 */

#ifndef vtkScatteredGridFilter_h
#define vtkScatteredGridFilter_h

#include "vtkScatteredIsopointFiltersModule.h" // for the export macro
#include "vtkScatteredProbeFilter.h"

#include <set>    // for the names of arrays
#include <string> // for the same

class vtkImageData;

class VTKSCATTEREDISOPOINTFILTERS_EXPORT vtkScatteredGridFilter : public vtkScatteredProbeFilter
{
public:
  static vtkScatteredGridFilter* New();
  vtkTypeMacro(vtkScatteredGridFilter, vtkScatteredProbeFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The number of points along each axis; 0: as many as the Spacing needs. Negative numbers, and
   * more than 10^11 points in all, are an error in the next update. Default: 0, 0, 0.
   */
  vtkSetVector3Macro(SamplingDimensions, int);
  vtkGetVector3Macro(SamplingDimensions, int);
  ///@}

  ///@{
  /**
   * The distance of points along each axis whose sampling dimension is 0. The image begins at the
   * least bound and ends at the greatest one or up to a distance beyond, or farther beyond where
   * the information pass, which knows only bounds of all points, announced more points. 0: the
   * longest side, divided by 99. Negative and infinite numbers are an error in the next update.
   * Default: 0, 0, 0.
   */
  vtkSetVector3Macro(Spacing, double);
  vtkGetVector3Macro(Spacing, double);
  ///@}

  ///@{
  /**
   * The names of the arrays to interpolate. Names that the samples lack have no effect; if there
   * are none of these arrays, that is an error in the next update. Default: none, for all arrays.
   */
  void AddArray(const char* name);
  void ClearArrays();
  ///@}

  ///@{
  /**
   * Whether the image fills the bounds of the samples in use, or the SamplingBounds. Default: on.
   */
  vtkSetMacro(UseInputBounds, vtkTypeBool);
  vtkGetMacro(UseInputBounds, vtkTypeBool);
  vtkBooleanMacro(UseInputBounds, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The bounds of the image if UseInputBounds is off: least and greatest x, y and z. Descending or
   * infinite ones are an error in the next update. Default: 0, 1, 0, 1, 0, 1.
   */
  vtkSetVector6Macro(SamplingBounds, double);
  vtkGetVector6Macro(SamplingBounds, double);
  ///@}

  /**
   * The image.
   */
  vtkImageData* GetOutput();

protected:
  vtkScatteredGridFilter();
  ~vtkScatteredGridFilter() override = default;

  vtkSmartPointer<vtkDataObject> NewOutput(vtkInformationVector** inputVector) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  void MakePlaces(vtkInformationVector** inputVector, vtkInformation* outputInfo) override;
  const std::set<std::string>* GetChosenArrays() const override;
  std::string DescribeOptions() const override;

  int SamplingDimensions[3] = { 0, 0, 0 };
  double Spacing[3] = { 0.0, 0.0, 0.0 };
  vtkTypeBool UseInputBounds = true;
  double SamplingBounds[6] = { 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 };

private:
  std::string DescribeGrid() const;
  void GuessExtent(vtkInformation* inputInfo, int extent[6]);

  std::set<std::string> Arrays;
  int LastExtent[6]; // of the whole image
  bool IsGuessOfData = false;
  std::string LastGrid;           // what it was found for
  vtkMTimeType LastInputTime = 0; // likewise

  vtkScatteredGridFilter(const vtkScatteredGridFilter&) = delete;
  void operator=(const vtkScatteredGridFilter&) = delete;
};

#endif
