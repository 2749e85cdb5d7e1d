// SPDX-License-Identifier: GPL-3.0-or-later
#include "Update/vtkIsopointUpdate.h"

#include "Core/Contour.h"
#include "Input/vtkIsopointInput.h"
#include "Input/vtkIsopointStructure.h"
#include "Output/vtkIsopointEndSamples.h"
#include "Output/vtkIsopointOutput.h"
#include "Output/vtkIsopointOutputArrays.h"
#include "Output/vtkIsopointPiece.h"
#include "Update/vtkIsopointExecution.h"

#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkContourValues.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkLogger.h"
#include "vtkMultiProcessController.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSetGet.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <exception>
#include <new>
#include <numeric>
#include <string>
#include <utility>

vtkIsopointUpdate::vtkIsopointUpdate(vtkAlgorithm* filter)
  : Filter(filter)
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

unsigned long vtkIsopointUpdate::Run(
  const vtkIsopointOptions& options, vtkInformation* inputInfo, vtkInformation* outputInfo)
{
  this->Options = options; // they may change meanwhile
  this->Report = isopoint::Report();
  isopoint::Failure failure;
  try
  {
    this->Processes.together([&]() { this->Extract(inputInfo, outputInfo); });
  }
  catch (...)
  {
    failure = isopoint::describeException();
  }
  this->Execution = isopoint::Execution(); // releases its threads
  this->Input.ReleaseInput();
  if (!this->Options.KeepTree || failure.spoilsTree())
  {
    this->Clear();
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

void vtkIsopointUpdate::Extract(vtkInformation* inputInfo, vtkInformation* outputInfo)
{
  this->Options.Core = isopoint::effectiveOptions(this->Options.Core);
  // Small bands of many blocks would add up.
  this->Options.Core.keepTetrahedra = this->Options.KeepTree && !this->Options.ContourBlocks;
  this->Execution = vtkMakeIsopointExecution(
    this->Filter, this->Options.UseAllCores, vtkCountIsopointRanksOnCores(this->Processes));
  vtkDataObject* const input = vtkDataObject::GetData(inputInfo);
  vtkDataObject* const output = vtkDataObject::GetData(outputInfo);
  vtkContourValues* const values = this->Options.ContourValues;
  const std::vector<double> isovalues = isopoint::sortedIsovalues(
    { values->GetValues(), values->GetValues() + values->GetNumberOfContours() });
  const vtkIsopointArrayChoice array(this->Filter->GetInputArrayInformation(0));
  isopoint::checkOptions(this->Options.Core);
  vtkCheckIsopointOptionsOnRanks(this->Processes, this->Options, isovalues, array);
  auto* const levels = vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS();
  const int requested = outputInfo->Has(levels) ? std::max(outputInfo->Get(levels), 0) : 0;
  this->GhostLevels =
    static_cast<int>(this->Processes.maximum(static_cast<std::uint64_t>(requested)));

  this->CollectBlocks(input, array,
    this->IsOnRanks() ? inputInfo->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()) : nullptr);
  this->StartCounting(isovalues);
  const vtkIsopointStructure structure = this->Options.ContourBlocks
                                           ? vtkMergeIsopointStructures(this->Processes, input)
                                           : vtkIsopointStructure();
  if (structure.IsComposite())
  {
    this->ExtractLeaves(structure, input, vtkCompositeDataSet::SafeDownCast(output));
  }
  else
  {
    this->Trees.erase(this->Trees.upper_bound(0), this->Trees.end());
    this->ExtractBlocks(
      this->Execution, 0, this->Input.GetBlocks().size(), 0, vtkPolyData::SafeDownCast(output));
  }
  this->Report.share(this->Processes);
  if (this->IsOnRanks())
  {
    return;
  }
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  const int pieces = outputInfo->Get(Pipeline::UPDATE_NUMBER_OF_PIECES());
  if (pieces > 1)
  {
    const int piece = outputInfo->Get(Pipeline::UPDATE_PIECE_NUMBER());
    vtkTakeIsopointPiece(piece, pieces, output);
    auto* const controller = vtkMultiProcessController::GetGlobalController();
    this->Report.isPieceOfProcess =
      piece == 0 && controller && controller->GetNumberOfProcesses() > 1;
  }
}

void vtkIsopointUpdate::CollectBlocks(
  vtkDataObject* input, const vtkIsopointArrayChoice& array, const int* wholeExtent)
{
  vtkIsopointBlocks& blocks = this->Input;
  std::string nothing; // why this rank has no blocks
  try
  {
    blocks.Collect(this->Execution, input, array, wholeExtent);
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
  const bool hasPoints = blocks.GetNumberOfPointsWithoutArray() > 0;
  if (this->Processes.isAny(hasPoints) == hasPoints)
  {
    throw isopoint::UsageError(nothing);
  }
}

void vtkIsopointUpdate::StartCounting(const std::vector<double>& isovalues)
{
  const vtkIsopointBlocks& blocks = this->Input;
  isopoint::Report counts(this->Options.Core, isovalues);
  counts.withoutArray = static_cast<std::uint64_t>(blocks.GetNumberOfPointsWithoutArray());
  counts.samples = counts.withoutArray;
  const char* const name =
    blocks.GetBlocks().empty() ? nullptr : blocks.GetBlocks().front().Scalars->GetName();
  counts.array = name ? name : "";
  counts.contoursBlocks = this->Options.ContourBlocks;
  this->Report = std::move(counts);
}

void vtkIsopointUpdate::ExtractLeaves(
  const vtkIsopointStructure& structure, vtkDataObject* input, vtkCompositeDataSet* output)
{
  const std::vector<vtkIsopointBlock>& blocks = this->Input.GetBlocks();
  const std::vector<std::size_t> numbers = structure.GetNumbersOf(input);
  std::vector<vtkSmartPointer<vtkPolyData>> surfaces(structure.GetNumberOfLeaves());
  // `blocks.size()` if this rank has no block.
  std::vector<std::size_t> blockOf(surfaces.size(), blocks.size());
  std::vector<std::uint64_t> isHeld(surfaces.size(), 0);
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    blockOf[numbers[blocks[i].Leaf]] = i;
    isHeld[numbers[blocks[i].Leaf]] = 1;
  }
  this->Processes.maximum(isHeld); // by any rank
  this->Trees.erase(this->Trees.lower_bound(surfaces.size()), this->Trees.end());
  const double share =
    1.0 / static_cast<double>(std::accumulate(isHeld.begin(), isHeld.end(), std::uint64_t{ 0 }));
  double done = 0.0;
  for (std::size_t leaf = 0; leaf < surfaces.size(); ++leaf)
  {
    if (isHeld[leaf] != 0)
    {
      const isopoint::Execution part =
        isopoint::partOf(this->Execution, share * done, share * (done + 1.0));
      const std::size_t block = blockOf[leaf];
      surfaces[leaf] = vtkSmartPointer<vtkPolyData>::New();
      this->ExtractBlocks(part, block, std::min(block + 1, blocks.size()), leaf, surfaces[leaf]);
      ++done;
    }
  }
  if (output) // null if this rank has no composite
  {
    structure.Fill(input, surfaces, output);
  }
}

void vtkIsopointUpdate::ExtractBlocks(const isopoint::Execution& execution, std::size_t begin,
  std::size_t end, std::size_t tree, vtkPolyData* output)
{
  const auto all = this->Input.GetBlocks().begin();
  const std::vector<vtkIsopointBlock> blocks(
    all + static_cast<std::ptrdiff_t>(begin), all + static_cast<std::ptrdiff_t>(end));
  KeptTree& kept = this->Trees[tree];
  vtkIsopointInputState state = this->Input.GetState(begin, end);
  // Never empty, unlike the state of a tree that was not loaded.
  state.push_back(static_cast<vtkMTimeType>(blocks.size()));
  const bool isNew = this->Processes.isAny(state != kept.LoadedFrom);
  const isopoint::SampleTypes types = vtkGetIsopointSampleTypes(blocks).sharedBy(this->Processes);
  // Shares of the progress, in units of an isovalue's.
  const double loading = isNew ? 0.1 : 0.0;
  constexpr double writing = 0.1;
  const double sum = loading + static_cast<double>(this->Report.isovalues.size()) + writing;
  if (isNew)
  {
    kept.LoadedFrom.clear();
    vtkLoadIsopointInput(isopoint::partOf(execution, 0.0, loading / sum), this->Processes, types,
      blocks, kept.Extractor);
    kept.LoadedFrom = std::move(state);
  }
  this->Report.countSamples(kept.Extractor, vtkCountIsopointSamples(blocks));
  std::vector<isopoint::ExtractedIsosurface> surfaces =
    isopoint::extractIsovalues(isopoint::partOf(execution, loading / sum, 1.0 - writing / sum),
      kept.Extractor, this->Options.Core, this->GhostLevels, this->Report);
  const vtkIsopointEndSamples samples(this->Processes, blocks, surfaces);
  this->FillOutput(samples, surfaces, types.areFloatPositions, output);
  execution.progress(1.0);
}

void vtkIsopointUpdate::FillOutput(const vtkIsopointEndSamples& samples,
  const std::vector<isopoint::ExtractedIsosurface>& surfaces, bool areFloatPositions,
  vtkPolyData* output)
{
  const bool isSingle = isopoint::isSinglePrecision(this->Options.Core, areFloatPositions);
  const vtkSmartPointer<vtkPoints> points =
    vtkNewIsopointPositions(this->Execution, surfaces, isSingle ? VTK_FLOAT : VTK_DOUBLE);
  const vtkIdType count = points->GetNumberOfPoints();
  output->SetPoints(points);
  if (this->Options.Core.triangles)
  {
    output->SetPolys(vtkNewIsopointTriangles(this->Execution, surfaces));
  }
  else
  {
    output->SetVerts(vtkNewIsopointVertices(count));
  }

  vtkPointData* const pointData = output->GetPointData();
  vtkInterpolateIsopointArrays(
    this->Execution, samples.GetAttributes(), samples.GetScalars(), surfaces, pointData);
  if (this->Options.ComputeScalars)
  {
    vtkAddContouredArray(samples.GetScalars(), surfaces, pointData);
  }

  if (this->IsOnRanks() && this->GhostLevels > 0)
  {
    vtkAddIsopointGhosts(surfaces, output);
  }
  for (const std::string& name :
    vtkAddComputedIsopointArrays(this->Execution, this->Options.Core, surfaces, output))
  {
    this->Report.replacedArrays.insert(name);
  }
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

/// Reports a failure on the first rank. @returns the error code of all ranks
unsigned long vtkIsopointUpdate::ReportFailure(isopoint::Failure& failure)
{
  unsigned long code = errorCodeOf(failure.kind);
  std::string message;
  try
  {
    this->Processes.together(
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

namespace
{

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

void vtkIsopointUpdate::ReportMessages()
try
{
  if (this->Processes.rank() > 0)
  {
    return;
  }
  // A message is not repeated while its cause persists for the same input.
  vtkAlgorithm* const producer = this->Filter->GetInputAlgorithm();
  const std::set<std::string> before =
    this->ReportedOf == producer ? this->Reported : std::set<std::string>();
  this->ReportedOf = producer;
  this->Reported.clear();
  const isopoint::OptionNaming naming =
    this->Options.UsePanelNames ? &panelNameOf : &isopoint::sameName;
  for (isopoint::Message& message : isopoint::describeReport(this->Report, naming))
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
