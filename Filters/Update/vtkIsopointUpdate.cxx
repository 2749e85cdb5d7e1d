// SPDX-License-Identifier: GPL-3.0-or-later
#include "Update/vtkIsopointUpdate.h"

#include "Core/Base/Execution.h"
#include "Input/vtkIsopointUsageError.h"
#include "Update/vtkIsopointOptions.h"

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkLogger.h"
#include "vtkSetGet.h"

#include <cerrno>
#include <exception>
#include <new>
#include <stdexcept>

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

unsigned long vtkIsopointUpdate::Run(const std::function<void(vtkIsopointOptions&)>& fillOptions,
  vtkInformation* inputInfo, vtkInformation* outputInfo)
{
  this->Findings = vtkIsopointFindings();
  bool keepsTree = false;
  Failure failure;
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
      failure = this->DescribeFailure();
    }
    catch (const std::bad_alloc&)
    {
      this->Kept.Clear();
      failure = { "Out of memory.", ENOMEM }; // short enough to take none
    }
  }
  this->Filter->SetProgressShiftScale(0.0, 1.0);
  this->Kept.Input.ReleaseInput();
  if (hasFailed)
  {
    this->Report(failure); // first: the other ranks wait for it
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
  return failure.Code;
}

/// Describes the exception that is being handled; what was kept is dropped where it may not be
/// sound.
vtkIsopointUpdate::Failure vtkIsopointUpdate::DescribeFailure()
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
    return { error.what(), EINVAL };
  }
  catch (const std::bad_alloc&)
  {
    this->Kept.Clear();
    return { "Out of memory. Free memory, switch KeepTree off, or reduce the number of samples.",
      ENOMEM };
  }
  catch (const std::length_error& error)
  {
    this->Kept.Clear();
    return { std::string("Cannot build the tree of the samples (") + error.what() +
               "). Merge coincident samples or reduce the number of samples.",
      EINVAL };
  }
  catch (const std::exception& error)
  {
    this->Kept.Clear();
    return { std::string("The extraction failed unexpectedly (") + error.what() +
               "). Report this as a bug, with the input.",
      vtkErrorCode::UnknownError };
  }
  catch (...)
  {
    this->Kept.Clear();
    return { "The extraction failed unexpectedly. Report this as a bug, with the input.",
      vtkErrorCode::UnknownError };
  }
}

/// Reports a failure on the first rank, and gives all ranks the same code.
void vtkIsopointUpdate::Report(Failure& failure)
{
  std::string message;
  try
  {
    this->Team.together(
      [&]()
      {
        message = vtkGatherIsopointProblem(this->Team, failure.Problem);
        failure.Code = static_cast<unsigned long>(this->Team.maximum(failure.Code));
      });
  }
  catch (const std::exception&)
  {
    message.swap(failure.Problem); // for lack of memory each rank reports its own
    failure.Code = ENOMEM;
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
