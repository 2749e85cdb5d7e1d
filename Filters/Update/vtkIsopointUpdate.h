// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointUpdate_h
#define vtkIsopointUpdate_h

#include "Core/Failure.h"
#include "Core/Report.h"
#include "Update/vtkIsopointExtraction.h"
#include "Update/vtkIsopointRanks.h"

#include "vtkWeakPointer.h"

#include <set>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkInformation;
class vtkMultiProcessController;
struct vtkIsopointOptions;

/**
 * The updates of a filter: each runs an extraction, and reports what the user has to know as errors
 * and messages of the filter. Holds what is kept from one update to the next.
 */
class vtkIsopointUpdate
{
public:
  explicit vtkIsopointUpdate(vtkAlgorithm* filter);
  ~vtkIsopointUpdate();

  /// The processes whose inputs form one cloud; null: this one alone.
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() const { return this->Communicator.GetController(); }

  bool HasOtherRanks() const { return this->Communicator.size() > 1; }

  /// Updates the output. Where that fails there is one error, and the output is empty. Collective.
  /// @returns the error code, the same on all ranks: 0 if the update succeeded or was aborted
  unsigned long Run(
    const vtkIsopointOptions& options, vtkInformation* inputInfo, vtkInformation* outputInfo);

  /// Of the last update; nothing if that failed.
  const isopoint::Report& GetReport() const { return this->Report; }

private:
  unsigned long ReportFailure(isopoint::Failure& failure);
  void ReportMessages();

  vtkAlgorithm* Filter;
  vtkIsopointCommunicator Communicator;
  isopoint::Team Team;
  vtkIsopointExtraction::Kept Kept;
  isopoint::Report Report;
  std::set<std::string> Reported;          // causes of messages in the last update
  vtkWeakPointer<vtkAlgorithm> ReportedOf; // the producer of its input
};

#endif
