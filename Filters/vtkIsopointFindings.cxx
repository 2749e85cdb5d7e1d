// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointFindings.h"

#include "Isopoint/Base/Team.h"
#include "vtkIsopointBlock.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkType.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <sstream>

namespace
{

constexpr unsigned char excluding =
  vtkDataSetAttributes::DUPLICATEPOINT | vtkDataSetAttributes::HIDDENPOINT;

bool isExcluded(const vtkIsopointBlock& block, vtkIdType sample)
{
  return block.Ghosts && (block.Ghosts->GetValue(sample) & excluding) != 0;
}

bool isFinite(const vtkIsopointBlock& block, vtkIdType sample)
{
  double position[3];
  block.Positions->GetPoint(sample, position);
  return std::isfinite(position[0]) && std::isfinite(position[1]) && std::isfinite(position[2]);
}

/// Numbers that are ordered as doubles are: ranks compare such.
std::uint64_t orderedBits(double value)
{
  constexpr std::uint64_t sign = std::uint64_t{ 1 } << 63;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return (bits & sign) != 0 ? ~bits : bits | sign;
}

double fromOrderedBits(std::uint64_t ordered)
{
  constexpr std::uint64_t sign = std::uint64_t{ 1 } << 63;
  const std::uint64_t bits = (ordered & sign) != 0 ? ordered & ~sign : ~ordered;
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

std::string describeArray(const vtkIsopointFindings& findings)
{
  return findings.Array.empty() ? "the array" : "the array \"" + findings.Array + "\"";
}

std::string join(const std::vector<std::string>& parts)
{
  std::string all;
  for (const std::string& part : parts)
  {
    all += (all.empty() ? "" : ", ") + part;
  }
  return all;
}

std::string describeIsovalues(const vtkIsopointFindings& findings)
{
  std::vector<std::string> outside;
  for (std::size_t i = 0; i < findings.Isovalues.size(); ++i)
  {
    const double value = findings.Isovalues[i];
    if (findings.Points[i] == 0 && (value <= findings.Least || value > findings.Greatest))
    {
      std::ostringstream text;
      text << value;
      outside.push_back(text.str());
    }
  }
  if (outside.empty() || findings.Least > findings.Greatest)
  {
    return {};
  }
  std::ostringstream message;
  if (findings.Least == findings.Greatest)
  {
    message << "There is no isosurface: all values of " << describeArray(findings) << " are "
            << findings.Least << ". Choose another array.";
    return message.str();
  }
  message << (outside.size() > 1 ? "The isovalues " : "The isovalue ") << join(outside)
          << (outside.size() > 1 ? " have" : " has") << " no points: the values of "
          << describeArray(findings) << " are from " << findings.Least << " to "
          << findings.Greatest << ". Choose " << (outside.size() > 1 ? "isovalues" : "one")
          << " in between.";
  return message.str();
}

std::string describeSkipped(const vtkIsopointFindings& findings)
{
  if (findings.NotFinite + findings.WithoutArray == 0)
  {
    return {};
  }
  std::vector<std::string> reasons;
  const auto add = [&reasons](std::uint64_t count, const std::string& reason)
  {
    if (count > 0)
    {
      reasons.push_back(std::to_string(count) + " " + reason);
    }
  };
  add(findings.NotFinite, "with a coordinate or value that is not finite");
  add(findings.WithoutArray, "of blocks without " + describeArray(findings));
  add(findings.Ghosts, "ghost or hidden");
  return std::to_string(findings.NotFinite + findings.WithoutArray + findings.Ghosts) + " of " +
         std::to_string(findings.Samples) + " samples were skipped: " + join(reasons) +
         ". Where they are, the surface is that of the samples around. Remove them from the input"
         " if that is meant.";
}

std::string describeUnprojected(const vtkIsopointFindings& findings)
{
  const auto points =
    std::accumulate(findings.Points.begin(), findings.Points.end(), std::uint64_t{ 0 });
  if (2 * findings.UnprojectedPoints <= points)
  {
    return {};
  }
  return std::to_string(findings.UnprojectedPoints) + " of " + std::to_string(points) +
         " points are where linear interpolation places them: around them no fit holds, as in"
         " strong noise or where samples are few or on lines. Smooth the samples first, or set the"
         " projection to none, which is faster.";
}

} // namespace

void vtkIsopointFindings::Start(const std::set<double>& isovalues)
{
  *this = vtkIsopointFindings();
  this->Isovalues.assign(isovalues.begin(), isovalues.end());
  this->Points.assign(isovalues.size(), 0);
}

void vtkIsopointFindings::CountSamples(
  const std::vector<vtkIsopointBlock>& blocks, std::size_t skipped)
{
  this->NotFinite += skipped;
  for (const vtkIsopointBlock& block : blocks)
  {
    const vtkIdType count = block.GetNumberOfSamples();
    vtkIdType excluded = 0;
    for (vtkIdType i = 0; block.Ghosts && i < count; ++i)
    {
      excluded += isExcluded(block, i) ? 1 : 0;
    }
    this->NotFinite -= static_cast<std::uint64_t>(excluded);
    this->Ghosts += static_cast<std::uint64_t>(excluded - block.NumberOfUnusedIds);
    this->Samples += static_cast<std::uint64_t>(count - block.NumberOfUnusedIds);
  }
}

void vtkFindIsopointRange(
  const std::vector<vtkIsopointBlock>& blocks, vtkIsopointFindings& findings)
{
  if (std::all_of(findings.Points.begin(), findings.Points.end(),
        [](std::uint64_t count) { return count > 0; }))
  {
    return;
  }
  for (const vtkIsopointBlock& block : blocks)
  {
    const vtkIdType count = block.GetNumberOfSamples();
    for (vtkIdType i = 0; i < count; ++i)
    {
      const double value = block.Scalars->GetComponent(i, 0);
      const bool isWider = value < findings.Least || value > findings.Greatest;
      if (isWider && std::isfinite(value) && !isExcluded(block, i) && isFinite(block, i))
      {
        findings.Least = std::min(findings.Least, value);
        findings.Greatest = std::max(findings.Greatest, value);
      }
    }
  }
}

void vtkShareIsopointFindings(
  isopoint::Team& team, const std::vector<vtkIsopointBlock>& blocks, vtkIsopointFindings& findings)
{
  team.sum(findings.Points); // of as many isovalues on all ranks
  for (std::uint64_t* const count : { &findings.UnprojectedPoints, &findings.Samples,
         &findings.NotFinite, &findings.Ghosts, &findings.WithoutArray })
  {
    *count = team.sum(*count);
  }
  team.together([&]() { vtkFindIsopointRange(blocks, findings); });
  findings.Least = fromOrderedBits(~team.maximum(~orderedBits(findings.Least)));
  findings.Greatest = fromOrderedBits(team.maximum(orderedBits(findings.Greatest)));
}

std::vector<std::string> vtkDescribeIsopointFindings(const vtkIsopointFindings& findings)
{
  std::vector<std::string> messages;
  for (const std::string& message :
    { describeIsovalues(findings), describeSkipped(findings), describeUnprojected(findings) })
  {
    if (!message.empty())
    {
      messages.push_back(message);
    }
  }
  return messages;
}
