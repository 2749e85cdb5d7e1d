// SPDX-License-Identifier: GPL-3.0-or-later
#include "Update/vtkIsopointUpdate.h"

#include "Input/vtkIsopointInput.h"
#include "Output/vtkIsopointPiece.h"
#include "Update/vtkIsopointExecution.h"

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkLogger.h"
#include "vtkMultiProcessController.h"
#include "vtkSetGet.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <exception>
#include <functional>
#include <new>
#include <utility>

vtkIsopointUpdate::vtkIsopointUpdate(vtkAlgorithm* filter, int port)
  : Filter(filter)
  , Port(port)
  , Processes(this->Communicator)
{
}

vtkIsopointUpdate::~vtkIsopointUpdate() = default;

void vtkIsopointUpdate::SetController(vtkMultiProcessController* controller)
{
  this->Clear(); // kept trees belong to other ranks
  this->Communicator.SetController(controller);
}

void vtkIsopointUpdate::Clear()
{
  this->Trees.clear();
  this->Input = vtkIsopointBlocks();
}

namespace
{

unsigned long errorCodeOf(isopoint::Failure::Kind kind)
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

/// A name as in ParaView's panel: DropGaps is "Drop Gaps" there.
std::string panelNameOf(const char* name)
{
  std::string words;
  for (const char* letter = name; *letter != '\0'; ++letter)
  {
    const bool startsWord = *letter >= 'A' && *letter <= 'Z' && !words.empty();
    words += startsWord ? std::string{ ' ', *letter } : std::string(1, *letter);
  }
  return words;
}

} // namespace

bool vtkIsopointUpdate::Run(vtkDataObject* output, const std::function<void()>& clear,
  const std::function<void()>& work, const Describer& describe)
{
  clear();
  this->Current = this->Settings; // they may change meanwhile
  this->ErrorCode = 0;
  isopoint::Failure failure;
  try
  {
    this->Processes.runCollectively(
      [&]()
      {
        this->Execution = vtkMakeIsopointExecution(
          this->Filter, this->Current.UseAllCores, vtkCountIsopointRanksOnCores(this->Processes));
        work();
      });
  }
  catch (...)
  {
    failure = isopoint::describeException();
  }
  this->Execution = isopoint::Execution(); // releases its threads
  this->Input.ReleaseInput();
  for (auto& [number, cloud] : this->Trees)
  {
    cloud.Blocks.clear();
  }
  if (!this->Current.KeepTree || failure.spoilsTree())
  {
    this->Clear();
  }
  if (failure.kind == isopoint::Failure::None)
  {
    this->ReportMessages(describe);
    return true;
  }
  clear();
  output->Initialize();
  this->ErrorCode = this->ReportFailure(failure);
  return false;
}

void vtkIsopointUpdate::CheckOptionsOnRanks(const std::string& options, const std::string& verb)
{
  const std::uint64_t hash = std::hash<std::string>()(options);
  const bool differ = this->Processes.maximum(hash) != ~this->Processes.maximum(~hash);
  if (differ && this->Processes.rank() == 0)
  {
    throw isopoint::UsageError(
      "The filters of the ranks have different options. Set the same on all of them, or " + verb +
      " each rank's samples separately by setting Controller to null.");
  }
}

void vtkIsopointUpdate::CollectBlocks(
  vtkInformation* inputInfo, const vtkIsopointArrayChoice& array)
{
  std::string nothing; // why this rank has no blocks
  try
  {
    this->Input.Collect(this->Execution, vtkDataObject::GetData(inputInfo), array,
      this->IsOnRanks() ? inputInfo->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT())
                        : nullptr);
  }
  catch (const vtkIsopointNoSamplesError& error)
  {
    nothing = error.what();
  }
  if (this->Processes.isAny(nothing.empty()))
  {
    return;
  }
  // No rank has samples. A rank with points but without the array knows which arrays there are, and
  // reports that; the others notice at their next collective step.
  const bool hasPoints = this->Input.GetNumberOfPointsWithoutArray() > 0;
  if (this->Processes.isAny(hasPoints) == hasPoints)
  {
    throw isopoint::UsageError(nothing);
  }
}

vtkIsopointCloud& vtkIsopointUpdate::FindCloud(
  std::size_t begin, std::size_t end, std::size_t tree, const vtkIsopointInputState& values)
{
  vtkIsopointCloud& cloud = this->Trees[tree];
  const auto all = this->Input.GetBlocks().begin();
  cloud.Blocks.assign(
    all + static_cast<std::ptrdiff_t>(begin), all + static_cast<std::ptrdiff_t>(end));
  cloud.State = this->Input.GetState(begin, end);
  cloud.State.insert(cloud.State.end(), values.begin(), values.end());
  // Never empty, unlike the state of a tree that was not loaded.
  cloud.State.push_back(static_cast<vtkMTimeType>(cloud.Blocks.size()));
  cloud.IsLoaded = !this->Processes.isAny(cloud.State != cloud.LoadedFrom);
  cloud.Types = vtkGetIsopointSampleTypes(cloud.Blocks).sharedBy(this->Processes);
  return cloud;
}

void vtkIsopointUpdate::Load(const isopoint::Execution& execution, vtkIsopointCloud& cloud)
{
  if (!cloud.IsLoaded)
  {
    cloud.LoadedFrom.clear();
    vtkLoadIsopointInput(execution, this->Processes, cloud.Types, cloud.Blocks, cloud.Extractor);
    cloud.LoadedFrom = cloud.State;
    cloud.IsLoaded = true;
  }
}

int vtkIsopointUpdate::GetGhostLevels(vtkInformation* outputInfo)
{
  auto* const levels = vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS();
  const int requested = outputInfo->Has(levels) ? std::max(outputInfo->Get(levels), 0) : 0;
  return static_cast<int>(this->Processes.maximum(static_cast<std::uint64_t>(requested)));
}

bool vtkIsopointUpdate::TakePiece(vtkInformation* outputInfo, vtkDataObject* output) const
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  const int pieces = outputInfo->Get(Pipeline::UPDATE_NUMBER_OF_PIECES());
  if (this->IsOnRanks() || pieces <= 1)
  {
    return false;
  }
  const int piece = outputInfo->Get(Pipeline::UPDATE_PIECE_NUMBER());
  vtkTakeIsopointPiece(piece, pieces, output);
  auto* const controller = vtkMultiProcessController::GetGlobalController();
  return piece == 0 && controller && controller->GetNumberOfProcesses() > 1;
}

void vtkIsopointUpdate::DropTrees(std::size_t first)
{
  this->Trees.erase(this->Trees.lower_bound(first), this->Trees.end());
}

/// Reports a failure on the first rank. @returns the error code of all ranks
unsigned long vtkIsopointUpdate::ReportFailure(isopoint::Failure& failure)
{
  unsigned long code = errorCodeOf(failure.kind);
  std::string message;
  try
  {
    this->Processes.runCollectively(
      [&]()
      {
        message = isopoint::firstText(this->Processes, failure);
        code = static_cast<unsigned long>(this->Processes.maximum(code));
      });
  }
  catch (const std::exception&)
  {
    message.swap(failure.text); // if memory is lacking, each rank reports its own
    code = ENOMEM;
  }
  if (!message.empty())
  {
    vtkErrorWithObjectMacro(this->Filter, << message);
  }
  return code;
}

isopoint::OptionNaming vtkIsopointUpdate::GetOptionNaming() const
{
  return this->Current.UsePanelNames ? &panelNameOf : &isopoint::sameName;
}

void vtkIsopointUpdate::ReportMessages(const Describer& describe)
try
{
  if (this->Processes.rank() > 0)
  {
    return;
  }
  // A message is not repeated while its cause persists for the same input.
  vtkAlgorithm* const producer = this->Filter->GetInputAlgorithm(this->Port, 0);
  const std::set<std::string> before =
    this->ReportedOf == producer ? this->Reported : std::set<std::string>();
  this->ReportedOf = producer;
  this->Reported.clear();
  for (isopoint::Message& message : describe(this->GetOptionNaming()))
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
  // The output is complete even without messages.
}
