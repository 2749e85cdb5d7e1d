// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointContouring_h
#define vtkIsopointContouring_h

#include "Core/Base/Execution.h"
#include "Core/ExtractionRequest.h"
#include "Core/Report.h"
#include "Input/vtkIsopointInputState.h"
#include "Update/vtkIsopointOptions.h"

#include <cstddef>
#include <vector>

class vtkCompositeDataSet;
class vtkDataObject;
class vtkInformation;
class vtkIsopointEndSamples;
class vtkIsopointStructure;
class vtkIsopointUpdate;
class vtkPolyData;

/// Extracts isosurfaces in the updates of a filter, from the samples to the output.
class vtkIsopointContouring
{
public:
  /// @param update of the filter; must outlive this
  explicit vtkIsopointContouring(vtkIsopointUpdate& update);
  ~vtkIsopointContouring();

  /// Updates the output; see vtkIsopointUpdate::Run(). Collective.
  /// @param inputArray the information of the array to contour
  void Run(const vtkIsopointOptions& options, vtkInformation* inputInfo, vtkInformation* inputArray,
    vtkInformation* outputInfo);

  /// Of the last update; empty if it failed.
  const isopoint::Report& GetReport() const { return this->Report; }

private:
  /// Fills the output.
  /// @throws isopoint::UsageError, or what isopoint::IsosurfaceExtractor throws
  void Extract(vtkInformation* inputInfo, vtkInformation* inputArray, vtkInformation* outputInfo);
  void StartCounting(const std::vector<double>& isovalues);
  /// Extracts each leaf of all ranks' inputs separately.
  void ExtractLeaves(
    const vtkIsopointStructure& structure, vtkDataObject* input, vtkCompositeDataSet* output);
  /// Extracts the cloud of some blocks of each rank, possibly none, with one of the kept trees.
  void ExtractBlocks(const isopoint::Execution& execution, std::size_t begin, std::size_t end,
    std::size_t tree, vtkPolyData* output);
  void FillOutput(const vtkIsopointEndSamples& samples,
    const std::vector<isopoint::ExtractedIsosurface>& surfaces, bool areFloatPositions,
    vtkPolyData* output);

  vtkIsopointUpdate& Update;
  isopoint::Report Report;
  vtkIsopointInputState SurfaceOf; // the input of earlier updates, if they had a surface

  // Of the present update.
  vtkIsopointOptions Options;
  int GhostLevels = 0;         // requested of the output
  vtkIsopointInputState State; // of the input
};

#endif
