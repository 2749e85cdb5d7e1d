// SPDX-License-Identifier: GPL-3.0-or-later
#include "Update/vtkIsopointContouring.h"

#include "Core/Contour.h"
#include "Input/vtkIsopointInput.h"
#include "Input/vtkIsopointStructure.h"
#include "Output/vtkIsopointEndSamples.h"
#include "Output/vtkIsopointOutput.h"
#include "Output/vtkIsopointOutputArrays.h"
#include "Update/vtkIsopointUpdate.h"

#include "vtkCellArray.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>

vtkIsopointContouring::vtkIsopointContouring(vtkIsopointUpdate& update)
  : Update(update)
{
}

vtkIsopointContouring::~vtkIsopointContouring() = default;

void vtkIsopointContouring::Run(const vtkIsopointOptions& options, vtkInformation* inputInfo,
  vtkInformation* inputArray, vtkInformation* outputInfo)
{
  this->Options = options; // they may change meanwhile
  this->Update.Run(
    vtkDataObject::GetData(outputInfo),
    [this]()
    {
      if (this->Report.pointCount() > 0)
      {
        this->SurfaceOf = this->State;
      }
      this->Report = isopoint::Report();
    },
    [&]() { this->Extract(inputInfo, inputArray, outputInfo); },
    [this](isopoint::OptionNaming naming)
    { return isopoint::describeReport(this->Report, naming); });
}

void vtkIsopointContouring::Extract(
  vtkInformation* inputInfo, vtkInformation* inputArray, vtkInformation* outputInfo)
{
  this->Options.Core = isopoint::effectiveOptions(this->Options.Core);
  // Small bands of many blocks would add up.
  this->Options.Core.keepTetrahedra = this->Update.KeepsTrees() && !this->Options.ContourBlocks;
  vtkDataObject* const input = vtkDataObject::GetData(inputInfo);
  vtkDataObject* const output = vtkDataObject::GetData(outputInfo);
  const std::vector<double> isovalues = isopoint::sortedIsovalues(this->Options.GetValues());
  const vtkIsopointArrayChoice array(inputArray);
  isopoint::checkOptions(this->Options.Core, this->Update.GetOptionNaming());
  this->Update.CheckOptionsOnRanks(array.Describe() + this->Options.Describe(), "contour");
  isopoint::ProcessGroup& processes = this->Update.GetProcesses();
  this->GhostLevels = this->Update.GetGhostLevels(outputInfo);

  this->Update.CollectBlocks(inputInfo, array);
  this->StartCounting(isovalues);
  const vtkIsopointStructure structure = this->Options.ContourBlocks
                                           ? vtkMergeIsopointStructures(processes, input)
                                           : vtkIsopointStructure();
  if (structure.IsComposite())
  {
    this->ExtractLeaves(structure, input, vtkCompositeDataSet::SafeDownCast(output));
  }
  else
  {
    this->Update.DropTrees(1);
    this->ExtractBlocks(this->Update.GetExecution(), 0, this->Update.GetInput().GetBlocks().size(),
      0, vtkPolyData::SafeDownCast(output));
  }
  this->Report.share(processes);
  this->Report.isPieceOfProcess = this->Update.TakePiece(outputInfo, output);
}

void vtkIsopointContouring::StartCounting(const std::vector<double>& isovalues)
{
  const vtkIsopointBlocks& blocks = this->Update.GetInput();
  isopoint::Report counts(this->Options.Core, isovalues);
  counts.withoutArray = static_cast<std::uint64_t>(blocks.GetNumberOfPointsWithoutArray());
  counts.samples = counts.withoutArray;
  const char* const name =
    blocks.GetBlocks().empty() ? nullptr : blocks.GetBlocks().front().Scalars->GetName();
  counts.array = name ? name : "";
  counts.contoursBlocks = this->Options.ContourBlocks && blocks.GetBlocks().size() > 1;
  this->State = blocks.GetState(0, blocks.GetBlocks().size());
  counts.hadSurface = !this->State.empty() && this->State == this->SurfaceOf;
  this->Report = std::move(counts);
}

void vtkIsopointContouring::ExtractLeaves(
  const vtkIsopointStructure& structure, vtkDataObject* input, vtkCompositeDataSet* output)
{
  const std::vector<vtkIsopointBlock>& blocks = this->Update.GetInput().GetBlocks();
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
  this->Update.GetProcesses().maximum(isHeld); // by any rank
  this->Update.DropTrees(surfaces.size());
  const double share =
    1.0 / static_cast<double>(std::accumulate(isHeld.begin(), isHeld.end(), std::uint64_t{ 0 }));
  double done = 0.0;
  for (std::size_t leaf = 0; leaf < surfaces.size(); ++leaf)
  {
    if (isHeld[leaf] != 0)
    {
      const isopoint::Execution part =
        isopoint::partOf(this->Update.GetExecution(), share * done, share * (done + 1.0));
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

void vtkIsopointContouring::ExtractBlocks(const isopoint::Execution& execution, std::size_t begin,
  std::size_t end, std::size_t tree, vtkPolyData* output)
{
  vtkIsopointCloud& cloud = this->Update.FindCloud(begin, end, tree);
  // Shares of the progress, in units of an isovalue's.
  const double loading = cloud.IsLoaded ? 0.0 : 0.1;
  constexpr double writing = 0.1;
  const double sum = loading + static_cast<double>(this->Report.isovalues.size()) + writing;
  this->Update.Load(isopoint::partOf(execution, 0.0, loading / sum), cloud);
  this->Report.countSamples(cloud.Extractor, vtkCountIsopointSamples(cloud.Blocks));
  std::vector<isopoint::ExtractedIsosurface> surfaces =
    isopoint::extractIsovalues(isopoint::partOf(execution, loading / sum, 1.0 - writing / sum),
      cloud.Extractor, this->Options.Core, this->GhostLevels, this->Report);
  const vtkIsopointEndSamples samples(this->Update.GetProcesses(), cloud.Blocks, surfaces);
  this->FillOutput(samples, surfaces, cloud.Types.areFloatPositions, output);
  execution.progress(1.0);
}

void vtkIsopointContouring::FillOutput(const vtkIsopointEndSamples& samples,
  const std::vector<isopoint::ExtractedIsosurface>& surfaces, bool areFloatPositions,
  vtkPolyData* output)
{
  const bool isSingle = isopoint::isSinglePrecision(this->Options.Core, areFloatPositions);
  const vtkSmartPointer<vtkPoints> points = vtkNewIsopointPositions(
    this->Update.GetExecution(), surfaces, isSingle ? VTK_FLOAT : VTK_DOUBLE);
  const vtkIdType count = points->GetNumberOfPoints();
  output->SetPoints(points);
  if (this->Options.Core.triangles)
  {
    output->SetPolys(vtkNewIsopointTriangles(this->Update.GetExecution(), surfaces));
    if (this->Options.Core.capping)
    {
      vtkAddIsopointCaps(surfaces, output);
    }
  }
  else
  {
    output->SetVerts(vtkNewIsopointVertices(count));
  }

  vtkPointData* const pointData = output->GetPointData();
  vtkInterpolateIsopointArrays(this->Update.GetExecution(), samples.GetAttributes(),
    samples.GetScalars(), surfaces, pointData);
  if (this->Options.ComputeScalars)
  {
    vtkAddContouredArray(samples.GetScalars(), surfaces, pointData);
  }

  if (this->Update.IsOnRanks() && this->GhostLevels > 0)
  {
    vtkAddIsopointGhosts(surfaces, output);
  }
  for (const std::string& name :
    vtkAddComputedIsopointArrays(this->Update.GetExecution(), this->Options.Core, surfaces, output))
  {
    this->Report.replacedArrays.insert(name);
  }
}
