// SPDX-License-Identifier: GPL-3.0-or-later
#include "Update/vtkIsopointExtraction.h"

#include "Core/Base/UsageError.h"
#include "Core/Contour.h"
#include "Input/vtkIsopointBlock.h"
#include "Input/vtkIsopointInput.h"
#include "Input/vtkIsopointStructure.h"
#include "Output/vtkIsopointComputedArrays.h"
#include "Output/vtkIsopointEndSamples.h"
#include "Output/vtkIsopointInterpolatedArrays.h"
#include "Output/vtkIsopointOutput.h"
#include "Output/vtkIsopointPiece.h"
#include "Update/vtkIsopointExecution.h"
#include "Update/vtkIsopointRanks.h"

#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkCompositeDataSet.h"
#include "vtkContourValues.h"
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
#include <numeric>
#include <string>
#include <utility>

vtkIsopointExtraction::vtkIsopointExtraction(vtkAlgorithm* filter, isopoint::Team& team,
  const vtkIsopointOptions& options, Kept& kept, isopoint::Report& report)
  : Filter(filter)
  , Team(team)
  , Options(options)
  , State(kept)
  , Report(report)
  , Execution(
      vtkMakeIsopointExecution(filter, options.UseAllCores, vtkCountIsopointRanksOnCores(team)))
{
  this->Options.Core = isopoint::effectiveOptions(options.Core);
  // Small bands of many blocks would add up.
  this->Options.Core.keepBand = options.KeepTree && !options.ContourBlocks;
}

void vtkIsopointExtraction::Run(vtkInformation* inputInfo, vtkInformation* outputInfo)
{
  vtkDataObject* const input = vtkDataObject::GetData(inputInfo);
  vtkDataObject* const output = vtkDataObject::GetData(outputInfo);
  vtkContourValues* const values = this->Options.ContourValues;
  const std::vector<double> isovalues = isopoint::sortedIsovalues(
    { values->GetValues(), values->GetValues() + values->GetNumberOfContours() });
  const vtkIsopointArrayChoice array(this->Filter->GetInputArrayInformation(0));
  isopoint::checkOptions(this->Options.Core);
  vtkCheckIsopointOptionsOnRanks(this->Team, this->Options, isovalues, array);
  auto* const levels = vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS();
  const int requested = outputInfo->Has(levels) ? std::max(outputInfo->Get(levels), 0) : 0;
  this->GhostLevels = static_cast<int>(this->Team.maximum(static_cast<std::uint64_t>(requested)));

  this->CollectBlocks(input, array,
    this->IsOnRanks() ? inputInfo->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()) : nullptr);
  this->StartCounting(isovalues);
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
    this->ExtractBlocks(this->Execution, 0, this->State.Input.GetBlocks().size(), 0,
      vtkPolyData::SafeDownCast(output));
  }
  this->Report.share(this->Team);
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
    this->Report.isPieceOfProcess = piece == 0 && vtkHasOtherProcesses();
  }
}

void vtkIsopointExtraction::CollectBlocks(
  vtkDataObject* input, const vtkIsopointArrayChoice& array, const int* wholeExtent)
{
  vtkIsopointBlocks& blocks = this->State.Input;
  std::string nothing; // why this rank has no blocks
  try
  {
    blocks.Collect(this->Execution, input, array, wholeExtent);
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
    throw isopoint::UsageError(nothing);
  }
}

void vtkIsopointExtraction::StartCounting(const std::vector<double>& isovalues)
{
  const vtkIsopointBlocks& blocks = this->State.Input;
  isopoint::Report counts(this->Options.Core, isovalues);
  counts.withoutArray = static_cast<std::uint64_t>(blocks.GetNumberOfPointsWithoutArray());
  counts.samples = counts.withoutArray;
  const char* const name =
    blocks.GetBlocks().empty() ? nullptr : blocks.GetBlocks().front().Scalars->GetName();
  counts.array = name ? name : "";
  counts.contoursBlocks = this->Options.ContourBlocks;
  this->Report = std::move(counts);
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
      const isopoint::Execution part =
        isopoint::partOf(this->Execution, share * done, share * (done + 1.0));
      const std::size_t block = blockOf[leaf];
      surfaces[leaf] = vtkSmartPointer<vtkPolyData>::New();
      this->ExtractBlocks(part, block, std::min(block + 1, blocks.size()), leaf, surfaces[leaf]);
      ++done;
    }
  }
  if (output) // null where this rank has nothing in place of the others' composite
  {
    structure.Fill(input, surfaces, output);
  }
}

void vtkIsopointExtraction::ExtractBlocks(const isopoint::Execution& execution, std::size_t begin,
  std::size_t end, std::size_t tree, vtkPolyData* output)
{
  const auto all = this->State.Input.GetBlocks().begin();
  const std::vector<vtkIsopointBlock> blocks(
    all + static_cast<std::ptrdiff_t>(begin), all + static_cast<std::ptrdiff_t>(end));
  KeptTree& kept = this->State.Trees[tree];
  vtkIsopointInputState state = this->State.Input.GetState(begin, end);
  // So that it is never empty, as that of a tree that was not loaded.
  state.push_back(static_cast<vtkMTimeType>(blocks.size()));
  const bool isNew = this->Team.isAny(state != kept.LoadedFrom);
  const isopoint::SampleTypes types = vtkGetIsopointSampleTypes(blocks).sharedBy(this->Team);
  // Shares of the progress, where that of an isovalue is 1.
  const double loading = isNew ? 0.1 : 0.0;
  constexpr double writing = 0.1;
  const double sum = loading + static_cast<double>(this->Report.isovalues.size()) + writing;
  if (isNew)
  {
    kept.LoadedFrom.clear();
    vtkLoadIsopointInput(
      isopoint::partOf(execution, 0.0, loading / sum), this->Team, types, blocks, kept.Extractor);
    kept.LoadedFrom = std::move(state);
  }
  this->Report.countSamples(kept.Extractor, vtkCountIsopointSamples(blocks));
  std::vector<isopoint::ExtractedIsosurface> surfaces =
    isopoint::extractIsovalues(isopoint::partOf(execution, loading / sum, 1.0 - writing / sum),
      kept.Extractor, this->Options.Core, this->GhostLevels, this->Report);
  const vtkIsopointEndSamples samples(this->Team, blocks, surfaces);
  this->FillOutput(samples, surfaces, types.areFloatPositions, output);
  execution.progress(1.0);
}

void vtkIsopointExtraction::FillOutput(const vtkIsopointEndSamples& samples,
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
