// SPDX-License-Identifier: GPL-3.0-or-later
#include "Update/vtkIsopointUpdate.h"

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

unsigned long vtkIsopointUpdate::Run(
  const vtkIsopointOptions& options, vtkInformation* inputInfo, vtkInformation* outputInfo)
{
  this->Report = isopoint::Report();
  const bool keepsTree = options.KeepTree;
  isopoint::Failure failure;
  try
  {
    this->Team.together(
      [&]()
      {
        vtkIsopointExtraction(this->Filter, this->Team, options, this->Kept, this->Report)
          .Run(inputInfo, outputInfo);
      });
  }
  catch (...)
  {
    failure = isopoint::describeException();
  }
  this->Kept.Input.ReleaseInput();
  if (!keepsTree || failure.spoilsTree())
  {
    this->Kept.Clear();
  }
  if (failure.kind == isopoint::Failure::None)
  {
    this->ReportMessages();
    return 0;
  }
  vtkDataObject::GetData(outputInfo)->Initialize();
  this->Report = isopoint::Report();
  return this->ReportFailure(failure);
}

namespace
{

unsigned long errorCodeOf(isopoint::Failure::Kinds kind)
{
  switch (kind)
  {
    case isopoint::Failure::InvalidUsage:
      return EINVAL;
    case isopoint::Failure::OutOfMemory:
      return ENOMEM;
    case isopoint::Failure::Bug:
      return vtkErrorCode::UnknownError;
    default:
      return 0;
  }
}

} // namespace

/// Reports a failure on the first rank. @returns the code of all ranks' failures
unsigned long vtkIsopointUpdate::ReportFailure(isopoint::Failure& failure)
{
  unsigned long code = errorCodeOf(failure.kind);
  std::string message;
  try
  {
    this->Team.together(
      [&]()
      {
        message = isopoint::firstText(this->Team, failure);
        code = static_cast<unsigned long>(this->Team.maximum(code));
      });
  }
  catch (const std::exception&)
  {
    message.swap(failure.text); // for lack of memory each rank reports its own
    code = ENOMEM;
  }
  if (!message.empty())
  {
    vtkErrorWithObjectMacro(this->Filter, << message);
  }
  return code;
}

void vtkIsopointUpdate::ReportMessages()
try
{
  if (this->Team.rank() > 0)
  {
    return;
  }
  // A cause is reported when it comes up, and not again as long as it lasts for this input.
  vtkAlgorithm* const producer = this->Filter->GetInputAlgorithm();
  const std::set<std::string> before =
    this->ReportedOf == producer ? this->Reported : std::set<std::string>();
  this->ReportedOf = producer;
  this->Reported.clear();
  for (isopoint::Message& message : isopoint::describeReport(this->Report))
  {
    this->Reported.insert(message.cause);
    if (before.count(message.cause) > 0)
    {
      continue;
    }
    if (message.kind == isopoint::Message::Warning)
    {
      vtkWarningWithObjectMacro(this->Filter, << message.text);
      continue;
    }
    if (!this->Filter->HasObserver(vtkCommand::MessageEvent))
    {
      vtkLogF(INFO, "%s: %s", this->Filter->GetClassName(), message.text.c_str());
    }
    this->Filter->InvokeEvent(vtkCommand::MessageEvent, message.text.data());
  }
}
catch (const std::bad_alloc&)
{
  // The output is complete without messages.
}
