// SPDX-License-Identifier: GPL-3.0-or-later
#include "Update/vtkIsopointFindings.h"

#include "Core/Base/Team.h"
#include "Core/IsosurfaceExtractor.h"
#include "Input/vtkIsopointBlock.h"
#include "Update/vtkIsopointOptions.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <limits>
#include <numeric>
#include <sstream>

namespace
{

std::string describeArray(const vtkIsopointFindings& findings)
{
  return findings.Array.empty() ? "the array" : "\"" + findings.Array + "\"";
}

std::string textOf(double number, int digits)
{
  std::ostringstream text;
  text << std::setprecision(digits) << number;
  return text.str();
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

std::string join(const std::vector<double>& numbers, int digits)
{
  std::vector<std::string> texts;
  std::transform(numbers.begin(), numbers.end(), std::back_inserter(texts),
    [digits](double number) { return textOf(number, digits); });
  return join(texts);
}

/// A share, so coarse that it is the same as long as nothing much changes.
std::string tenths(std::uint64_t count, std::uint64_t all)
{
  constexpr std::uint64_t parts = 10;
  return std::to_string(parts * count / std::max<std::uint64_t>(all, 1)) + " of 10";
}

/// So many digits that the isovalues and the ends of the range look different if they are.
int digitsFor(const vtkIsopointFindings& findings, const std::vector<double>& isovalues)
{
  constexpr int few = 6;
  for (int digits = few; digits < std::numeric_limits<double>::max_digits10; ++digits)
  {
    const auto lookAlike = [digits](double a, double b)
    { return a != b && textOf(a, digits) == textOf(b, digits); };
    if (!lookAlike(findings.Least, findings.Greatest) &&
        std::none_of(isovalues.begin(), isovalues.end(),
          [&](double isovalue) {
            return lookAlike(isovalue, findings.Least) || lookAlike(isovalue, findings.Greatest);
          }))
    {
      return digits;
    }
  }
  return std::numeric_limits<double>::max_digits10;
}

vtkIsopointMessage describeIsovaluesOutside(
  const vtkIsopointFindings& findings, const std::vector<double>& outside)
{
  if (outside.empty())
  {
    return {};
  }
  const int digits = digitsFor(findings, outside);
  const std::string least = textOf(findings.Least, digits);
  if (findings.Least == findings.Greatest)
  {
    return { "constant array " + findings.Array, "No isosurface: all values of " +
                                                   describeArray(findings) + " are " + least +
                                                   ". Choose another array." };
  }
  const std::string isovalues = join(outside, digits);
  return { "isovalues outside of " + findings.Array + ": " + isovalues,
    "No isosurface at " + isovalues + ": " + describeArray(findings) + " is from " + least +
      " to " + textOf(findings.Greatest, digits) + ". Choose isovalues that are greater than " +
      least + ", up to " + textOf(findings.Greatest, digits) + "." };
}

/// Of isovalues in the range.
vtkIsopointMessage describeEmptyIsovalues(
  const vtkIsopointFindings& findings, const std::vector<double>& empty)
{
  if (empty.empty())
  {
    return {};
  }
  const std::string isovalues = join(empty, digitsFor(findings, empty));
  std::string reason = "all of it is in gaps between samples. Turn DropGaps off.";
  if (findings.AreTriangles)
  {
    reason = findings.DropsGaps
               ? "all of it is in gaps, or the samples are in one plane. Turn DropGaps off; for"
                 " samples in a plane apply Delaunay 2D and Contour instead."
               : "the samples are in one plane. Apply Delaunay 2D and Contour instead.";
  }
  else if (!findings.DropsGaps)
  {
    reason = "no block has samples on both sides. Turn ContourBlocks off.";
  }
  return { "isovalues without points in " + findings.Array + ": " + isovalues,
    "No isosurface at " + isovalues + ": " + reason };
}

std::vector<vtkIsopointMessage> describeIsovalues(const vtkIsopointFindings& findings)
{
  std::vector<double> outside;
  std::vector<double> empty;
  for (std::size_t i = 0; i < findings.Isovalues.size(); ++i)
  {
    const double value = findings.Isovalues[i];
    if (findings.Points[i] == 0 && findings.Least <= findings.Greatest)
    {
      const bool isInside = value > findings.Least && value <= findings.Greatest;
      (isInside ? empty : outside).push_back(value);
    }
  }
  return { describeIsovaluesOutside(findings, outside), describeEmptyIsovalues(findings, empty) };
}

vtkIsopointMessage describeSkipped(const vtkIsopointFindings& findings)
{
  if (findings.NotFinite + findings.WithoutArray == 0)
  {
    return {};
  }
  const std::vector<std::pair<std::uint64_t, std::string>> reasons{
    { findings.NotFinite, "not finite" },
    { findings.WithoutArray, "in blocks without " + describeArray(findings) },
    { findings.Ghosts, "ghost or hidden" },
  };
  const std::uint64_t skipped = findings.GetNumberOfSkippedSamples();
  std::vector<std::string> parts;
  for (const auto& [count, reason] : reasons)
  {
    if (count > 0)
    {
      parts.push_back(count < skipped ? std::to_string(count) + " " + reason : reason);
    }
  }
  const std::string cause =
    "samples skipped of " + findings.Array + ": " + tenths(skipped, findings.Samples);
  const std::string text = "Skipped " + std::to_string(skipped) + " of " +
                           std::to_string(findings.Samples) + " samples: " + join(parts) + ".";
  if (skipped == findings.Samples)
  {
    return { cause, text + " There is no isosurface. Choose another array." };
  }
  return { cause, text + " The surface there is that of the samples around.",
    vtkIsopointMessage::NOTE };
}

vtkIsopointMessage describeUnprojected(const vtkIsopointFindings& findings)
{
  const std::uint64_t points = findings.GetNumberOfPoints();
  if (!findings.AreProjected || 2 * findings.UnprojectedPoints <= points)
  {
    return {};
  }
  return { "points without fit of " + findings.Array + ": " +
             tenths(findings.UnprojectedPoints, points),
    "No fit holds at " + std::to_string(findings.UnprojectedPoints) + " of " +
      std::to_string(points) +
      " points: the surface may be rough. Smooth the values if they are noisy. For samples on a"
      " surface, such as a plane or a shell, set Projection to None. Samples along lines, such as"
      " drill holes, do not determine a surface." };
}

std::vector<vtkIsopointMessage> describeReplacedArrays(const vtkIsopointFindings& findings)
{
  std::vector<vtkIsopointMessage> messages;
  for (const std::string& name : findings.ReplacedArrays)
  {
    messages.push_back({ "replaced array " + name,
      "The computed array \"" + name +
        "\" replaces the input array of this name. To keep that, rename it or switch the computed"
        " array off." });
  }
  return messages;
}

vtkIsopointMessage describePieces(const vtkIsopointFindings& findings)
{
  if (!findings.IsPieceOfProcess)
  {
    return {};
  }
  return { "pieces of processes",
    "Each process yields a piece of the surface of its own samples. If the processes have"
    " different samples, call SetController() with the global controller." };
}

} // namespace

void vtkIsopointFindings::Start(const vtkIsopointOptions& options)
{
  *this = vtkIsopointFindings();
  const std::set<double> isovalues = options.GetSortedIsovalues();
  this->Isovalues.assign(isovalues.begin(), isovalues.end());
  this->Points.assign(isovalues.size(), 0);
  this->AreTriangles = options.Triangles;
  this->DropsGaps = options.DropGaps;
  this->AreProjected = options.Projection != 0;
}

std::uint64_t vtkIsopointFindings::GetNumberOfPoints() const
{
  return std::accumulate(this->Points.begin(), this->Points.end(), std::uint64_t{ 0 });
}

std::uint64_t vtkIsopointFindings::GetNumberOfSkippedSamples() const
{
  return this->NotFinite + this->Ghosts + this->WithoutArray;
}

void vtkIsopointFindings::CountSamples(
  const std::vector<vtkIsopointBlock>& blocks, const isopoint::IsosurfaceExtractor& extractor)
{
  this->NotFinite += extractor.skippedCount();
  const auto [least, greatest] = extractor.valueRange();
  this->Least = std::min(this->Least, least);
  this->Greatest = std::max(this->Greatest, greatest);
  for (const vtkIsopointBlock& block : blocks)
  {
    this->NotFinite -= static_cast<std::uint64_t>(block.NumberOfExcluded);
    this->Ghosts += static_cast<std::uint64_t>(block.NumberOfExcluded - block.NumberOfUnusedIds);
    this->Samples +=
      static_cast<std::uint64_t>(block.GetNumberOfSamples() - block.NumberOfUnusedIds);
  }
}

void vtkIsopointFindings::Share(isopoint::Team& team)
{
  team.sum(this->Points); // of as many isovalues on all ranks
  for (std::uint64_t* const count : { &this->UnprojectedPoints, &this->DroppedInGaps,
         &this->Samples, &this->NotFinite, &this->Ghosts, &this->WithoutArray })
  {
    *count = team.sum(*count);
  }
  const std::vector<std::vector<char>> names =
    team.gather(std::vector<char>(this->Array.begin(), this->Array.end()));
  for (auto name = names.begin(); name != names.end() && this->Array.empty(); ++name)
  {
    this->Array.assign(name->begin(), name->end()); // a rank without blocks has none
  }
  this->Least = isopoint::fromOrderedKey(~team.maximum(~isopoint::orderedKey(this->Least)));
  this->Greatest = isopoint::fromOrderedKey(team.maximum(isopoint::orderedKey(this->Greatest)));
}

std::vector<vtkIsopointMessage> vtkDescribeIsopointFindings(const vtkIsopointFindings& findings)
{
  std::vector<vtkIsopointMessage> messages = describeIsovalues(findings);
  messages.push_back(describeSkipped(findings));
  messages.push_back(describeUnprojected(findings));
  messages.push_back(describePieces(findings));
  const std::vector<vtkIsopointMessage> replaced = describeReplacedArrays(findings);
  messages.insert(messages.end(), replaced.begin(), replaced.end());
  messages.erase(std::remove_if(messages.begin(), messages.end(),
                   [](const vtkIsopointMessage& message) { return message.Text.empty(); }),
    messages.end());
  return messages;
}
