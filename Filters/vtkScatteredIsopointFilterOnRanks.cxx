// SPDX-License-Identifier: GPL-3.0-or-later
// What the filter does on one of several ranks.
#include "vtkScatteredIsopointFilter.h"

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Base/Team.h"
#include "Isopoint/IsosurfaceExtractor.h"
#include "vtkIsopointBlock.h"
#include "vtkIsopointBlocks.h"
#include "vtkIsopointEndSamples.h"
#include "vtkIsopointExecution.h"
#include "vtkIsopointFindings.h"
#include "vtkIsopointInput.h"
#include "vtkIsopointInputState.h"
#include "vtkIsopointOptions.h"
#include "vtkIsopointRanks.h"
#include "vtkIsopointStructure.h"
#include "vtkIsopointUsageError.h"
#include "vtkScatteredIsopointFilterInternals.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkMultiProcessController.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

using isopoint::Execution;

void vtkScatteredIsopointFilter::ConnectRanks()
{
  vtkMultiProcessController* const controller = this->Kept->Controller;
  const bool isShared = controller && controller->GetNumberOfProcesses() > 1;
  const bool wasShared = this->Kept->Link != nullptr;
  if (isShared != wasShared || (isShared && this->Kept->Link->GetController() != controller))
  {
    this->Kept->Clear(); // what is kept belongs to other ranks
    this->Kept->Link = isShared ? std::make_unique<vtkIsopointCommunicator>(controller) : nullptr;
    this->Kept->Team = isShared ? std::make_unique<isopoint::Team>(*this->Kept->Link) : nullptr;
  }
}

void vtkScatteredIsopointFilter::ExtractOnRanks(vtkDataObject* input, vtkDataObject* output)
{
  isopoint::Team& team = *this->Kept->Team;
  const Execution execution =
    vtkMakeIsopointExecution(this, this->UseAllCores != 0, vtkCountIsopointRanksOnHost(team));
  team.together([this]() { vtkCheckIsopointOptions(this); });
  vtkCheckIsopointOptionsOnRanks(team, this);
  this->CollectOnRanks(team, execution, input);
  this->Kept->GhostLevels =
    static_cast<int>(team.maximum(static_cast<std::uint64_t>(this->Kept->GhostLevels)));
  const vtkIsopointBlocks& blocks = this->Kept->Input;
  team.together([this]() { this->StartCounting(); });
  const vtkIsopointStructure structure =
    this->ContourBlocks ? vtkMergeIsopointStructures(team, input) : vtkIsopointStructure();
  if (structure.IsComposite())
  {
    this->ExtractLeavesOnRanks(team, execution, structure, input, output);
  }
  else
  {
    this->Kept->Trees.erase(this->Kept->Trees.upper_bound(0), this->Kept->Trees.end());
    this->ExtractBlocksOnRanks(
      team, execution, 0, blocks.GetBlocks().size(), 0, vtkPolyData::SafeDownCast(output));
  }
  this->NumberOfSkippedSamples =
    static_cast<vtkIdType>(team.sum(static_cast<std::uint64_t>(this->NumberOfSkippedSamples)));
  this->NumberOfUnprojectedPoints =
    static_cast<vtkIdType>(team.sum(static_cast<std::uint64_t>(this->NumberOfUnprojectedPoints)));
  this->NumberOfDroppedInGaps =
    static_cast<vtkIdType>(team.sum(static_cast<std::uint64_t>(this->NumberOfDroppedInGaps)));
  vtkShareIsopointFindings(team, blocks.GetBlocks(), this->Kept->Findings);
}

void vtkScatteredIsopointFilter::ExtractLeavesOnRanks(isopoint::Team& team,
  const Execution& execution, const vtkIsopointStructure& structure, vtkDataObject* input,
  vtkDataObject* output)
{
  const std::vector<vtkIsopointBlock>& blocks = this->Kept->Input.GetBlocks();
  std::vector<std::size_t> blockOf; // of each leaf, or behind the last one
  std::vector<std::uint64_t> isHeld;
  std::vector<vtkSmartPointer<vtkPolyData>> surfaces;
  team.together(
    [&]()
    {
      const std::vector<std::size_t> numbers = structure.GetNumbersOf(input);
      surfaces.resize(structure.GetNumberOfLeaves());
      blockOf.resize(surfaces.size(), blocks.size());
      isHeld.resize(surfaces.size(), 0);
      for (std::size_t i = 0; i < blocks.size(); ++i)
      {
        blockOf[numbers[blocks[i].Leaf]] = i;
        isHeld[numbers[blocks[i].Leaf]] = 1;
      }
    });
  team.maximum(isHeld); // by any rank
  this->Kept->Trees.erase(this->Kept->Trees.lower_bound(surfaces.size()), this->Kept->Trees.end());
  const double share =
    1.0 / static_cast<double>(std::accumulate(isHeld.begin(), isHeld.end(), std::uint64_t{ 0 }));
  double done = 0.0;
  for (std::size_t leaf = 0; leaf < surfaces.size(); ++leaf)
  {
    if (isHeld[leaf] != 0)
    {
      this->SetProgressShiftScale(share * done++, share);
      const std::size_t block = blockOf[leaf];
      team.together([&]() { surfaces[leaf] = vtkSmartPointer<vtkPolyData>::New(); });
      this->ExtractBlocksOnRanks(
        team, execution, block, std::min(block + 1, blocks.size()), leaf, surfaces[leaf]);
    }
  }
  team.together(
    [&]() { structure.Fill(input, surfaces, vtkCompositeDataSet::SafeDownCast(output)); });
}

void vtkScatteredIsopointFilter::ExtractBlocksOnRanks(isopoint::Team& team,
  const Execution& execution, std::size_t begin, std::size_t end, std::size_t tree,
  vtkPolyData* output)
{
  const vtkIsopointBlocks& collected = this->Kept->Input;
  std::vector<vtkIsopointBlock> blocks;
  vtkIsopointInputState state;
  bool isNew = true;
  KeptTree* kept = nullptr;
  team.together(
    [&]()
    {
      const auto all = collected.GetBlocks().begin();
      blocks.assign(
        all + static_cast<std::ptrdiff_t>(begin), all + static_cast<std::ptrdiff_t>(end));
      kept = &this->Kept->Trees[tree];
      state = collected.GetState(begin, end);
      state.push_back(static_cast<vtkMTimeType>(blocks.size())); // never as if nothing was loaded
      isNew = state != kept->LoadedFrom;
    });
  isNew = team.isAny(isNew);
  std::vector<double> progress;
  team.together(
    [&]()
    {
      std::size_t count = kept->Extractor.sampleCount();
      for (const vtkIsopointBlock& block : blocks)
      {
        count = std::max(count, static_cast<std::size_t>(block.GetNumberOfSamples()));
      }
      progress = this->ExpectProgress(count, !isNew);
      kept->LoadedFrom.clear();
    });
  if (isNew)
  {
    vtkLoadIsopointInputOnRanks(
      isopoint::partOf(execution, 0.0, progress.front()), blocks, team, kept->Extractor);
  }
  this->CountSkippedSamples(blocks, kept->Extractor.skippedCount());
  std::vector<isopoint::ExtractedIsosurface> surfaces =
    this->ExtractIsovalues(execution, *kept, progress);
  const vtkIsopointEndSamples samples(team, blocks, surfaces);
  const bool haveFloatPositions = !team.isAny(!vtkHaveFloatPositions(blocks));
  team.together(
    [&]()
    {
      this->FillOutput(execution, samples, surfaces, haveFloatPositions, output);
      kept->LoadedFrom = state;
    });
  this->UpdateProgress(1.0);
}

void vtkScatteredIsopointFilter::CollectOnRanks(
  isopoint::Team& team, const Execution& execution, vtkDataObject* input)
{
  std::string nothing; // why this rank has no blocks
  team.together(
    [&]()
    {
      try
      {
        this->Kept->Input.Collect(execution, input,
          vtkIsopointArrayChoice(this->GetInputArrayInformation(0)),
          this->GetInputInformation(0, 0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()));
      }
      catch (const vtkIsopointNothingError& error)
      {
        nothing = error.what();
      }
    });
  if (team.isAny(nothing.empty()))
  {
    return;
  }
  // A rank that has points without the array knows what there is to choose from.
  const bool hasPoints = this->Kept->Input.GetNumberOfPointsWithoutArray() > 0;
  const bool isAnyWithPoints = team.isAny(hasPoints);
  team.together(
    [&]()
    {
      if (hasPoints == isAnyWithPoints)
      {
        throw vtkIsopointUsageError(nothing);
      }
    });
}
