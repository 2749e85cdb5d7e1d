// SPDX-License-Identifier: GPL-3.0-or-later
#include "Update/vtkIsopointSlicing.h"

#include "Common/vtkIsopointArrays.h"
#include "Core/Contour.h"
#include "Core/Failure.h"
#include "Core/OutputArrays.h"
#include "Core/Places/ProbeRequest.h"
#include "Input/vtkIsopointInput.h"
#include "Input/vtkIsopointNumbers.h"
#include "Output/vtkIsopointCut.h"
#include "Output/vtkIsopointEndSamples.h"
#include "Output/vtkIsopointOutput.h"
#include "Output/vtkIsopointOutputArrays.h"
#include "Output/vtkIsopointPiece.h"
#include "Output/vtkIsopointSampleArrays.h"
#include "Update/vtkIsopointUpdate.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkImplicitFunction.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <set>
#include <sstream>
#include <string>

namespace
{

// Shares of the progress: where the function is evaluated, the tree loaded, triangles extracted.
constexpr double evaluated = 0.05;
constexpr double loaded = 0.2;
constexpr double extracted = 0.5;

/// The number of samples of a block with a finite position and a value that is not.
std::uint64_t countLacking(const isopoint::Execution& execution, const vtkIsopointBlock& block)
{
  const vtkIsopointPositions positions(block.Positions);
  const vtkIsopointNumbers values(block.Scalars);
  std::atomic<std::uint64_t> lacking{ 0 };
  isopoint::forEachIndex(execution, static_cast<std::size_t>(block.GetNumberOfSamples()),
    [&](std::size_t i)
    {
      if (!std::isfinite(values(i)))
      {
        isopoint::Vector position;
        positions(i, position.data());
        lacking += isopoint::isFinite(position) ? 1 : 0;
      }
    });
  return lacking;
}

} // namespace

vtkIsopointSlicing::vtkIsopointSlicing(vtkIsopointUpdate& update)
  : Update(update)
{
}

vtkIsopointSlicing::~vtkIsopointSlicing() = default;

isopoint::Options vtkIsopointSlicing::OptionsOfCore()
{
  isopoint::Options options;
  options.triangles = true;
  options.projection = 0;
  options.computeNormals = false;
  options.computeSplats = false;
  return options;
}

void vtkIsopointSlicing::Run(
  const Options& options, vtkInformation* inputInfo, vtkInformation* outputInfo)
{
  const auto clear = [this]()
  {
    this->Report = isopoint::Report();
    this->Dropped.clear();
  };
  const bool isDone = this->Update.Run(
    vtkDataObject::GetData(outputInfo), clear,
    [&]() { this->Slice(options, inputInfo, outputInfo); },
    [this](isopoint::OptionNaming naming) { return this->Describe(naming); });
  if (!isDone || !this->Update.KeepsTrees())
  {
    this->Values.clear();
    this->ValuesOf.clear();
  }
}

void vtkIsopointSlicing::Slice(
  Options options, vtkInformation* inputInfo, vtkInformation* outputInfo)
{
  options.Core.keepTetrahedra = this->Update.KeepsTrees();
  if (!options.Function && !options.Core.capping)
  {
    throw isopoint::UsageError("There is no cut function. Set a plane or another one.");
  }
  const vtkIsopointCut cut(options.Function);
  cut.Check();
  isopoint::checkOptions(options.Core, this->Update.GetOptionNaming());
  const int method = options.Method ? static_cast<int>(*options.Method) : -1;
  std::string described = std::to_string(method) + options.Describe();
  for (const std::string& name : options.Nearest)
  {
    described += " \"" + name + "\"";
  }
  this->Update.CheckOptionsOnRanks(described, options.Core.capping ? "find the body of" : "slice");
  const int ghostLevels = this->Update.GetGhostLevels(outputInfo);

  vtkIsopointCloud& cloud = this->Load(cut, inputInfo);
  std::vector<double> isovalues = options.GetValues();
  std::transform(isovalues.begin(), isovalues.end(), isovalues.begin(),
    [&](double offset) { return cut.GetLevel() + offset; });
  this->Report = isopoint::Report(options.Core, isopoint::sortedIsovalues(isovalues));
  this->Report.countSamples(cloud.Extractor, vtkCountIsopointSamples(cloud.Blocks));

  std::vector<isopoint::ExtractedIsosurface> surfaces = isopoint::extractIsovalues(
    isopoint::partOf(this->Update.GetExecution(), loaded, options.Method ? extracted : 1.0),
    cloud.Extractor, options.Core, ghostLevels, this->Report);
  auto* const output = vtkPolyData::SafeDownCast(vtkDataObject::GetData(outputInfo));
  this->FillOutput(options, cut, cloud, surfaces, output);
  if (ghostLevels > 0)
  {
    vtkAddIsopointGhosts(surfaces, output);
  }
  this->Report.share(this->Update.GetProcesses());
  this->Update.GetExecution().progress(1.0);
  this->Report.isPieceOfProcess = this->Update.TakePiece(outputInfo, output);
}

/// @throws isopoint::UsageError if the function is not finite at a sample with a finite position
void vtkIsopointSlicing::CheckValues(const vtkIsopointCloud& cloud)
{
  std::uint64_t lacking = 0;
  if (this->ValuesOf != cloud.State) // otherwise they were checked
  {
    for (const vtkIsopointBlock& block : cloud.Blocks)
    {
      lacking += countLacking(this->Update.GetExecution(), block);
    }
    this->ValuesOf = cloud.State;
  }
  lacking = this->Update.GetProcesses().sum(lacking);
  const std::uint64_t all =
    this->Update.GetProcesses().sum(vtkCountIsopointSamples(cloud.Blocks).items);
  if (lacking > 0)
  {
    throw isopoint::UsageError("The cut function is not finite at " + std::to_string(lacking) +
                               " of " + std::to_string(all) +
                               " samples. Choose one that is finite everywhere.");
  }
}

/// Compares the functions of the ranks, at some samples of each.
void vtkIsopointSlicing::CheckFunctionOnRanks(
  const vtkIsopointCut& cut, const vtkIsopointCloud& cloud)
{
  if (!this->Update.IsOnRanks())
  {
    return;
  }
  constexpr vtkIdType ofBlock = 8;
  std::vector<double> own;
  for (const vtkIsopointBlock& block : cloud.Blocks)
  {
    const vtkIsopointPositions positions(block.Positions);
    const vtkIdType count = block.GetNumberOfSamples();
    for (vtkIdType i = 0; i < std::min(ofBlock, count); ++i)
    {
      own.resize(own.size() + 3);
      positions(static_cast<std::size_t>(i * count / ofBlock), &own[own.size() - 3]);
    }
  }
  std::ostringstream text;
  text << std::hexfloat << cut.GetLevel() + 0.0;
  for (const std::vector<double>& places : this->Update.GetProcesses().gather(own))
  {
    for (std::size_t i = 0; i < places.size(); i += 3)
    {
      text << " " << cut.Evaluate({ places[i], places[i + 1], places[i + 2] }) + 0.0;
    }
  }
  this->Update.CheckOptionsOnRanks(text.str(), "slice");
}

vtkIsopointCloud& vtkIsopointSlicing::Load(const vtkIsopointCut& cut, vtkInformation* inputInfo)
{
  this->Update.CollectBlocks(inputInfo, vtkIsopointArrayChoice());
  vtkIsopointCloud& cloud =
    this->Update.FindCloud(0, this->Update.GetInput().GetBlocks().size(), 0, cut.GetState());
  this->CheckFunctionOnRanks(cut, cloud);
  cloud.Types.areFloatValues = false;
  if (this->ValuesOf != cloud.State)
  {
    this->Values.clear();
    for (const vtkIsopointBlock& block : cloud.Blocks)
    {
      this->Values.push_back(
        cut.FindValues(isopoint::partOf(this->Update.GetExecution(), 0.0, evaluated), block));
    }
  }
  for (std::size_t i = 0; i < cloud.Blocks.size(); ++i)
  {
    cloud.Blocks[i].Scalars = this->Values[i];
  }
  this->CheckValues(cloud);
  this->Update.Load(isopoint::partOf(this->Update.GetExecution(), evaluated, loaded), cloud);
  return cloud;
}

void vtkIsopointSlicing::FillOutput(const Options& options, const vtkIsopointCut& cut,
  vtkIsopointCloud& cloud, std::vector<isopoint::ExtractedIsosurface>& surfaces,
  vtkPolyData* output)
{
  const isopoint::Execution& execution = this->Update.GetExecution();
  const vtkIsopointEndSamples samples(this->Update.GetProcesses(), cloud.Blocks, surfaces,
    cut.IsPlane() ? vtkIsopointEndSamples::Values : vtkIsopointEndSamples::Positions);
  const bool isSingle = isopoint::isSinglePrecision(options.Core, cloud.Types.areFloatPositions);
  output->SetPoints(
    vtkNewIsopointPositions(execution, surfaces, isSingle ? VTK_FLOAT : VTK_DOUBLE));
  output->SetPolys(vtkNewIsopointTriangles(execution, surfaces));
  vtkInterpolateIsopointArrays(
    execution, samples.GetAttributes(), samples.GetScalars(), surfaces, output->GetPointData());
  if (!cut.IsPlane())
  {
    cut.MovePoints(execution, surfaces, samples, output);
  }
  std::set<std::string> others;
  std::vector<vtkIsopointSampleArray> arrays =
    vtkListIsopointArrays(this->Update.GetProcesses(), cloud.Blocks, options.Nearest, others);
  std::copy_if(others.begin(), others.end(), std::inserter(this->Dropped, this->Dropped.end()),
    [&](const std::string& name) { return !output->GetPointData()->HasArray(name.c_str()); });
  if (!options.Method)
  {
    arrays.erase(std::remove_if(arrays.begin(), arrays.end(),
                   [](const vtkIsopointSampleArray& array) { return !array.IsNearest; }),
      arrays.end());
  }
  if (!options.Core.capping && !arrays.empty())
  {
    this->Fit(options, arrays, cloud, output);
  }
}

/// Replaces arrays by those of a method, where it has values. Fits extrapolate at rims: edges of
/// slivers on the convex hull are far too long for linear interpolation.
void vtkIsopointSlicing::Fit(const Options& sliceOptions,
  const std::vector<vtkIsopointSampleArray>& arrays, vtkIsopointCloud& cloud, vtkPolyData* output)
{
  std::vector<isopoint::Vector> places(static_cast<std::size_t>(output->GetNumberOfPoints()));
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    output->GetPoint(static_cast<vtkIdType>(i), places[i].data());
  }
  isopoint::ProbeOptions options;
  options.method = sliceOptions.Method.value_or(isopoint::PlaceMethod::Nearest);
  options.outside = isopoint::OutsideStrategy::Extrapolate;
  const std::vector<vtkSmartPointer<vtkAbstractArray>> found = vtkProbeIsopointArrays(
    this->Update.GetProcesses(), arrays, cloud.Blocks, options, places.size(),
    [&](const std::vector<isopoint::ProbedArray>& probed)
    {
      cloud.Extractor.probe(
        isopoint::partOf(this->Update.GetExecution(), extracted, 1.0), places, options, probed);
    });
  for (std::size_t i = 0; i < arrays.size(); ++i)
  {
    if (arrays[i].IsNearest)
    {
      vtkAddAttribute(arrays[i].Attribute, found[i], output->GetPointData());
      continue;
    }
    vtkDataArray* const array = output->GetPointData()->GetArray(found[i]->GetName());
    if (array)
    {
      vtkReplaceIsopointNumbers(vtkDataArray::SafeDownCast(found[i]), array);
    }
  }
}

std::vector<isopoint::Message> vtkIsopointSlicing::Describe(isopoint::OptionNaming naming) const
{
  std::vector<isopoint::Message> messages = isopoint::describeReport(this->Report, naming);
  if (!this->Dropped.empty())
  {
    messages.push_back(vtkDescribeLeftOut(
      this->Dropped, "Only arrays are kept that all blocks have, with the same components."));
  }
  return messages;
}
