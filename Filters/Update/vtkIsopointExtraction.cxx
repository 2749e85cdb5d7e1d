// SPDX-License-Identifier: GPL-3.0-or-later
#include "Update/vtkIsopointExtraction.h"

#include "Input/vtkIsopointBlock.h"
#include "Input/vtkIsopointInput.h"
#include "Input/vtkIsopointStructure.h"
#include "Input/vtkIsopointUsageError.h"
#include "Output/vtkIsopointComputedArrays.h"
#include "Output/vtkIsopointEndSamples.h"
#include "Output/vtkIsopointInterpolatedArrays.h"
#include "Output/vtkIsopointOutput.h"
#include "Output/vtkIsopointPiece.h"
#include "Update/vtkIsopointExecution.h"
#include "Update/vtkIsopointFindings.h"
#include "Update/vtkIsopointOptions.h"
#include "Update/vtkIsopointRanks.h"

#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <string>
#include <utility>

vtkIsopointExtraction::vtkIsopointExtraction(vtkAlgorithm* filter, isopoint::Team& team,
  const vtkIsopointOptions& options, Kept& kept, vtkIsopointFindings& findings)
  : Filter(filter)
  , Team(team)
  , Options(options)
  , State(kept)
  , Findings(findings)
  , Execution(
      vtkMakeIsopointExecution(filter, options.UseAllCores, vtkCountIsopointRanksOnCores(team)))
{
}

void vtkIsopointExtraction::Run(vtkInformation* inputInfo, vtkInformation* outputInfo)
{
  vtkDataObject* const input = vtkDataObject::GetData(inputInfo);
  vtkDataObject* const output = vtkDataObject::GetData(outputInfo);
  this->Options.Check();
  this->Options.CheckOnRanks(this->Team);
  auto* const levels = vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS();
  const int requested = outputInfo->Has(levels) ? std::max(outputInfo->Get(levels), 0) : 0;
  this->GhostLevels = static_cast<int>(this->Team.maximum(static_cast<std::uint64_t>(requested)));

  this->CollectBlocks(input,
    this->IsOnRanks() ? inputInfo->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()) : nullptr);
  this->StartCounting();
  const vtkIsopointStructure structure = this->Options.ContourBlocks
                                           ? vtkMergeIsopointStructures(this->Team, input)
                                           : vtkIsopointStructure();
  if (structure.IsComposite())
  {
    this->ExtractLeaves(structure, input, vtkCompositeDataSet::SafeDownCast(output));
  }
  else
  {
    this->State.Trees.erase(this->State.Trees.upper_bound(0), this->State.Trees.end());
    this->ExtractBlocks(
      0, this->State.Input.GetBlocks().size(), 0, vtkPolyData::SafeDownCast(output));
  }
  this->Findings.Share(this->Team);
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
    this->Findings.IsPieceOfProcess = piece == 0 && vtkHasOtherProcesses();
  }
}

void vtkIsopointExtraction::CollectBlocks(vtkDataObject* input, const int* wholeExtent)
{
  vtkIsopointBlocks& blocks = this->State.Input;
  std::string nothing; // why this rank has no blocks
  try
  {
    blocks.Collect(this->Execution, input, this->Options.Array, wholeExtent);
  }
  catch (const vtkIsopointNothingError& error)
  {
    nothing = error.what();
  }
  if (this->Team.isAny(nothing.empty()))
  {
    return;
  }
  // No rank has samples. One that has points without the array knows what there is to choose from,
  // and reports that; the others learn of it at their next collective step.
  const bool hasPoints = blocks.GetNumberOfPointsWithoutArray() > 0;
  if (this->Team.isAny(hasPoints) == hasPoints)
  {
    throw vtkIsopointUsageError(nothing);
  }
}

void vtkIsopointExtraction::StartCounting()
{
  const vtkIsopointBlocks& blocks = this->State.Input;
  this->Findings.Start(this->Options);
  this->Findings.WithoutArray = static_cast<std::uint64_t>(blocks.GetNumberOfPointsWithoutArray());
  this->Findings.Samples = this->Findings.WithoutArray;
  const char* const name =
    blocks.GetBlocks().empty() ? nullptr : blocks.GetBlocks().front().Scalars->GetName();
  this->Findings.Array = name ? name : "";
}

void vtkIsopointExtraction::ExtractLeaves(
  const vtkIsopointStructure& structure, vtkDataObject* input, vtkCompositeDataSet* output)
{
  const std::vector<vtkIsopointBlock>& blocks = this->State.Input.GetBlocks();
  const std::vector<std::size_t> numbers = structure.GetNumbersOf(input);
  std::vector<vtkSmartPointer<vtkPolyData>> surfaces(structure.GetNumberOfLeaves());
  // Where this rank has no block it is `blocks.size()`.
  std::vector<std::size_t> blockOf(surfaces.size(), blocks.size());
  std::vector<std::uint64_t> isHeld(surfaces.size(), 0);
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    blockOf[numbers[blocks[i].Leaf]] = i;
    isHeld[numbers[blocks[i].Leaf]] = 1;
  }
  this->Team.maximum(isHeld); // by any rank
  this->State.Trees.erase(this->State.Trees.lower_bound(surfaces.size()), this->State.Trees.end());
  const double share =
    1.0 / static_cast<double>(std::accumulate(isHeld.begin(), isHeld.end(), std::uint64_t{ 0 }));
  double done = 0.0;
  for (std::size_t leaf = 0; leaf < surfaces.size(); ++leaf)
  {
    if (isHeld[leaf] != 0)
    {
      this->Filter->SetProgressShiftScale(share * done++, share);
      const std::size_t block = blockOf[leaf];
      surfaces[leaf] = vtkSmartPointer<vtkPolyData>::New();
      this->ExtractBlocks(block, std::min(block + 1, blocks.size()), leaf, surfaces[leaf]);
    }
  }
  if (output) // null where this rank has nothing in place of the others' composite
  {
    structure.Fill(input, surfaces, output);
  }
}

void vtkIsopointExtraction::ExtractBlocks(
  std::size_t begin, std::size_t end, std::size_t tree, vtkPolyData* output)
{
  const auto all = this->State.Input.GetBlocks().begin();
  const std::vector<vtkIsopointBlock> blocks(
    all + static_cast<std::ptrdiff_t>(begin), all + static_cast<std::ptrdiff_t>(end));
  KeptTree& kept = this->State.Trees[tree];
  vtkIsopointInputState state = this->State.Input.GetState(begin, end);
  // So that it is never empty, as that of a tree that was not loaded.
  state.push_back(static_cast<vtkMTimeType>(blocks.size()));
  const bool isNew = this->Team.isAny(state != kept.LoadedFrom);
  const std::size_t count = std::accumulate(blocks.begin(), blocks.end(), std::size_t{ 0 },
    [](std::size_t sum, const vtkIsopointBlock& block)
    { return sum + static_cast<std::size_t>(block.GetNumberOfSamples()); });
  const std::vector<double> progress = this->ExpectProgress(count, !isNew);
  if (isNew)
  {
    kept.LoadedFrom.clear();
    vtkLoadIsopointInput(
      isopoint::partOf(this->Execution, 0.0, progress.front()), this->Team, blocks, kept.Extractor);
    kept.LoadedFrom = std::move(state);
  }
  this->Findings.CountSamples(blocks, kept.Extractor);
  std::vector<isopoint::ExtractedIsosurface> surfaces =
    this->ExtractIsovalues(kept.Extractor, progress);
  const vtkIsopointEndSamples samples(this->Team, blocks, surfaces);
  const bool haveFloatPositions = !this->Team.isAny(!vtkHaveFloatPositions(blocks));
  this->FillOutput(samples, surfaces, haveFloatPositions, output);
  this->Filter->UpdateProgress(1.0);
}

std::vector<double> vtkIsopointExtraction::ExpectProgress(std::size_t count, bool isTreeKept)
{
  using isopoint::IsosurfaceExtractor;
  const isopoint::ExtractionRequest request = this->Options.GetRequest();
  std::vector<double> ends{ isTreeKept ? 0.0 : IsosurfaceExtractor::loadingWork(count) };
  for (std::size_t i = 0; i < this->Findings.Isovalues.size(); ++i)
  {
    ends.push_back(
      ends.back() + IsosurfaceExtractor::extractionWork(count, request, isTreeKept || i > 0));
  }
  const double all = std::max(ends.back(), 1.0);
  std::transform(ends.begin(), ends.end(), ends.begin(), [all](double end) { return end / all; });
  return ends;
}

std::vector<isopoint::ExtractedIsosurface> vtkIsopointExtraction::ExtractIsovalues(
  isopoint::IsosurfaceExtractor& extractor, const std::vector<double>& progress)
{
  const std::vector<double>& isovalues = this->Findings.Isovalues;
  isopoint::ExtractionRequest request = this->Options.GetRequest();
  request.ghostRings = this->GhostLevels;
  const bool hasGhosts = this->IsOnRanks() && this->GhostLevels > 0 && !request.triangles;
  std::vector<isopoint::ExtractedIsosurface> surfaces;
  std::vector<isopoint::ExtractedIsosurface> ghosts(hasGhosts ? isovalues.size() : 0);
  surfaces.reserve(isovalues.size() + ghosts.size());
  for (std::size_t i = 0; i < isovalues.size(); ++i)
  {
    request.isosurface.isovalue = isovalues[i];
    // Small ones of many blocks would add up.
    request.isosurface.keepsBand =
      i + 1 < isovalues.size() || (this->Options.KeepTree && !this->Options.ContourBlocks);
    surfaces.push_back(
      extractor.extract(isopoint::partOf(this->Execution, progress[i], progress[i + 1]), request,
        hasGhosts ? &ghosts[i] : nullptr));
    this->Findings.Points[i] += surfaces.back().countHere();
    this->Findings.DroppedInGaps += surfaces.back().droppedInGaps;
    isopoint::throwIfAborted(this->Execution);
  }
  std::move(ghosts.begin(), ghosts.end(), std::back_inserter(surfaces));
  return surfaces;
}

void vtkIsopointExtraction::FillOutput(const vtkIsopointEndSamples& samples,
  const std::vector<isopoint::ExtractedIsosurface>& surfaces, bool haveFloatPositions,
  vtkPolyData* output)
{
  const int precision = this->Options.OutputPointsPrecision;
  const bool isSingle = precision == vtkAlgorithm::SINGLE_PRECISION ||
                        (precision == vtkAlgorithm::DEFAULT_PRECISION && haveFloatPositions);
  const vtkSmartPointer<vtkPoints> points =
    vtkNewIsopointPositions(this->Execution, surfaces, isSingle ? VTK_FLOAT : VTK_DOUBLE);
  const vtkIdType count = points->GetNumberOfPoints();
  output->SetPoints(points);
  if (this->Options.Triangles)
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

  vtkIsopointComputedArrays computed(this->Options.GetArrays(), count);
  for (const isopoint::ExtractedIsosurface& surface : surfaces)
  {
    computed.Append(this->Execution, surface);
    this->Findings.UnprojectedPoints += this->Findings.AreProjected ? 0 : surface.countHere();
    isopoint::throwIfAborted(this->Execution);
  }
  if (this->Findings.AreProjected)
  {
    this->Findings.UnprojectedPoints += static_cast<std::uint64_t>(computed.GetNumberWithoutFit());
  }
  if (this->IsOnRanks() && this->GhostLevels > 0)
  {
    vtkAddIsopointGhosts(surfaces, output);
  }
  for (const std::string& name : computed.AddTo(output))
  {
    this->Findings.ReplacedArrays.insert(name);
  }
}
