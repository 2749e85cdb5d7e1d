// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointExtraction_h
#define vtkIsopointExtraction_h

#include "Core/Base/Execution.h"
#include "Core/Base/Team.h"
#include "Core/IsosurfaceExtractor.h"
#include "Core/Report.h"
#include "Input/vtkIsopointBlocks.h"
#include "Input/vtkIsopointInputState.h"
#include "Update/vtkIsopointOptions.h"

#include <cstddef>
#include <map>
#include <vector>

class vtkAlgorithm;
class vtkCompositeDataSet;
class vtkDataObject;
class vtkInformation;
class vtkIsopointEndSamples;
class vtkIsopointStructure;
class vtkPolyData;

/**
 * The extraction of one update, from the input to the output. On several ranks all of them run it.
 */
class vtkIsopointExtraction
{
public:
  /// The tree of one cloud, and the state of the input that it was loaded from.
  struct KeptTree
  {
    isopoint::IsosurfaceExtractor Extractor;
    vtkIsopointInputState LoadedFrom;
  };

  /// What is kept from one update to the next.
  struct Kept
  {
    vtkIsopointBlocks Input;
    std::map<std::size_t, KeptTree> Trees; // by leaf if blocks are contoured separately, else one

    void Clear()
    {
      this->Trees.clear();
      this->Input = vtkIsopointBlocks();
    }
  };

  /// @param team must outlive what is kept
  /// @param report receives what is found out
  vtkIsopointExtraction(vtkAlgorithm* filter, isopoint::Team& team,
    const vtkIsopointOptions& options, Kept& kept, isopoint::Report& report);

  /// Fills the output. Called inside isopoint::Team::together().
  /// @throws isopoint::UsageError, or what isopoint::IsosurfaceExtractor throws
  void Run(vtkInformation* inputInfo, vtkInformation* outputInfo);

private:
  bool IsOnRanks() const { return this->Team.size() > 1; }
  void CollectBlocks(
    vtkDataObject* input, const vtkIsopointArrayChoice& array, const int* wholeExtent);
  void StartCounting(const std::vector<double>& isovalues);
  /// Each leaf of all ranks' inputs separately.
  void ExtractLeaves(
    const vtkIsopointStructure& structure, vtkDataObject* input, vtkCompositeDataSet* output);
  /// The cloud of some blocks of each rank, perhaps none, with the kept tree of this number.
  void ExtractBlocks(const isopoint::Execution& execution, std::size_t begin, std::size_t end,
    std::size_t tree, vtkPolyData* output);
  void FillOutput(const vtkIsopointEndSamples& samples,
    const std::vector<isopoint::ExtractedIsosurface>& surfaces, bool areFloatPositions,
    vtkPolyData* output);

  vtkAlgorithm* Filter;
  isopoint::Team& Team;
  vtkIsopointOptions Options; // as they were when the update began
  Kept& State;
  isopoint::Report& Report;
  isopoint::Execution Execution;
  int GhostLevels = 0; // that are requested of the output
};

#endif
