// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointUpdate_h
#define vtkIsopointUpdate_h

#include "Core/Base/Execution.h"
#include "Core/Base/ProcessGroup.h"
#include "Core/Contour.h"
#include "Core/Failure.h"
#include "Core/IsosurfaceExtractor.h"
#include "Core/Options.h"
#include "Core/Report.h"
#include "Input/vtkIsopointBlocks.h"
#include "Input/vtkIsopointInputState.h"
#include "Update/vtkIsopointCommunicator.h"

#include "vtkWeakPointer.h"

#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;
class vtkInformation;
class vtkMultiProcessController;

/// The properties that all filters on samples have; see vtkScatteredAlgorithm.
struct vtkIsopointSettings
{
  bool KeepTree = true;
  bool UseAllCores = true;
  bool UsePanelNames = false;
};

/// The samples of some blocks of each rank, and their tree.
struct vtkIsopointCloud
{
  isopoint::IsosurfaceExtractor Extractor;
  std::vector<vtkIsopointBlock> Blocks; // of this rank, possibly none; only during an update
  isopoint::SampleTypes Types;          // of all ranks
  bool IsLoaded = false;                // whether the tree holds these samples

  vtkIsopointInputState State;      // of the blocks
  vtkIsopointInputState LoadedFrom; // the state that the tree was loaded from
};

/// What any filter on samples needs to update: threads, ranks, the samples of its input and their
/// trees, which it keeps between updates, and reports to the user.
class vtkIsopointUpdate
{
public:
  /// @param port of the samples
  vtkIsopointUpdate(vtkAlgorithm* filter, int port);
  ~vtkIsopointUpdate();

  /// For the next update.
  vtkIsopointSettings Settings;

  /// The processes whose inputs form one cloud; null: this process alone.
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() const { return this->Communicator.GetController(); }

  bool IsOnRanks() const { return this->Communicator.size() > 1; }

  /// Messages for the user, with options named as he sees them.
  using Describer = std::function<std::vector<isopoint::Message>(isopoint::OptionNaming)>;

  /// Runs the work of an update on all ranks together, then reports what `describe` says. On
  /// failure reports one error and leaves the output empty. Collective.
  /// @param clear drops results of the last update; called first, and after a failure
  /// @param work throws isopoint::UsageError, or what isopoint::IsosurfaceExtractor throws
  /// @param describe called after success, on the first rank
  /// @returns whether it succeeded, the same on all ranks
  bool Run(vtkDataObject* output, const std::function<void()>& clear,
    const std::function<void()>& work, const Describer& describe);

  /// Of the last update, the same on all ranks: 0 after a success or an abort.
  unsigned long GetErrorCode() const { return this->ErrorCode; }

  // For the work:

  const isopoint::Execution& GetExecution() const { return this->Execution; }
  isopoint::OptionNaming GetOptionNaming() const;
  isopoint::ProcessGroup& GetProcesses() { return this->Processes; }
  bool KeepsTrees() const { return this->Current.KeepTree; }

  /// Checks that all ranks have the same options. Collective.
  /// @param options a text with all of them
  /// @param verb what the filter does with samples, for the message
  /// @throws isopoint::UsageError on one rank and isopoint::FailedElsewhere on the others
  void CheckOptionsOnRanks(const std::string& options, const std::string& verb);

  /// Collects the samples of this rank's input. Collective.
  /// @throws isopoint::UsageError if no rank has any; see also vtkIsopointBlocks::Collect()
  void CollectBlocks(vtkInformation* inputInfo, const vtkIsopointArrayChoice& array);

  const vtkIsopointBlocks& GetInput() const { return this->Input; }

  /// The cloud of the blocks [begin, end) of this rank and the blocks that other ranks pass, with
  /// one of the kept trees. Collective.
  /// @param values the state of values that are no array of the input
  vtkIsopointCloud& FindCloud(
    std::size_t begin, std::size_t end, std::size_t tree, const vtkIsopointInputState& values = {});

  /// Loads the samples of a cloud unless it holds them. Collective.
  void Load(const isopoint::Execution& execution, vtkIsopointCloud& cloud);

  /// The greatest number of ghost levels that a rank is asked for. Collective.
  int GetGhostLevels(vtkInformation* outputInfo);

  /// Reduces the output of a process without ranks to the requested piece.
  /// @returns whether it is the first piece of several processes, whose inputs may differ
  bool TakePiece(vtkInformation* outputInfo, vtkDataObject* output) const;

  /// Drops all kept trees from this number on.
  void DropTrees(std::size_t first);

private:
  unsigned long ReportFailure(isopoint::Failure& failure);
  void ReportMessages(const Describer& describe);
  void Clear();

  vtkAlgorithm* Filter;
  int Port;
  vtkIsopointCommunicator Communicator;
  isopoint::ProcessGroup Processes;
  vtkIsopointBlocks Input;
  std::map<std::size_t, vtkIsopointCloud> Trees;
  std::set<std::string> Reported;          // causes reported in the last update
  vtkWeakPointer<vtkAlgorithm> ReportedOf; // producer of its samples
  unsigned long ErrorCode = 0;

  // Of the present update.
  vtkIsopointSettings Current;
  isopoint::Execution Execution;
};

#endif
