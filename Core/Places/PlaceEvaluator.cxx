// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Places/PlaceEvaluator.h"

#include "Core/Tree/CoincidentSamples.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isopoint
{
namespace
{

bool hasGradients(const std::vector<ProbedArray>& arrays)
{
  return std::any_of(
    arrays.begin(), arrays.end(), [](const ProbedArray& array) { return array.gradients; });
}

} // namespace

void NearbySamples::setReach(std::size_t most, double next)
{
  constexpr double beyond = 1.1; // the farthest of all samples counts, too
  this->fitted = std::min(most, this->offsets.size());
  this->reach = next >= 0.0 || this->offsets.empty()
                  ? next
                  : beyond * lengthOf(this->offsets[this->fitted - 1]);
}

std::size_t neededCount(const ProbeOptions& options)
{
  return std::max(fittedCount(options.method), countForKinds);
}

PlaceEvaluator::PlaceEvaluator(const ProbeOptions& options, const std::vector<ProbedArray>& arrays)
  : Options(options)
  , Arrays(arrays)
  , Fitter(options.method, hasGradients(arrays))
  , PresentFitter(options.method, hasGradients(arrays))
{
}

std::uint8_t PlaceEvaluator::enter(const NearbySamples& around)
{
  this->IsPrepared = false;
  return around.offsets.empty() ? std::uint8_t{ PlaceOutside } : this->kindsOf(around.offsets);
}

std::uint8_t PlaceEvaluator::kindsOf(const std::vector<Vector>& offsets) const
{
  const std::uint8_t kinds = placeKinds(offsets);
  return this->Options.outside == OutsideStrategy::Extrapolate
           ? static_cast<std::uint8_t>(kinds & ~PlaceOutside)
           : kinds;
}

void PlaceEvaluator::writeWeights(const NearbySamples& around, double* weights)
{
  if (around.fitted == 0)
  {
    return;
  }
  this->Fitter.prepare(around.offsets, around.fitted, around.reach);
  for (std::size_t i = 0; i < around.fitted; ++i)
  {
    for (std::size_t k = 0; k < laneCount; ++k)
    {
      weights[laneCount * i + k] = this->Fitter.weights(k)[i];
    }
  }
}

void PlaceEvaluator::evaluate(std::size_t place, const NearbySamples& around, std::uint8_t kinds)
{
  const bool isOutside = (kinds & PlaceOutside) != 0;
  for (const ProbedArray& array : this->Arrays)
  {
    if (around.offsets.empty())
    {
      this->writeNothing(array, place);
    }
    else if (this->Options.method == PlaceMethod::Nearest || array.isNearest)
    {
      this->writeNearest(array, place, around, isOutside);
    }
    else if (!this->read(array, around))
    {
      this->evaluatePresent(array, place, around);
    }
    else if (isOutside)
    {
      this->writeOutside(array, place);
    }
    else
    {
      if (!this->IsPrepared)
      {
        this->Fitter.prepare(around.offsets, around.fitted, around.reach);
        this->IsPrepared = true;
      }
      this->apply(array, place, around.fitted, this->Fitter);
    }
  }
}

void PlaceEvaluator::evaluateAgain(
  std::size_t place, const NearbySamples& around, std::uint8_t kinds, const double* weights)
{
  this->IsPrepared = weights != nullptr;
  if (weights)
  {
    this->Fitter.prepareFrom(weights, around.fitted);
  }
  this->evaluate(place, around, kinds);
}

/// Reads the values of an array. @returns whether all are finite
bool PlaceEvaluator::read(const ProbedArray& array, const NearbySamples& around)
{
  this->Values.resize(static_cast<std::size_t>(array.components));
  bool areFinite = true;
  for (std::size_t c = 0; c < this->Values.size(); ++c)
  {
    SampleNumbers& values = this->Values[c];
    const std::size_t count = around.size();
    if (around.haveOneIdEach())
    {
      array.read(around.ids.data(), count, static_cast<int>(c), &values[0]);
    }
    else
    {
      this->Numbers.resize(around.ids.size());
      array.read(around.ids.data(), around.ids.size(), static_cast<int>(c), this->Numbers.data());
      for (std::size_t i = 0; i < count; ++i)
      {
        double* const first = this->Numbers.data() + around.idBegins[i];
        double* const last = std::remove_if(first, this->Numbers.data() + around.idBegins[i + 1],
          [](double number) { return !std::isfinite(number); });
        values[i] = first == last ? std::numeric_limits<double>::quiet_NaN()
                                  : meanOf(static_cast<std::size_t>(last - first),
                                      [first](std::size_t k) { return first[k]; });
      }
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      areFinite = areFinite && std::isfinite(values[i]);
    }
  }
  return areFinite;
}

/// An array that lacks values of some samples is evaluated as if these did not exist.
void PlaceEvaluator::evaluatePresent(
  const ProbedArray& array, std::size_t place, const NearbySamples& around)
{
  this->Present.clear();
  std::size_t fitted = 0;
  for (std::size_t i = 0; i < around.size(); ++i)
  {
    if (std::all_of(this->Values.begin(), this->Values.end(),
          [i](const SampleNumbers& values) { return std::isfinite(values[i]); }))
    {
      for (SampleNumbers& values : this->Values)
      {
        values[this->Present.size()] = values[i];
      }
      this->Present.offsets.push_back(around.offsets[i]);
      fitted += i < around.fitted ? 1 : 0;
    }
  }
  if (fitted == 0)
  {
    this->writeNothing(array, place);
    return;
  }
  if ((this->kindsOf(this->Present.offsets) & PlaceOutside) != 0)
  {
    this->writeOutside(array, place);
    return;
  }
  this->PresentFitter.prepare(this->Present.offsets, fitted, around.reach);
  this->apply(array, place, fitted, this->PresentFitter);
}

void PlaceEvaluator::apply(
  const ProbedArray& array, std::size_t place, std::size_t fitted, PlaceFitter& fitter)
{
  const auto components = static_cast<std::size_t>(array.components);
  this->Ranges.clear();
  for (std::size_t c = 0; array.range && c < components; ++c)
  {
    const double* const first = &this->Values[c][0];
    const auto [least, greatest] = std::minmax_element(first, first + fitted);
    this->Ranges.emplace_back(*least, *greatest);
  }
  double* const values = array.values + components * place;
  fitter.apply(this->Values, array.valueError, values,
    array.gradients ? array.gradients + 3 * components * place : nullptr);
  for (std::size_t c = 0; c < this->Ranges.size(); ++c)
  {
    if (values[c] < this->Ranges[c].first || values[c] > this->Ranges[c].second)
    {
      const auto [least, greatest] = array.range(static_cast<int>(c));
      values[c] = std::clamp(values[c], least, greatest);
    }
  }
}

void PlaceEvaluator::writeOutside(const ProbedArray& array, std::size_t place) const
{
  if (this->Options.outside == OutsideStrategy::Number)
  {
    this->writeNothing(array, place);
    return;
  }
  const auto components = static_cast<std::size_t>(array.components);
  for (std::size_t c = 0; c < components; ++c)
  {
    array.values[components * place + c] = this->Values[c][0];
  }
  if (array.gradients)
  {
    std::fill_n(array.gradients + 3 * components * place, 3 * components, 0.0);
  }
}

void PlaceEvaluator::writeNothing(const ProbedArray& array, std::size_t place) const
{
  if (array.writeNearest)
  {
    array.writeNearest(place, nullptr);
    return;
  }
  const auto components = static_cast<std::size_t>(array.components);
  std::fill_n(array.values + components * place, components, this->Options.outsideNumber);
  if (array.gradients)
  {
    std::fill_n(array.gradients + 3 * components * place, 3 * components,
      std::numeric_limits<double>::quiet_NaN());
  }
}

/// Writes the numbers of the nearest sample whose components are all finite.
void PlaceEvaluator::writeNearest(
  const ProbedArray& array, std::size_t place, const NearbySamples& around, bool isOutside) const
{
  const auto isFinite = [&](std::uint64_t id)
  {
    for (int c = 0; c < array.components; ++c)
    {
      double number = 0.0;
      array.read(&id, 1, c, &number);
      if (!std::isfinite(number))
      {
        return false;
      }
    }
    return true;
  };
  const bool isNumber = isOutside && this->Options.outside == OutsideStrategy::Number;
  const auto found =
    isNumber ? around.ids.end() : std::find_if(around.ids.begin(), around.ids.end(), isFinite);
  if (found == around.ids.end())
  {
    this->writeNothing(array, place);
  }
  else if (array.writeNearest)
  {
    array.writeNearest(place, &*found);
  }
  else
  {
    const auto components = static_cast<std::size_t>(array.components);
    for (std::size_t c = 0; c < components; ++c)
    {
      array.read(&*found, 1, static_cast<int>(c), array.values + components * place + c);
    }
    if (array.gradients)
    {
      std::fill_n(array.gradients + 3 * components * place, 3 * components, 0.0);
    }
  }
}

} // namespace isopoint
