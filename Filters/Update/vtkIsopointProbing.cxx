// SPDX-License-Identifier: GPL-3.0-or-later
#include "Update/vtkIsopointProbing.h"

#include "Common/vtkIsopointArrays.h"
#include "Core/Base/Execution.h"
#include "Core/Base/Region.h"
#include "Core/Base/Vector.h"
#include "Core/Failure.h"
#include "Input/vtkIsopointInput.h"
#include "Input/vtkIsopointNumbers.h"
#include "Output/vtkIsopointSampleArrays.h"
#include "Update/vtkIsopointUpdate.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <mutex>

vtkIsopointProbing::vtkIsopointProbing(vtkIsopointUpdate& update)
  : Update(update)
{
}

vtkIsopointProbing::~vtkIsopointProbing() = default;

void vtkIsopointProbing::Run(vtkDataObject* output, const std::function<void()>& work)
{
  this->Update.Run(
    output, [this]() { this->Report = ProbeReport(); }, work,
    [this](isopoint::OptionNaming) { return this->Describe(); });
  this->Cloud = nullptr;
}

void vtkIsopointProbing::Load(
  vtkInformation* inputInfo, const vtkIsopointArrayChoice& array, const std::string& options)
{
  this->Update.CheckOptionsOnRanks(options, "probe");
  this->Update.CollectBlocks(inputInfo, array);
  const vtkIsopointBlocks& input = this->Update.GetInput();
  this->Cloud = &this->Update.FindCloud(0, input.GetBlocks().size(), 0);
  this->Loaded = this->Cloud->IsLoaded ? 0.0 : 0.2;
  this->Update.Load(isopoint::partOf(this->Update.GetExecution(), 0.0, this->Loaded), *this->Cloud);

  isopoint::SampleCounts& samples = this->Report.Samples;
  samples.withoutArray = static_cast<std::uint64_t>(input.GetNumberOfPointsWithoutArray());
  samples.samples = samples.withoutArray;
  if (array.GetRole() != vtkIsopointArrayChoice::NoArray && !this->Cloud->Blocks.empty())
  {
    const char* const name = array.Find(this->Cloud->Blocks.front().Attributes)->GetName();
    samples.array = name ? name : "";
  }
  samples.count(this->Cloud->Extractor, vtkCountIsopointSamples(this->Cloud->Blocks));
  samples.share(this->Update.GetProcesses());
}

const std::vector<vtkIsopointBlock>& vtkIsopointProbing::GetBlocks() const
{
  return this->Cloud->Blocks;
}

namespace
{

/// The bounding box of a block's samples that are in use.
isopoint::Region boxOf(const isopoint::Execution& execution, const vtkIsopointBlock& block)
{
  const vtkIsopointPositions positions(block.Positions);
  isopoint::Region box = isopoint::emptyRegion;
  std::mutex mutex;
  constexpr std::size_t grain = 65536;
  isopoint::forBatches(execution, static_cast<std::size_t>(block.GetNumberOfSamples()), 16 * grain,
    grain,
    [&](std::size_t begin, std::size_t end)
    {
      isopoint::Region part = isopoint::emptyRegion;
      for (std::size_t i = begin; i < end; ++i)
      {
        isopoint::Vector position;
        positions(i, position.data());
        const bool isExcluded = block.Ghosts && (block.Ghosts->GetValue(static_cast<vtkIdType>(i)) &
                                                  vtkIsopointBlock::Excluding) != 0;
        if (!isExcluded && isopoint::isFinite(position))
        {
          part = isopoint::united(part, { position, position });
        }
      }
      const std::lock_guard<std::mutex> lock(mutex);
      box = isopoint::united(box, part);
    });
  return box;
}

} // namespace

void vtkIsopointProbing::FindBounds(double bounds[6]) const
{
  isopoint::Region box = isopoint::emptyRegion;
  for (const vtkIsopointBlock& block : this->GetBlocks())
  {
    box = isopoint::united(box, boxOf(this->Update.GetExecution(), block));
  }
  isopoint::ProcessGroup& processes = this->Update.GetProcesses();
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds[2 * axis] =
      isopoint::fromOrderedKey(~processes.maximum(~isopoint::orderedKey(box.lower[axis])));
    bounds[2 * axis + 1] =
      isopoint::fromOrderedKey(processes.maximum(isopoint::orderedKey(box.upper[axis])));
  }
  if (bounds[0] > bounds[1])
  {
    throw isopoint::UsageError(
      "All samples are hidden or have no finite position. Connect samples with finite positions.");
  }
}

void vtkIsopointProbing::Probe(const std::vector<isopoint::Vector>& places,
  const isopoint::ProbeOptions& options, const std::vector<isopoint::ProbedArray>& arrays,
  std::vector<std::uint8_t>& kinds)
{
  kinds.resize(places.size());
  this->Cloud->Extractor.probe(isopoint::partOf(this->Update.GetExecution(), this->Loaded, 1.0),
    places, options, arrays, kinds.data());
  const auto count = [&](std::uint8_t kind)
  {
    return this->Update.GetProcesses().sum(static_cast<std::uint64_t>(std::count_if(
      kinds.begin(), kinds.end(), [kind](std::uint8_t bits) { return (bits & kind) != 0; })));
  };
  this->Report.Places = this->Update.GetProcesses().sum(std::uint64_t{ places.size() });
  this->Report.Outside = count(isopoint::PlaceOutside);
  this->Report.Flat = count(isopoint::PlaceFlat);
}

std::vector<vtkIsopointProbing::Array> vtkIsopointProbing::ProbeAll(
  const std::vector<isopoint::Vector>& places, const isopoint::ProbeOptions& options,
  const std::set<std::string>* chosen, const std::vector<std::string>& nearest,
  const std::set<std::string>& own, bool isOutsideHidden, std::vector<std::uint8_t>& kinds)
{
  this->Report.IsOutsideLost =
    isOutsideHidden || options.outside == isopoint::OutsideStrategy::Number;
  isopoint::ProcessGroup& processes = this->Update.GetProcesses();
  std::vector<vtkIsopointSampleArray> arrays =
    vtkListIsopointArrays(processes, this->GetBlocks(), nearest, this->Report.NotCommon);
  this->Report.HasArrays = !arrays.empty();
  if (chosen)
  {
    const auto isLeftOut = [&](const std::string& name) { return chosen->count(name) == 0; };
    arrays.erase(std::remove_if(arrays.begin(), arrays.end(),
                   [&](const vtkIsopointSampleArray& array) { return isLeftOut(array.Name); }),
      arrays.end());
    if (arrays.empty())
    {
      throw isopoint::UsageError("The samples have none of the chosen arrays. Choose others.");
    }
    std::set<std::string>& others = this->Report.NotCommon;
    for (auto name = others.begin(); name != others.end();)
    {
      name = isLeftOut(*name) ? others.erase(name) : std::next(name);
    }
  }
  const auto isOwn = [&](const vtkIsopointSampleArray& array)
  { return own.count(array.Name) > 0 && this->Report.Replaced.insert(array.Name).second; };
  arrays.erase(std::remove_if(arrays.begin(), arrays.end(), isOwn), arrays.end());
  const std::vector<vtkSmartPointer<vtkAbstractArray>> results =
    vtkProbeIsopointArrays(processes, arrays, this->GetBlocks(), options, places.size(),
      [&](const std::vector<isopoint::ProbedArray>& probed)
      { this->Probe(places, options, probed, kinds); });
  std::vector<Array> found;
  for (std::size_t i = 0; i < results.size(); ++i)
  {
    found.push_back({ results[i], arrays[i].Attribute });
  }
  return found;
}

vtkIsopointSampleArray vtkIsopointProbing::FindArray(const vtkIsopointArrayChoice& choice)
{
  vtkIsopointSampleArray found =
    vtkFindIsopointArray(this->Update.GetProcesses(), this->GetBlocks(), choice);
  found.Name = this->Report.Samples.array;
  if (found.Components == 0)
  {
    throw isopoint::UsageError(
      "The array \"" + found.Name +
      "\" has different numbers of components in the blocks of the input. Choose another one.");
  }
  return found;
}

vtkSmartPointer<vtkDoubleArray> vtkIsopointProbing::FindGradients(
  const vtkIsopointSampleArray& array, const std::vector<isopoint::Vector>& places,
  const isopoint::ProbeOptions& options)
{
  isopoint::ProbedArray probed;
  vtkReadIsopointArray(array, this->GetBlocks(), probed);
  const auto components = static_cast<std::size_t>(array.Components);
  std::vector<double> values(components * places.size());
  auto gradients = vtkSmartPointer<vtkDoubleArray>::New();
  gradients->SetNumberOfComponents(3 * array.Components);
  vtkAllocateTuples(gradients, static_cast<vtkIdType>(places.size()));
  probed.values = values.data();
  probed.gradients = gradients->GetPointer(0);
  std::vector<std::uint8_t> kinds;
  this->Probe(places, options, { probed }, kinds);
  this->Report.AreGradients = true;
  const auto isFinite = [](double number) { return std::isfinite(number); };
  std::uint64_t without = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const double* const gradient = probed.gradients + 3 * components * i;
    without += std::all_of(places[i].begin(), places[i].end(), isFinite) &&
               std::any_of(gradient, gradient + 3 * components,
                 [](double derivative) { return std::isnan(derivative); });
  }
  this->Report.WithoutGradient = this->Update.GetProcesses().sum(without);
  return gradients;
}

std::vector<isopoint::Message> vtkIsopointProbing::Describe() const
{
  using isopoint::Message;
  const ProbeReport& report = this->Report;
  std::vector<Message> messages;
  const Message skipped = isopoint::describeSkipped(report.Samples,
    "There are no values. Connect samples with finite positions.",
    report.AreGradients ? "Gradients are those of the other samples."
                        : "Values there are those of the samples around.");
  if (!skipped.text.empty())
  {
    messages.push_back(skipped);
  }
  const std::string places = " of " + std::to_string(report.Places) + " points ";
  const bool areUsed = report.Samples.skippedCount() < report.Samples.samples;
  if (!areUsed && skipped.text.empty() && !report.AreGradients)
  {
    messages.push_back({ "no samples", "All samples are excluded. Include some." });
  }
  if (!report.HasArrays && report.NotCommon.empty())
  {
    messages.push_back({ "no arrays",
      "The samples have no arrays, nor has the output. Load arrays in the reader." });
  }
  if (areUsed && report.Places > 0 && report.Outside == report.Places && report.IsOutsideLost)
  {
    messages.push_back({ "all outside",
      "All " + std::to_string(report.Places) +
        " points are outside of the samples, where there are no values. Move them among the"
        " samples." });
  }
  if (report.Flat > 0)
  {
    messages.push_back({ "flat",
      "At " + std::to_string(report.Flat) + places +
        "the samples around are in a plane or on a line: " +
        (report.AreGradients ? "gradients have no part across."
                             : "values are those at the nearest point of it."),
      report.AreGradients && report.Flat == report.Places ? Message::Warning : Message::Note });
  }
  if (report.WithoutGradient > 0)
  {
    messages.push_back({ "no gradient",
      std::to_string(report.WithoutGradient) + places +
        "have no gradient: no samples around are in use and have finite values. Choose another"
        " array, or show hidden samples.",
      report.WithoutGradient == report.Places ? Message::Warning : Message::Note });
  }
  if (!report.Replaced.empty())
  {
    messages.push_back(vtkDescribeLeftOut(report.Replaced,
      "The output has an array of its own with this name. Rename that of the samples."));
  }
  if (!report.NotCommon.empty())
  {
    messages.push_back(vtkDescribeLeftOut(report.NotCommon,
      "Only arrays of numbers and text are kept that all blocks have, with the same components."));
  }
  return messages;
}
