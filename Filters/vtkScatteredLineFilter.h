// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkScatteredLineFilter
 * @brief   interpolate scattered samples along a line
 *
 * vtkScatteredLineFilter is a vtkScatteredProbeFilter whose places are the points of a straight
 * line, for plots. Its only input, the samples, is what the source is there. The output is a
 * vtkPolyData of one polyline. Its array "arc_length" (double) is the distance from the begin;
 * an array of the samples with this name is left out, with a message.
 *
 * If a piece of the output is requested, or in a process group (see SetController()), the line is
 * in the first piece.
 *
 * @sa
 * vtkScatteredProbeFilter vtkProbeLineFilter vtkLineSource
 */

#ifndef vtkScatteredLineFilter_h
#define vtkScatteredLineFilter_h

#include "vtkScatteredIsopointFiltersModule.h" // for the export macro
#include "vtkScatteredProbeFilter.h"

class vtkPolyData;

class VTKSCATTEREDISOPOINTFILTERS_EXPORT vtkScatteredLineFilter : public vtkScatteredProbeFilter
{
public:
  static vtkScatteredLineFilter* New();
  vtkTypeMacro(vtkScatteredLineFilter, vtkScatteredProbeFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The ends of the line. Numbers that are not finite are an error in the next update. Default: (0,
   * 0, 0) and (1, 1, 1).
   */
  vtkSetVector3Macro(Point1, double);
  vtkGetVector3Macro(Point1, double);
  vtkSetVector3Macro(Point2, double);
  vtkGetVector3Macro(Point2, double);
  ///@}

  ///@{
  /**
   * The number of pieces of equal length, one less than that of points, from 1 on. Default: 1000.
   */
  vtkSetClampMacro(Resolution, int, 1, VTK_INT_MAX);
  vtkGetMacro(Resolution, int);
  ///@}

  /**
   * The line.
   */
  vtkPolyData* GetOutput();

protected:
  vtkScatteredLineFilter();
  ~vtkScatteredLineFilter() override = default;

  vtkSmartPointer<vtkDataObject> NewOutput(vtkInformationVector** inputVector) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  void MakePlaces(vtkInformationVector** inputVector, vtkInformation* outputInfo) override;

  std::set<std::string> ListOwnArrays() const override;

  double Point1[3] = { 0.0, 0.0, 0.0 };
  double Point2[3] = { 1.0, 1.0, 1.0 };
  int Resolution = 1000;

private:
  vtkScatteredLineFilter(const vtkScatteredLineFilter&) = delete;
  void operator=(const vtkScatteredLineFilter&) = delete;
};

#endif
