// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredIsopointFilter.h"

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Base/Team.h"
#include "Isopoint/IsosurfaceExtractor.h"
#include "vtkIsopointBlock.h"
#include "vtkIsopointBlocks.h"
#include "vtkIsopointComputedArrays.h"
#include "vtkIsopointEndSamples.h"
#include "vtkIsopointExecution.h"
#include "vtkIsopointFindings.h"
#include "vtkIsopointInput.h"
#include "vtkIsopointInputState.h"
#include "vtkIsopointInterpolatedArrays.h"
#include "vtkIsopointOptions.h"
#include "vtkIsopointOutput.h"
#include "vtkIsopointRanks.h"
#include "vtkIsopointStructure.h"
#include "vtkIsopointUsageError.h"
#include "vtkScatteredIsopointFilterInternals.h"

#include "vtkCellArray.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkContourValues.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkLogger.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <iterator>
#include <memory>
#include <new>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using isopoint::Execution;

vtkStandardNewMacro(vtkScatteredIsopointFilter);

vtkScatteredIsopointFilter::vtkScatteredIsopointFilter()
  : Angle(isopoint::defaultAngle)
  , NumberOfNeighbors(isopoint::defaultNeighborCount)
  , Kept(new Internals)
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  this->Kept->Controller = vtkMultiProcessController::GetGlobalController();
  this->SetProgressText("Scattered Isopoints"); // as in ParaView's menu
}

vtkScatteredIsopointFilter::~vtkScatteredIsopointFilter() = default;

void vtkScatteredIsopointFilter::SetController(vtkMultiProcessController* controller)
{
  if (this->Kept->Controller != controller)
  {
    this->Kept->Controller = controller;
    this->Modified();
  }
}

vtkMultiProcessController* vtkScatteredIsopointFilter::GetController() const
{
  return this->Kept->Controller;
}

void vtkScatteredIsopointFilter::SetValue(int i, double value)
{
  this->ContourValues->SetValue(i, value);
}

double vtkScatteredIsopointFilter::GetValue(int i)
{
  return this->ContourValues->GetValue(i);
}

double* vtkScatteredIsopointFilter::GetValues()
{
  return this->ContourValues->GetValues();
}

void vtkScatteredIsopointFilter::GetValues(double* contourValues)
{
  this->ContourValues->GetValues(contourValues);
}

void vtkScatteredIsopointFilter::SetNumberOfContours(int number)
{
  this->ContourValues->SetNumberOfContours(number);
}

vtkIdType vtkScatteredIsopointFilter::GetNumberOfContours()
{
  return this->ContourValues->GetNumberOfContours();
}

void vtkScatteredIsopointFilter::GenerateValues(int numContours, double range[2])
{
  this->ContourValues->GenerateValues(numContours, range);
}

void vtkScatteredIsopointFilter::GenerateValues(int numContours, double rangeStart, double rangeEnd)
{
  this->ContourValues->GenerateValues(numContours, rangeStart, rangeEnd);
}

vtkMTimeType vtkScatteredIsopointFilter::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->ContourValues->GetMTime());
}

int vtkScatteredIsopointFilter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkHyperTreeGrid");
  return 1;
}

int vtkScatteredIsopointFilter::FillOutputPortInformation(int, vtkInformation* info)
{
  // A vtkPolyData, or a composite of these (see SetContourBlocks()).
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
  return 1;
}

vtkTypeBool vtkScatteredIsopointFilter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    return this->Superclass::ProcessRequest(request, inputVector, outputVector);
  }
  vtkDataObject* const input = vtkDataObject::GetData(inputVector[0]);
  vtkDataObject* const output = vtkDataObject::GetData(outputVector);
  const vtkSmartPointer<vtkDataObject> required =
    this->ContourBlocks && vtkCompositeDataSet::SafeDownCast(input)
      ? vtkNewIsopointComposite(input)
      : vtkSmartPointer<vtkDataObject>(vtkSmartPointer<vtkPolyData>::New());
  if (!output || std::strcmp(output->GetClassName(), required->GetClassName()) != 0)
  {
    outputVector->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), required);
  }
  return 1;
}

int vtkScatteredIsopointFilter::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const int result = this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
  this->ConnectRanks();
  if (this->Kept->Link)
  {
    // Ghosts of the output are no reason to read the input with ghosts, which take no part.
    inputVector[0]->GetInformationObject(0)->Set(
      vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  }
  return result;
}

int vtkScatteredIsopointFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->ClearCounts();
  vtkInformation* const outputInfo = outputVector->GetInformationObject(0);
  auto* const levels = vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS();
  this->Kept->GhostLevels = outputInfo->Has(levels) ? std::max(outputInfo->Get(levels), 0) : 0;
  vtkDataObject* const output = vtkDataObject::GetData(outputVector);
  this->ExtractSafely(vtkDataObject::GetData(inputVector[0]), output);
  this->SetProgressShiftScale(0.0, 1.0);
  this->Kept->Input.ReleaseInput();
  if (!this->KeepTree)
  {
    this->Kept->Clear();
  }
  return 1;
}

void vtkScatteredIsopointFilter::ClearCounts()
{
  this->NumberOfSamples = 0;
  this->NumberOfExtractedPoints = 0;
  this->NumberOfSkippedSamples = 0;
  this->NumberOfUnprojectedPoints = 0;
  this->NumberOfDroppedInGaps = 0;
}

void vtkScatteredIsopointFilter::ExtractSafely(vtkDataObject* input, vtkDataObject* output)
{
  std::string problem;
  this->ConnectRanks();
  try
  {
    if (this->Kept->Link)
    {
      this->Kept->Team->together([&]() { this->ExtractOnRanks(input, output); });
    }
    else
    {
      this->ExtractInput(input, output);
    }
    this->ReportFindings();
    return;
  }
  catch (const isopoint::Aborted&)
  {
  }
  catch (const isopoint::FailedElsewhere&)
  {
  }
  catch (const vtkIsopointUsageError& error)
  {
    problem = error.what();
  }
  catch (const std::bad_alloc&)
  {
    this->Kept->Clear();
    problem = "Out of memory. Free memory, switch KeepTree off, or reduce the number of samples.";
  }
  catch (const std::length_error& error)
  {
    this->Kept->Clear();
    problem = std::string("Cannot build the tree of the samples (") + error.what() +
              "). Merge coincident samples or reduce the number of samples.";
  }
  catch (const std::exception& error)
  {
    this->Kept->Clear();
    problem = std::string("The extraction failed unexpectedly (") + error.what() +
              "). Report this as a bug, with the input.";
  }
  output->Initialize();
  this->ClearCounts();
  this->ReportProblem(problem);
}

void vtkScatteredIsopointFilter::ReportProblem(const std::string& problem)
{
  std::string message = problem;
  if (this->Kept->Link)
  {
    try
    {
      isopoint::Team& team = *this->Kept->Team;
      team.together([&]() { message = vtkGatherIsopointProblem(team, problem); });
    }
    catch (const std::exception&)
    {
      // For lack of memory each rank reports its own.
    }
  }
  if (!message.empty())
  {
    vtkErrorMacro(<< message);
  }
}

void vtkScatteredIsopointFilter::ReportFindings()
{
  this->NumberOfSamples = static_cast<vtkIdType>(this->Kept->Findings.Samples);
  this->NumberOfExtractedPoints = static_cast<vtkIdType>(this->Kept->Findings.GetNumberOfPoints());
  if (this->Kept->Link && this->Kept->Link->rank() > 0)
  {
    return;
  }
  vtkIsopointFindings& findings = this->Kept->Findings;
  findings.UnprojectedPoints = this->Projection == NO_PROJECTION
                                 ? 0
                                 : static_cast<std::uint64_t>(this->NumberOfUnprojectedPoints);
  try
  {
    this->ReportMessages(vtkDescribeIsopointFindings(findings));
  }
  catch (const std::bad_alloc&)
  {
    // The output is complete without warnings.
  }
}

void vtkScatteredIsopointFilter::ReportMessages(const std::vector<vtkIsopointMessage>& messages)
{
  // A cause is reported when it comes up, and not again as long as it lasts for this input.
  vtkAlgorithm* const producer = this->GetInputAlgorithm();
  const std::set<std::string> before =
    this->Kept->ReportedOf == producer ? this->Kept->Reported : std::set<std::string>();
  this->Kept->ReportedOf = producer;
  this->Kept->Reported.clear();
  for (const vtkIsopointMessage& message : messages)
  {
    this->Kept->Reported.insert(message.Cause);
    if (before.count(message.Cause) > 0)
    {
      continue;
    }
    if (message.Kind == vtkIsopointMessage::WARNING)
    {
      vtkWarningMacro(<< message.Text);
      continue;
    }
    if (!this->HasObserver(vtkCommand::MessageEvent))
    {
      vtkLogF(INFO, "%s: %s", this->GetClassName(), message.Text.c_str());
    }
    std::string text = message.Text;
    this->InvokeEvent(vtkCommand::MessageEvent, text.data());
  }
}

void vtkScatteredIsopointFilter::ExtractInput(vtkDataObject* input, vtkDataObject* output)
{
  vtkCheckIsopointOptions(this);
  vtkIsopointBlocks& blocks = this->Kept->Input;
  blocks.Collect(vtkMakeIsopointExecution(this, this->UseAllCores != 0), input,
    vtkIsopointArrayChoice(this->GetInputArrayInformation(0)), nullptr);
  this->StartCounting();
  if (auto* const surface = vtkPolyData::SafeDownCast(output))
  {
    this->Kept->Trees.erase(this->Kept->Trees.upper_bound(0), this->Kept->Trees.end());
    this->ExtractBlocks(0, blocks.GetBlocks().size(), this->Kept->Trees[0], surface);
  }
  else
  {
    this->ExtractLeaves(input, vtkCompositeDataSet::SafeDownCast(output));
  }
  vtkFindIsopointRange(blocks.GetBlocks(), this->Kept->Findings);
}

void vtkScatteredIsopointFilter::StartCounting()
{
  const vtkIsopointBlocks& blocks = this->Kept->Input;
  this->NumberOfSkippedSamples = blocks.GetNumberOfPointsWithoutArray();
  vtkIsopointFindings& findings = this->Kept->Findings;
  findings.Start(this->GetIsovalues());
  findings.AreTriangles = this->ExtractsTriangles();
  findings.DropsGaps = this->DropGaps != 0;
  findings.WithoutArray = static_cast<std::uint64_t>(blocks.GetNumberOfPointsWithoutArray());
  findings.Samples = findings.WithoutArray;
  const char* const name =
    blocks.GetBlocks().empty() ? nullptr : blocks.GetBlocks().front().Scalars->GetName();
  findings.Array = name ? name : "";
}

void vtkScatteredIsopointFilter::ExtractLeaves(vtkDataObject* input, vtkCompositeDataSet* output)
{
  const vtkIsopointBlocks& blocks = this->Kept->Input;
  const std::size_t count = blocks.GetBlocks().size();
  this->Kept->Trees.erase(
    this->Kept->Trees.lower_bound(blocks.GetNumberOfLeaves()), this->Kept->Trees.end());
  const vtkIsopointStructure structure(input);
  const std::vector<std::size_t> numbers = structure.GetNumbersOf(input);
  std::vector<vtkSmartPointer<vtkPolyData>> surfaces(structure.GetNumberOfLeaves());
  for (std::size_t i = 0; i < count; ++i)
  {
    const double share = 1.0 / static_cast<double>(count);
    this->SetProgressShiftScale(share * static_cast<double>(i), share);
    const std::size_t leaf = blocks.GetBlocks()[i].Leaf;
    vtkSmartPointer<vtkPolyData>& surface = surfaces[numbers[leaf]];
    surface = vtkSmartPointer<vtkPolyData>::New();
    this->ExtractBlocks(i, i + 1, this->Kept->Trees[leaf], surface);
  }
  structure.Fill(input, surfaces, output);
}

void vtkScatteredIsopointFilter::ExtractBlocks(
  std::size_t begin, std::size_t end, KeptTree& kept, vtkPolyData* output)
{
  const Execution execution = vtkMakeIsopointExecution(this, this->UseAllCores != 0);
  const std::vector<vtkIsopointBlock>& all = this->Kept->Input.GetBlocks();
  const std::vector<vtkIsopointBlock> blocks(all.begin() + static_cast<std::ptrdiff_t>(begin),
    all.begin() + static_cast<std::ptrdiff_t>(end));
  const vtkIsopointInputState state = this->Kept->Input.GetState(begin, end);
  const std::size_t count = std::accumulate(blocks.begin(), blocks.end(), std::size_t{ 0 },
    [](std::size_t sum, const vtkIsopointBlock& block)
    { return sum + static_cast<std::size_t>(block.GetNumberOfSamples()); });
  const bool isNew = state != kept.LoadedFrom;
  const std::vector<double> progress = this->ExpectProgress(count, !isNew);
  if (isNew)
  {
    kept.LoadedFrom.clear();
    vtkLoadIsopointInput(
      isopoint::partOf(execution, 0.0, progress.front()), blocks, kept.Extractor);
    kept.LoadedFrom = state;
  }
  this->CountSkippedSamples(blocks, kept.Extractor.skippedCount());
  std::vector<isopoint::ExtractedIsosurface> surfaces =
    this->ExtractIsovalues(execution, kept, progress);
  const vtkIsopointEndSamples samples(blocks, surfaces);
  this->FillOutput(execution, samples, surfaces, vtkHaveFloatPositions(blocks), output);
  this->UpdateProgress(1.0);
}

void vtkScatteredIsopointFilter::CountSkippedSamples(
  const std::vector<vtkIsopointBlock>& blocks, std::size_t skipped)
{
  this->Kept->Findings.CountSamples(blocks, skipped);
  this->NumberOfSkippedSamples += static_cast<vtkIdType>(skipped);
  for (const vtkIsopointBlock& block : blocks)
  {
    this->NumberOfSkippedSamples -= block.NumberOfUnusedIds;
  }
}

std::vector<double> vtkScatteredIsopointFilter::ExpectProgress(std::size_t count, bool isTreeKept)
{
  const isopoint::ExtractionRequest request = vtkMakeIsopointRequest(this);
  std::vector<double> ends{ isTreeKept ? 0.0 : isopoint::IsosurfaceExtractor::loadingWork(count) };
  for (std::size_t i = 0; i < this->GetIsovalues().size(); ++i)
  {
    ends.push_back(ends.back() + isopoint::IsosurfaceExtractor::extractionWork(
                                   count, request, isTreeKept || i > 0));
  }
  const double all = std::max(ends.back(), 1.0);
  std::transform(ends.begin(), ends.end(), ends.begin(), [all](double end) { return end / all; });
  return ends;
}

std::set<double> vtkScatteredIsopointFilter::GetIsovalues()
{
  const double* const values = this->ContourValues->GetValues();
  return { values, values + this->ContourValues->GetNumberOfContours() };
}

std::vector<isopoint::ExtractedIsosurface> vtkScatteredIsopointFilter::ExtractIsovalues(
  const Execution& execution, KeptTree& kept, const std::vector<double>& progress)
{
  isopoint::ExtractionRequest request = vtkMakeIsopointRequest(this);
  request.ghostRings = this->Kept->GhostLevels;
  const bool hasGhosts =
    this->Kept->Link && this->Kept->GhostLevels > 0 && !this->ExtractsTriangles();
  const std::set<double> isovalues = this->GetIsovalues();
  std::vector<isopoint::ExtractedIsosurface> surfaces;
  std::vector<isopoint::ExtractedIsosurface> ghosts(hasGhosts ? isovalues.size() : 0);
  surfaces.reserve(isovalues.size() + ghosts.size());
  for (const double isovalue : isovalues)
  {
    const std::size_t i = surfaces.size();
    request.isosurface.isovalue = isovalue;
    surfaces.push_back(
      kept.Extractor.extract(isopoint::partOf(execution, progress[i], progress[i + 1]), request,
        hasGhosts ? &ghosts[i] : nullptr));
    this->Kept->Findings.Points[i] += surfaces.back().countHere();
    this->NumberOfDroppedInGaps += static_cast<vtkIdType>(surfaces.back().droppedInGaps);
    if (!this->Kept->Link)
    {
      isopoint::throwIfAborted(execution);
    }
  }
  std::move(ghosts.begin(), ghosts.end(), std::back_inserter(surfaces));
  return surfaces;
}

void vtkScatteredIsopointFilter::FillOutput(const Execution& execution,
  const vtkIsopointEndSamples& samples, const std::vector<isopoint::ExtractedIsosurface>& surfaces,
  bool haveFloatPositions, vtkPolyData* output)
{
  const bool isSingle =
    this->OutputPointsPrecision == vtkAlgorithm::SINGLE_PRECISION ||
    (this->OutputPointsPrecision == vtkAlgorithm::DEFAULT_PRECISION && haveFloatPositions);
  const vtkSmartPointer<vtkPoints> points =
    vtkNewIsopointPositions(surfaces, isSingle ? VTK_FLOAT : VTK_DOUBLE);
  const vtkIdType count = points->GetNumberOfPoints();
  output->SetPoints(points);
  if (this->ExtractsTriangles())
  {
    output->SetPolys(vtkNewIsopointTriangles(surfaces));
  }
  else
  {
    output->SetVerts(vtkNewIsopointVertices(count));
  }

  vtkPointData* const pointData = output->GetPointData();
  vtkInterpolateIsopointArrays(
    execution, samples.GetAttributes(), samples.GetScalars(), surfaces, pointData);
  if (this->ComputeScalars)
  {
    vtkAddContouredArray(samples.GetScalars(), surfaces, pointData);
  }

  vtkIsopointComputedArrays computed(vtkChooseIsopointArrays(this), count);
  for (const isopoint::ExtractedIsosurface& surface : surfaces)
  {
    computed.Append(surface);
    isopoint::throwIfAborted(execution);
  }
  this->NumberOfUnprojectedPoints += this->Projection == NO_PROJECTION
                                       ? computed.GetNumberCounted()
                                       : computed.GetNumberWithoutFit();
  if (this->Kept->Link && this->Kept->GhostLevels > 0)
  {
    vtkAddIsopointGhosts(surfaces, output);
  }
  for (const std::string& name : computed.AddTo(pointData))
  {
    this->Kept->Findings.ReplacedArrays.insert(name);
  }
}

void vtkScatteredIsopointFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto onOff = [](vtkTypeBool flag) { return flag ? "On" : "Off"; };
  os << indent << "Contour values:\n";
  this->ContourValues->PrintSelf(os, indent.GetNextIndent());
  os << indent << "Angle: " << this->Angle << "\n";
  os << indent << "DropGaps: " << (this->DropGaps ? "On" : "Off") << "\n";
  os << indent << "MinimumSpacing: " << this->MinimumSpacing << "\n";
  os << indent << "ComputeNormals: " << onOff(this->ComputeNormals) << "\n";
  os << indent << "ComputeSplats: " << onOff(this->ComputeSplats) << "\n";
  os << indent << "ComputeScalars: " << onOff(this->ComputeScalars) << "\n";
  os << indent << "NumberOfNeighbors: " << this->NumberOfNeighbors << "\n";
  os << indent << "Projection: " << this->Projection << "\n";
  os << indent << "NormalMethod: " << this->NormalMethod << "\n";
  os << indent << "ComputeGradients: " << onOff(this->ComputeGradients) << "\n";
  os << indent << "ComputeProjectionOrders: " << onOff(this->ComputeProjectionOrders) << "\n";
  os << indent << "NumberOfUnprojectedPoints: " << this->NumberOfUnprojectedPoints << "\n";
  os << indent << "NumberOfDroppedInGaps: " << this->NumberOfDroppedInGaps << "\n";
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
  os << indent << "ContourBlocks: " << onOff(this->ContourBlocks) << "\n";
  os << indent << "KeepTree: " << onOff(this->KeepTree) << "\n";
  os << indent << "UseAllCores: " << onOff(this->UseAllCores) << "\n";
  os << indent << "NumberOfSkippedSamples: " << this->NumberOfSkippedSamples << "\n";
}
