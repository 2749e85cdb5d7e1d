// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Report.h"

#include "Core/Base/ProcessGroup.h"
#include "Core/IsosurfaceExtractor.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <iterator>
#include <limits>
#include <numeric>
#include <sstream>
#include <utility>

namespace isopoint
{

namespace
{

std::string describeArray(const SampleCounts& counts)
{
  return counts.array.empty() ? "the array" : "\"" + counts.array + "\"";
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

/// All numbers, or the first ones and how many more there are.
std::string join(const std::vector<double>& numbers, int digits)
{
  constexpr std::size_t most = 3;
  const std::size_t shown = std::min(numbers.size(), most);
  std::vector<std::string> texts;
  std::transform(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(shown),
    std::back_inserter(texts), [digits](double number) { return textOf(number, digits); });
  const std::size_t more = numbers.size() - shown;
  return join(texts) + (more > 0 ? " and " + std::to_string(more) + " more" : "");
}

/// A share, coarse enough to stay the same under small changes.
std::string tenths(std::uint64_t count, std::uint64_t all)
{
  constexpr std::uint64_t parts = 10;
  return std::to_string(parts * count / std::max<std::uint64_t>(all, 1)) + " of 10";
}

/// Enough digits to tell the isovalues and the ends of the range apart.
int digitsFor(const Report& report, const std::vector<double>& isovalues)
{
  constexpr int few = 6;
  for (int digits = few; digits < std::numeric_limits<double>::max_digits10; ++digits)
  {
    const auto lookAlike = [digits](double a, double b)
    { return a != b && textOf(a, digits) == textOf(b, digits); };
    if (!lookAlike(report.least, report.greatest) &&
        std::none_of(isovalues.begin(), isovalues.end(),
          [&](double isovalue)
          { return lookAlike(isovalue, report.least) || lookAlike(isovalue, report.greatest); }))
    {
      return digits;
    }
  }
  return std::numeric_limits<double>::max_digits10;
}

constexpr std::uint64_t fewestSamples = 4; // of a tetrahedron

std::uint64_t usedCount(const Report& report)
{
  return report.samples - report.skippedCount();
}

std::string describeTooFew(const Report& report)
{
  const std::uint64_t used = usedCount(report);
  return (used == 1 ? "there is only 1 sample"
                    : "there are only " + std::to_string(used) + " samples") +
         std::string(". Add samples around the surface.");
}

/// Which isovalues have a surface.
std::string describeRange(
  const Report& report, const std::string& least, const std::string& greatest)
{
  if (report.areCapped)
  {
    return report.areNegated ? "greater than " + least : "less than " + greatest;
  }
  return "between " + least + " and " + greatest;
}

Message describeIsovaluesOutside(const Report& report, const std::vector<double>& outside)
{
  if (outside.empty())
  {
    return {};
  }
  const int digits = digitsFor(report, outside);
  const std::string least = textOf(report.least, digits);
  if (report.least == report.greatest && usedCount(report) < fewestSamples)
  {
    return { "too few samples of " + report.array, "No isosurface: " + describeTooFew(report),
      Message::Warning, Message::TooFewSamples };
  }
  if (report.least == report.greatest)
  {
    return { "constant array " + report.array,
      "No isosurface: all values of " + describeArray(report) + " are " + least +
        ". Choose another array" +
        (report.areCapped
            ? std::string(", or a ") + (report.areNegated ? "higher" : "lower") + " isovalue."
            : "."),
      Message::Warning, Message::ConstantValues };
  }
  const std::string isovalues = join(outside, digits);
  const std::string greatest = textOf(report.greatest, digits);
  const std::string array = report.array.empty() ? "The array" : describeArray(report);
  // Ranges of isovalues and animations begin and end where surfaces do.
  const bool areEnds = std::all_of(outside.begin(), outside.end(),
    [&](double isovalue) { return isovalue == report.least || isovalue == report.greatest; });
  const bool isExpected = areEnds && (report.pointCount() > 0 || report.hadSurface);
  return { "isovalues outside of " + report.array + ": " + isovalues,
    array + " is from " + least + " to " + greatest + ": no isosurface at " + isovalues +
      ". Choose isovalues " + describeRange(report, least, greatest) + ".",
    isExpected ? Message::Note : Message::Warning,
    areEnds ? Message::IsovalueAtEnd : Message::IsovalueOutside };
}

/// Whether an isovalue can have a surface.
bool isInRange(const Report& report, double isovalue)
{
  // Bodies have all samples at the least value. Triangles shrink to samples at the greatest one.
  return (isovalue > report.least || report.areCapped) &&
         (isovalue < report.greatest || (isovalue == report.greatest && !report.areTriangles));
}

using Reason = std::pair<Message::Code, std::string>;

/// Whether float is too coarse for the positions of samples: it moves them by a part of their
/// spacing, or many coincide.
bool areRounded(const Report& report)
{
  constexpr double fewSteps = 2.0;
  constexpr double fewStepsIfMeeting = 10.0;
  constexpr std::uint64_t minShare = 10;
  const bool areMeeting = minShare * report.coincident > report.pointCount();
  return usedCount(report) >= fewestSamples &&
         report.spacingInFloatSteps < (areMeeting ? fewStepsIfMeeting : fewSteps);
}

Reason reasonOfRounding()
{
  return { Message::RoundedPositions,
    "positions so far from the origin are rounded to float32. Give positions as double, or subtract"
    " an offset before they become float32." };
}

/// Why an isovalue in the range has no surface, and the remedy.
Reason reasonOfEmptyIsovalue(const Report& report, bool isInGaps, OptionNaming naming)
{
  if (usedCount(report) < fewestSamples)
  {
    return { Message::TooFewSamples, describeTooFew(report) };
  }
  if (areRounded(report))
  {
    return reasonOfRounding();
  }
  if (isInGaps)
  {
    return { Message::AllInGaps,
      "all of it is in gaps between samples. Turn " + naming(option::dropGaps.name) + " off." };
  }
  if (report.contoursBlocks)
  {
    return { Message::NoCrossing,
      "no block has a surface of its own. Turn " + naming("ContourBlocks") + " off." };
  }
  if (report.subject != Report::Isosurface)
  {
    return { Message::NoCrossing, "the samples are in one plane. Add samples beside it." };
  }
  return { Message::NoCrossing,
    report.areTriangles ? "no tetrahedron of the samples crosses it. Samples in one plane have"
                          " isolines instead: contour their Delaunay 2D triangulation."
                        : "samples at one position count with the mean of their values." };
}

/// For isovalues in the range.
/// @param isInGaps whether something was dropped there
Message describeEmptyIsovalues(
  const Report& report, const std::vector<double>& empty, bool isInGaps, OptionNaming naming)
{
  if (empty.empty())
  {
    return {};
  }
  const std::string isovalues = join(empty, digitsFor(report, empty));
  const auto [code, reason] = reasonOfEmptyIsovalue(report, isInGaps, naming);
  const std::string of = report.array.empty() ? "" : " of " + describeArray(report);
  return { "isovalues without points in " + report.array + ": " + isovalues,
    (report.subject == Report::Body ? "No body: " : "No isosurface at " + isovalues + of + ": ") +
      reason,
    Message::Warning, code };
}

/// Why all slices are empty, or that one is partial. Some may be beside the samples.
Message describeSlices(const Report& report, OptionNaming naming)
{
  const auto isAny = [&](double from, double to, std::uint64_t fewestPoints = 0)
  {
    for (std::size_t i = 0; i < report.isovalues.size(); ++i)
    {
      if (report.isovalues[i] >= from && report.isovalues[i] <= to &&
          report.points[i] >= fewestPoints)
      {
        return true;
      }
    }
    return false;
  };
  const double least = report.least;
  const double greatest = report.greatest;
  // Up to rounding, as by a box in the bounds of the samples.
  constexpr double rounding = 1e-9;
  const double outermost = greatest - (rounding * greatest - rounding * least);
  const bool isEmpty = report.pointCount() == 0;
  const std::string remedy = " Move it among the samples; make a box or a sphere smaller.";
  if (areRounded(report))
  {
    const auto [code, reason] = reasonOfRounding();
    return isEmpty ? Message{ "empty slice", "No slice: " + reason, Message::Warning, code }
                   : Message{};
  }
  if (isAny(outermost, greatest, 1))
  {
    return { "outermost slice",
      "The slice is only where samples are on it, as no sample is beyond it." + remedy,
      Message::Note, Message::OnlyAtSamples };
  }
  if (!isEmpty)
  {
    return {};
  }
  Reason reason{ Message::IsovalueOutside,
    "all samples are on one side of it. Move it among the samples." };
  if (least == greatest && usedCount(report) < fewestSamples)
  {
    reason = { Message::TooFewSamples, describeTooFew(report) };
  }
  else if (least == greatest)
  {
    reason = { Message::ConstantValues,
      "the cut function is the same at all samples. Choose one that has samples on both sides." };
  }
  else if (isAny(outermost, greatest))
  {
    reason.second = "no sample is beyond it." + remedy;
  }
  else if (isAny(std::nextafter(least, greatest), greatest))
  {
    reason = reasonOfEmptyIsovalue(report, report.droppedCount() > 0, naming);
  }
  else if (isAny(least, least))
  {
    reason.second =
      "samples on it count as above it, and none are below. Move it among the samples.";
  }
  return { "empty slice", "No slice: " + reason.second, Message::Warning, reason.first };
}

std::vector<Message> describeIsovalues(const Report& report, OptionNaming naming)
{
  const bool isSlice = report.subject == Report::Slice;
  if (report.isovalues.empty())
  {
    return { { "no isovalues",
      isSlice ? "No slice: there are no offsets. Set one, such as 0."
              : "No isosurface: there are no isovalues. Set one.",
      Message::Warning, Message::NoIsovalues } };
  }
  if (report.least > report.greatest) // without samples
  {
    return {};
  }
  if (isSlice)
  {
    return { describeSlices(report, naming) };
  }
  std::vector<double> outside;
  std::vector<double> empty;
  std::vector<double> inGaps;
  for (std::size_t i = 0; i < report.isovalues.size(); ++i)
  {
    const double value = report.isovalues[i];
    if (report.points[i] == 0)
    {
      std::vector<double>& inside = report.dropped[i] > 0 && !areRounded(report) ? inGaps : empty;
      (isInRange(report, value) ? inside : outside).push_back(value);
    }
  }
  Report shown = report;
  if (report.areNegated)
  {
    shown.least = -report.greatest;
    shown.greatest = -report.least;
    for (std::vector<double>* const isovalues : { &outside, &inGaps, &empty })
    {
      std::reverse(isovalues->begin(), isovalues->end());
      std::transform(isovalues->begin(), isovalues->end(), isovalues->begin(),
        [](double isovalue) { return 0.0 - isovalue; }); // 0 stays 0
    }
  }
  return { describeIsovaluesOutside(shown, outside),
    describeEmptyIsovalues(shown, inGaps, true, naming),
    describeEmptyIsovalues(shown, empty, false, naming) };
}

/// Of a surface; messages about isovalues without one name the cause themselves.
Message describeRounded(const Report& report)
{
  if (report.pointCount() == 0 || !areRounded(report))
  {
    return {};
  }
  const auto [code, reason] = reasonOfRounding();
  return { "rounded positions", "The surface is inaccurate: " + reason, Message::Warning, code };
}

/// Samples at one position, if this is likely to matter and is not as expected.
Message describeCoincident(const Report& report)
{
  if (report.differing == 0 || report.subject != Report::Isosurface || areRounded(report))
  {
    return {};
  }
  return { "coincident samples of " + report.array + ": " +
             tenths(report.differing, report.pointCount()),
    "Samples at one position have different values next to " + std::to_string(report.differing) +
      " of " + std::to_string(report.pointCount()) +
      " points: their mean counts. To count one of them, leave the others out.",
    Message::Note, Message::DifferentValues };
}

/// Whether fits hold at so few points that the samples do not determine a surface. Those on lines
/// make debris: most of the surface is in gaps, and fits hold at pieces of it.
bool areMostUnprojected(const Report& report)
{
  constexpr std::uint64_t fewOfDebris = 5;
  constexpr std::uint64_t most = 2;
  const std::uint64_t points = report.pointCount();
  const bool isDebris = report.areTriangles && report.droppedCount() > points;
  return report.areProjected && (isDebris ? fewOfDebris : most) * report.unprojectedPoints > points;
}

Message describeUnprojected(const Report& report, OptionNaming naming)
{
  const std::uint64_t points = report.pointCount();
  if (!areMostUnprojected(report) || areRounded(report))
  {
    return {};
  }
  return { "points without fit of " + report.array + ": " +
             tenths(report.unprojectedPoints, points),
    "No fit holds at " + std::to_string(report.unprojectedPoints) + " of " +
      std::to_string(points) +
      " points: the surface may be rough. Smooth the values if they are noisy. For samples on a"
      " surface, such as a plane or a shell, set " +
      naming(option::projection.name) +
      " to none. Samples along lines, such as drill holes, do not determine a surface.",
    Message::Warning, Message::PointsWithoutFit };
}

/// If more than a tenth of the corners stay apart, pictures have holes.
Message describeCornersApart(const Report& report)
{
  constexpr std::uint64_t minShare = 10;
  constexpr std::uint64_t minCorners = 1000; // the share of fewer is not significant
  if (report.innerCorners < minCorners || minShare * report.cornersApart <= report.innerCorners ||
      areMostUnprojected(report) || areRounded(report))
  {
    return {};
  }
  return { "corners apart of " + report.array + ": " +
             tenths(report.cornersApart, report.innerCorners),
    "Splats do not meet at " + std::to_string(report.cornersApart) + " of " +
      std::to_string(report.innerCorners) +
      " corners: the picture may have holes, since samples are too uneven or too few for splats."
      " Extract triangles instead, as Scattered Isosurface does.",
    Message::Warning, Message::SplatsApart };
}

Message describeBeyondFloat(const Report& report)
{
  if (report.beyondFloat == 0)
  {
    return {};
  }
  return { "points beyond float of " + report.array + ": " +
             tenths(report.beyondFloat, report.pointCount()),
    "Arrays of type float cannot hold positions or splats of " +
      std::to_string(report.beyondFloat) + " of " + std::to_string(report.pointCount()) +
      " points. Choose another unit of length.",
    Message::Warning, Message::BeyondFloat };
}

std::vector<Message> describeReplacedArrays(const Report& report)
{
  std::vector<Message> messages;
  for (const std::string& name : report.replacedArrays)
  {
    messages.push_back({ "replaced array " + name,
      "The computed array \"" + name +
        "\" replaces the input array of this name. To keep that, rename it or switch the computed"
        " array off." });
  }
  return messages;
}

Report::Subject subjectOf(const Options& options, const std::vector<double>& isovalues)
{
  if (options.capping)
  {
    const std::vector<double> belowAll{ -std::numeric_limits<double>::infinity() };
    return isovalues == belowAll ? Report::Body : Report::Isosurface;
  }
  return options.triangles && options.keepHullSlivers ? Report::Slice : Report::Isosurface;
}

} // namespace

Message describeSkipped(
  const SampleCounts& counts, const std::string& ofNone, const std::string& ofSome)
{
  if (counts.notFinite + counts.withoutArray == 0)
  {
    return {};
  }
  const std::vector<std::pair<std::uint64_t, std::string>> reasons{
    { counts.notFinite, "not finite" },
    { counts.withoutArray, "in blocks without " + describeArray(counts) },
    { counts.excluded, "excluded" },
  };
  const std::uint64_t skipped = counts.skippedCount();
  std::vector<std::string> parts;
  for (const auto& [count, reason] : reasons)
  {
    if (count > 0)
    {
      parts.push_back(count < skipped ? std::to_string(count) + " " + reason : reason);
    }
  }
  const std::string cause =
    "samples skipped of " + counts.array + ": " + tenths(skipped, counts.samples);
  const std::string text = "Skipped " + std::to_string(skipped) + " of " +
                           std::to_string(counts.samples) + " samples: " + join(parts) + ". ";
  if (skipped == counts.samples)
  {
    return { cause, text + ofNone, Message::Warning, Message::NoSamples };
  }
  return { cause, text + ofSome, Message::Note, Message::SkippedSamples };
}

void SampleCounts::count(const IsosurfaceExtractor& extractor, const CloudCounts& cloud)
{
  this->samples += cloud.items - cloud.unused;
  this->excluded += cloud.excluded;
  this->notFinite += extractor.skippedCount() - cloud.excluded - cloud.unused;
}

void SampleCounts::share(ProcessGroup& processes)
{
  for (std::uint64_t* const count :
    { &this->samples, &this->notFinite, &this->excluded, &this->withoutArray })
  {
    *count = processes.sum(*count);
  }
  const std::vector<std::vector<char>> names =
    processes.gather(std::vector<char>(this->array.begin(), this->array.end()));
  for (auto name = names.begin(); name != names.end() && this->array.empty(); ++name)
  {
    this->array.assign(name->begin(), name->end()); // a rank without samples has none
  }
}

Report::Report(const Options& options, const std::vector<double>& sortedIsovalues)
  : subject(subjectOf(options, sortedIsovalues))
  , isovalues(sortedIsovalues)
  , points(sortedIsovalues.size(), 0)
  , dropped(sortedIsovalues.size(), 0)
  , areTriangles(options.triangles)
  , areCapped(options.capping)
  , areProjected(options.projection != 0)
  , areSinglePoints(isSinglePrecision(options, false))
{
}

std::uint64_t Report::pointCount() const
{
  return std::accumulate(this->points.begin(), this->points.end(), std::uint64_t{ 0 });
}

std::uint64_t Report::droppedCount() const
{
  return std::accumulate(this->dropped.begin(), this->dropped.end(), std::uint64_t{ 0 });
}

void Report::countSamples(const IsosurfaceExtractor& extractor, const CloudCounts& cloud)
{
  this->count(extractor, cloud);
  const auto [lowest, highest] = extractor.valueRange();
  this->least = std::min(this->least, lowest);
  this->greatest = std::max(this->greatest, highest);
  this->spacingInFloatSteps = std::min(this->spacingInFloatSteps, extractor.spacingInFloatSteps());
}

void Report::countCoincident(const ExtractedIsosurface& extracted, std::size_t isopoint)
{
  const auto& surface = extracted.surface;
  bool isAny = false;
  bool isDifferent = false;
  for (std::size_t k = surface.edgeBegin(isopoint); k < surface.edgeBegin(isopoint + 1); ++k)
  {
    for (const std::uint64_t end : { surface.edges[k].first, surface.edges[k].second })
    {
      const CoincidentSamples* const group = surface.coincidentAt(end);
      isAny = isAny || group;
      isDifferent = isDifferent || (group && !group->haveOneValue);
    }
  }
  this->coincident += isAny ? 1 : 0;
  this->differing += isDifferent ? 1 : 0;
}

void Report::countSurface(std::size_t isovalue, const ExtractedIsosurface& surface)
{
  this->points[isovalue] += surface.countHere();
  this->dropped[isovalue] += surface.droppedInGaps;
  const auto isHere = [&](std::size_t i)
  { return surface.areGhosts.empty() || !surface.areGhosts[i]; };
  using Float = std::numeric_limits<float>;
  for (std::size_t i = 0; i < surface.surface.size(); ++i)
  {
    const Vector& p = surface.surface.positions[i];
    if (isHere(i) && !surface.surface.coincident.empty())
    {
      this->countCoincident(surface, i);
    }
    const double farthest = std::max({ std::abs(p[0]), std::abs(p[1]), std::abs(p[2]) });
    const double radius = surface.splats.empty() ? 0.0 : surface.splats[i].radius;
    const auto isBeyondFloat = [](double length)
    { return length > Float::max() || (length > 0.0 && length < Float::min()); };
    const bool isBeyond =
      (this->areSinglePoints && isBeyondFloat(farthest)) || isBeyondFloat(radius);
    this->beyondFloat += isHere(i) && isBeyond ? 1 : 0;
  }
  for (std::size_t i = 0; i < surface.splats.size(); ++i)
  {
    this->innerCorners += isHere(i) ? surface.splats[i].counts.inner : 0;
    this->cornersApart += isHere(i) ? surface.splats[i].counts.apart : 0;
  }
  if (!this->areProjected)
  {
    this->unprojectedPoints += surface.countHere();
    return;
  }
  const std::vector<LocalFit>& fits = surface.surface.fits;
  for (std::size_t i = 0; i < fits.size(); ++i)
  {
    const bool isAtSample = surface.surface.edgeOf(i).isSample(); // of a cap
    this->unprojectedPoints += isHere(i) && !fits[i].order && !isAtSample ? 1 : 0;
  }
}

void Report::add(const Report& other)
{
  const std::uint64_t before = this->samples;
  std::transform(this->points.begin(), this->points.end(), other.points.begin(),
    this->points.begin(), std::plus<>());
  std::transform(this->dropped.begin(), this->dropped.end(), other.dropped.begin(),
    this->dropped.begin(), std::plus<>());
  for (const auto count : std::initializer_list<std::uint64_t Report::*>{
         &Report::unprojectedPoints, &Report::innerCorners, &Report::cornersApart,
         &Report::beyondFloat, &Report::coincident, &Report::differing, &Report::samples,
         &Report::notFinite, &Report::excluded, &Report::withoutArray })
  {
    this->*count += other.*count;
  }
  this->array = this->array.empty() ? other.array : this->array;
  this->replacedArrays.insert(other.replacedArrays.begin(), other.replacedArrays.end());
  this->least = std::min(this->least, other.least);
  this->greatest = std::max(this->greatest, other.greatest);
  this->areSinglePoints = this->areSinglePoints || other.areSinglePoints;
  this->spacingInFloatSteps = std::min(this->spacingInFloatSteps, other.spacingInFloatSteps);
  this->contoursBlocks = this->contoursBlocks || (before > 0 && other.samples > 0);
}

void Report::share(ProcessGroup& processes)
{
  processes.sum(this->points); // the number of isovalues is the same on all ranks
  processes.sum(this->dropped);
  for (std::uint64_t* const count : { &this->unprojectedPoints, &this->innerCorners,
         &this->cornersApart, &this->beyondFloat, &this->coincident, &this->differing })
  {
    *count = processes.sum(*count);
  }
  this->SampleCounts::share(processes);
  this->least = fromOrderedKey(~processes.maximum(~orderedKey(this->least)));
  this->greatest = fromOrderedKey(processes.maximum(orderedKey(this->greatest)));
  this->spacingInFloatSteps =
    fromOrderedKey(~processes.maximum(~orderedKey(this->spacingInFloatSteps)));
}

std::vector<Message> describeReport(const Report& report, OptionNaming naming)
{
  std::vector<Message> messages = describeIsovalues(report, naming);
  messages.push_back(describeSkipped(report,
    report.subject == Report::Isosurface
      ? "There is no surface. Choose another array, or mend the positions."
      : "There is no surface. Mend the positions.",
    "The surface there is that of the samples around."));
  messages.push_back(describeRounded(report));
  messages.push_back(describeCoincident(report));
  messages.push_back(describeUnprojected(report, naming));
  messages.push_back(describeCornersApart(report));
  messages.push_back(describeBeyondFloat(report));
  const std::vector<Message> replaced = describeReplacedArrays(report);
  messages.insert(messages.end(), replaced.begin(), replaced.end());
  messages.erase(std::remove_if(messages.begin(), messages.end(),
                   [](const Message& message) { return message.text.empty(); }),
    messages.end());
  if (messages.empty() && report.samples == report.skippedCount())
  {
    messages.push_back({ "no samples",
      report.samples == 0 ? "There are no samples. Add some."
                          : "All samples are excluded. Include some.",
      Message::Warning, Message::NoSamples });
  }
  if (report.isPieceOfProcess)
  {
    messages.push_back({ "pieces of processes",
      "Each process yields a piece of the surface of its own samples. If the processes have"
      " different samples, call SetController() with the global controller." });
  }
  return messages;
}

} // namespace isopoint
