// SPDX-License-Identifier: GPL-3.0-or-later
#include "Update/vtkIsopointUpdate.h"

#include "Input/vtkIsopointUsageError.h"
#include "Isopoint/Base/Execution.h"
#include "Update/vtkIsopointOptions.h"

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkLogger.h"
#include "vtkSetGet.h"

#include <exception>
#include <new>
#include <stdexcept>
#include <utility>

vtkIsopointUpdate::vtkIsopointUpdate(vtkAlgorithm* filter)
  : Filter(filter)
  , Team(this->Communicator)
{
}

vtkIsopointUpdate::~vtkIsopointUpdate() = default;

void vtkIsopointUpdate::SetController(vtkMultiProcessController* controller)
{
  this->Kept.Clear(); // what is kept belongs to other ranks
  this->Communicator.SetController(controller);
}

void vtkIsopointUpdate::Run(const std::function<void(vtkIsopointOptions&)>& fillOptions,
  vtkInformation* inputInfo, vtkInformation* outputInfo)
{
  this->Findings = vtkIsopointFindings();
  bool keepsTree = false;
  std::string problem;
  bool hasFailed = true;
  try
  {
    this->Team.together(
      [&]()
      {
        vtkIsopointOptions options;
        fillOptions(options);
        keepsTree = options.KeepTree;
        vtkIsopointExtraction(this->Filter, this->Team, options, this->Kept, this->Findings)
          .Run(inputInfo, outputInfo);
      });
    hasFailed = false;
  }
  catch (...)
  {
    try
    {
      problem = this->DescribeFailure();
    }
    catch (const std::bad_alloc&)
    {
      this->Kept.Clear();
      problem = "Out of memory."; // short enough to take none
    }
  }
  this->Filter->SetProgressShiftScale(0.0, 1.0);
  this->Kept.Input.ReleaseInput();
  if (hasFailed)
  {
    this->ReportProblem(std::move(problem)); // first: the other ranks wait for it
    vtkDataObject::GetData(outputInfo)->Initialize();
    this->Findings = vtkIsopointFindings();
  }
  else
  {
    this->ReportFindings();
  }
  if (!keepsTree)
  {
    this->Kept.Clear();
  }
}

/// What to report of the exception that is being handled; what was kept is dropped where it may not
/// be sound. Empty if there is nothing to report.
std::string vtkIsopointUpdate::DescribeFailure()
{
  try
  {
    throw;
  }
  catch (const isopoint::Aborted&)
  {
    return {};
  }
  catch (const isopoint::FailedElsewhere&)
  {
    return {};
  }
  catch (const vtkIsopointUsageError& error)
  {
    return error.what();
  }
  catch (const std::bad_alloc&)
  {
    this->Kept.Clear();
    return "Out of memory. Free memory, switch KeepTree off, or reduce the number of samples.";
  }
  catch (const std::length_error& error)
  {
    this->Kept.Clear();
    return std::string("Cannot build the tree of the samples (") + error.what() +
           "). Merge coincident samples or reduce the number of samples.";
  }
  catch (const std::exception& error)
  {
    this->Kept.Clear();
    return std::string("The extraction failed unexpectedly (") + error.what() +
           "). Report this as a bug, with the input.";
  }
  catch (...)
  {
    this->Kept.Clear();
    return "The extraction failed unexpectedly. Report this as a bug, with the input.";
  }
}

void vtkIsopointUpdate::ReportProblem(std::string problem)
{
  std::string message;
  try
  {
    this->Team.together([&]() { message = vtkGatherIsopointProblem(this->Team, problem); });
  }
  catch (const std::exception&)
  {
    message.swap(problem); // for lack of memory each rank reports its own
  }
  if (!message.empty())
  {
    vtkErrorWithObjectMacro(this->Filter, << message);
  }
}

void vtkIsopointUpdate::ReportFindings()
{
  if (this->Team.rank() > 0)
  {
    return;
  }
  try
  {
    this->ReportMessages(vtkDescribeIsopointFindings(this->Findings));
  }
  catch (const std::bad_alloc&)
  {
    // The output is complete without warnings.
  }
}

void vtkIsopointUpdate::ReportMessages(const std::vector<vtkIsopointMessage>& messages)
{
  // A cause is reported when it comes up, and not again as long as it lasts for this input.
  vtkAlgorithm* const producer = this->Filter->GetInputAlgorithm();
  const std::set<std::string> before =
    this->ReportedOf == producer ? this->Reported : std::set<std::string>();
  this->ReportedOf = producer;
  this->Reported.clear();
  for (const vtkIsopointMessage& message : messages)
  {
    this->Reported.insert(message.Cause);
    if (before.count(message.Cause) > 0)
    {
      continue;
    }
    if (message.Kind == vtkIsopointMessage::WARNING)
    {
      vtkWarningWithObjectMacro(this->Filter, << message.Text);
      continue;
    }
    if (!this->Filter->HasObserver(vtkCommand::MessageEvent))
    {
      vtkLogF(INFO, "%s: %s", this->Filter->GetClassName(), message.Text.c_str());
    }
    std::string text = message.Text;
    this->Filter->InvokeEvent(vtkCommand::MessageEvent, text.data());
  }
}
