// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointUpdate_h
#define vtkIsopointUpdate_h

#include "Core/Base/Execution.h"
#include "Core/Base/ProcessGroup.h"
#include "Core/Failure.h"
#include "Core/IsosurfaceExtractor.h"
#include "Core/Report.h"
#include "Input/vtkIsopointBlocks.h"
#include "Input/vtkIsopointInputState.h"
#include "Update/vtkIsopointCommunicator.h"
#include "Update/vtkIsopointOptions.h"

#include "vtkWeakPointer.h"

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkCompositeDataSet;
class vtkDataObject;
class vtkInformation;
class vtkIsopointEndSamples;
class vtkIsopointStructure;
class vtkMultiProcessController;
class vtkPolyData;

/// Runs the updates of a filter, from the input to the output, reports to the user, and keeps data
/// between updates.
class vtkIsopointUpdate
{
public:
  explicit vtkIsopointUpdate(vtkAlgorithm* filter);
  ~vtkIsopointUpdate();

  /// The processes whose inputs form one cloud; null: this process alone.
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() const { return this->Communicator.GetController(); }

  bool IsOnRanks() const { return this->Communicator.size() > 1; }

  /// Updates the output; on failure reports one error and leaves the output empty. Collective.
  /// @returns the error code, the same on all ranks: 0 after a success or an abort
  unsigned long Run(
    const vtkIsopointOptions& options, vtkInformation* inputInfo, vtkInformation* outputInfo);

  /// Of the last update; empty if it failed.
  const isopoint::Report& GetReport() const { return this->Report; }

private:
  /// The tree of one cloud, with the state of the input that it was loaded from.
  struct KeptTree
  {
    isopoint::IsosurfaceExtractor Extractor;
    vtkIsopointInputState LoadedFrom;
  };

  /// Fills the output. Call it inside isopoint::ProcessGroup::together().
  /// @throws isopoint::UsageError, or what isopoint::IsosurfaceExtractor throws
  void Extract(vtkInformation* inputInfo, vtkInformation* outputInfo);
  void CollectBlocks(
    vtkDataObject* input, const vtkIsopointArrayChoice& array, const int* wholeExtent);
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
  unsigned long ReportFailure(isopoint::Failure& failure);
  void ReportMessages();
  void Clear();

  vtkAlgorithm* Filter;
  vtkIsopointCommunicator Communicator;
  isopoint::ProcessGroup Processes;
  vtkIsopointBlocks Input;
  std::map<std::size_t, KeptTree> Trees; // by leaf if blocks are contoured separately, else one
  isopoint::Report Report;
  std::set<std::string> Reported;          // causes reported in the last update
  vtkWeakPointer<vtkAlgorithm> ReportedOf; // producer of its input

  // Of the present update.
  vtkIsopointOptions Options;
  isopoint::Execution Execution;
  int GhostLevels = 0; // requested of the output
};

#endif
