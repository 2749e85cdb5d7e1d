// SPDX-License-Identifier: GPL-3.0-or-later
#include "Library/Places.h"

#include "Core/Contour.h"
#include "Core/Failure.h"
#include "Library/Arrays.h"
#include "Library/Calls.h"
#include "Library/VersionedOptions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace isopoint
{
namespace
{

static_assert(haveSameNumbers({ PlaceMethod::Blend, PlaceMethod::Cubic, PlaceMethod::Quadratic,
                                PlaceMethod::Affine, PlaceMethod::Nearest },
  { ISOPOINT_PROBE_BLEND, ISOPOINT_PROBE_CUBIC, ISOPOINT_PROBE_QUADRATIC, ISOPOINT_PROBE_AFFINE,
    ISOPOINT_PROBE_NEAREST }));
static_assert(haveSameNumbers(
  { OutsideStrategy::Number, OutsideStrategy::Nearest, OutsideStrategy::Extrapolate },
  { ISOPOINT_PROBE_OUTSIDE_NUMBER, ISOPOINT_PROBE_OUTSIDE_NEAREST,
    ISOPOINT_PROBE_OUTSIDE_EXTRAPOLATE }));
static_assert(
  haveSameNumbers({ PlaceOutside, PlaceFlat }, { ISOPOINT_PLACE_OUTSIDE, ISOPOINT_PLACE_FLAT }));

/// A number as a type: without a fraction, and 0 beyond the range of integers.
template <class T>
T numberAs(double number)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    return static_cast<T>(number);
  }
  // The greatest wide integers are no double, but the next power of two is.
  const bool isInside = number >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
                        number < std::ldexp(1.0, std::numeric_limits<T>::digits);
  return isInside ? static_cast<T>(number) : T{ 0 };
}

/// The range of a component in the samples in use. O(samples)
template <class T>
std::pair<double, double> rangeOf(
  const ArrayReader& reader, const SkippedItems& skipped, int component)
{
  T least = std::numeric_limits<T>::max();
  T greatest = std::numeric_limits<T>::lowest();
  for (std::size_t id = 0; id < reader.count(); ++id)
  {
    if (!skipped || !(*skipped)[id])
    {
      const T number = reader.at<T>(id, component);
      least = std::min(least, number);
      greatest = std::max(greatest, number);
    }
  }
  return { static_cast<double>(least), static_cast<double>(greatest) };
}

ProbedArray probedArray(const isopoint_array& array, const isopoint_probe_result& result,
  std::size_t sampleCount, const SkippedItems& skipped, std::size_t placeCount,
  const ProbeOptions& options)
{
  const ArrayReader reader(&array, "values");
  reader.require(sampleCount, reader.components());
  const auto components = static_cast<std::uint64_t>(reader.components());
  const bool keepsType = options.method == PlaceMethod::Nearest;
  requireMemory(result.values, result.values_size, "values", placeCount,
    components * (keepsType ? sizeOfType(reader.type()) : sizeof(double)));
  ProbedArray probed;
  probed.components = reader.components();
  probed.valueError = isFloatingPoint(reader.type()) ? 0.0 : roundingError;
  withType(reader.type(),
    [&](auto number)
    {
      using T = decltype(number);
      probed.read = [reader](
                      const std::uint64_t* ids, std::size_t count, int component, double* numbers)
      {
        for (std::size_t i = 0; i < count; ++i)
        {
          numbers[i] = static_cast<double>(reader.at<T>(ids[i], component));
        }
      };
      if (!std::is_floating_point_v<T>)
      {
        probed.range = foundOnce(reader.components(),
          [reader, skipped](int component) { return rangeOf<T>(reader, skipped, component); });
      }
      if (keepsType)
      {
        probed.writeNearest = [reader, values = static_cast<T*>(result.values),
                                nothing = numberAs<T>(options.outsideNumber)](
                                std::size_t place, const std::uint64_t* id)
        {
          const auto components = static_cast<std::size_t>(reader.components());
          for (std::size_t c = 0; c < components; ++c)
          {
            values[components * place + c] = id ? reader.at<T>(*id, static_cast<int>(c)) : nothing;
          }
        };
      }
    });
  if (keepsType)
  {
    if (result.gradients)
    {
      throw UsageError("The method NEAREST has no gradients. Pass null, or use another method.",
        UsageError::Option);
    }
    return probed;
  }
  if (result.gradients)
  {
    requireMemory(result.gradients, result.gradients_size, "gradients", placeCount,
      3 * components * sizeof(double));
  }
  probed.values = static_cast<double*>(result.values);
  probed.gradients = result.gradients;
  return probed;
}

} // namespace

std::vector<Vector> placesFrom(const isopoint_array* places)
{
  const ArrayReader reader(places, "places");
  reader.require(reader.count(), 3);
  reader.requireFloatingPoint();
  std::vector<Vector> all(reader.count());
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    all[i] = { reader.at(i, 0), reader.at(i, 1), reader.at(i, 2) };
  }
  return all;
}

ProbeOptions probeOptionsFrom(const isopoint_probe_options* given)
{
  isopoint_probe_options all;
  isopoint_initialize_probe_options(&all, sizeof(all));
  if (given)
  {
    constexpr std::size_t sizeOf1_0 = 24;
    takeOptions(*given, sizeOf1_0, "isopoint_initialize_probe_options()", all);
  }
  const auto requireUpTo = [](std::int32_t number, std::int32_t most, const std::string& option)
  {
    if (number < 0 || number > most)
    {
      throw UsageError("The option " + option + " is " + std::to_string(number) +
                         ". Use an isopoint_probe_" + option + ", 0 to " + std::to_string(most) +
                         ".",
        UsageError::Option);
    }
  };
  requireUpTo(all.method, ISOPOINT_PROBE_NEAREST, "method");
  requireUpTo(all.outside, ISOPOINT_PROBE_OUTSIDE_EXTRAPOLATE, "outside");
  return { static_cast<PlaceMethod>(all.method), static_cast<OutsideStrategy>(all.outside),
    all.outside_number };
}

std::vector<ProbedArray> probedArrays(const isopoint_array* arrays, std::int64_t count,
  const isopoint_probe_result* results, std::size_t sampleCount, const SkippedItems& skipped,
  std::size_t placeCount, const ProbeOptions& options)
{
  if (count < 0)
  {
    throw UsageError("The number of arrays is " + std::to_string(count) + ". Pass 0 or more.");
  }
  if (count > 0)
  {
    require(arrays, "pointer to arrays");
    require(results, "pointer to results");
  }
  std::vector<ProbedArray> probed;
  for (std::int64_t i = 0; i < count; ++i)
  {
    probed.push_back(probedArray(arrays[i], results[i], sampleCount, skipped, placeCount, options));
  }
  return probed;
}

} // namespace isopoint

isopoint_weights isopoint_neighborhoods::weights()
{
  using isopoint::laneCount;
  if (this->found.options.method == isopoint::PlaceMethod::Blend)
  {
    throw isopoint::UsageError(
      "BLEND has no weights, because it is not linear in the values. Use another method.",
      isopoint::UsageError::Option);
  }
  if (this->begins.empty())
  {
    this->samples.clear(); // of a call that failed
    this->values.clear();
    this->gradients.clear();
    std::vector<std::int64_t> rows(1, 0);
    isopoint::NearbySamples around;
    for (std::size_t place = 0; place < this->found.places.size(); ++place)
    {
      this->found.surroundings(place, false, around);
      const bool isOutside = (this->found.kinds[place] & isopoint::PlaceOutside) != 0;
      const bool isNearest = this->found.options.outside == isopoint::OutsideStrategy::Nearest;
      const std::size_t count =
        !isOutside ? around.fitted : std::min<std::size_t>(isNearest ? 1 : 0, around.size());
      for (std::size_t i = 0; i < count; ++i)
      {
        const double* const of =
          this->found.weights.data() + laneCount * (this->found.begins[place] + i);
        // NEAREST takes the first of coincident samples, other methods their mean.
        const bool isFirst = this->found.options.method == isopoint::PlaceMethod::Nearest;
        const std::size_t end = isFirst ? around.idBegins[i] + 1 : around.idBegins[i + 1];
        const auto share = 1.0 / static_cast<double>(end - around.idBegins[i]);
        for (std::size_t id = around.idBegins[i]; id < end; ++id)
        {
          this->samples.push_back(static_cast<std::int64_t>(around.ids[id]));
          this->values.push_back(share * (isOutside ? 1.0 : of[0]));
          for (std::size_t k = 1; k < laneCount; ++k)
          {
            this->gradients.push_back(
              isOutside ? 0.0 : std::ldexp(share * of[k], -this->found.exponent));
          }
        }
      }
      rows.push_back(static_cast<std::int64_t>(this->samples.size()));
    }
    this->begins.swap(rows);
  }
  return { static_cast<std::int64_t>(this->found.places.size()), this->begins.data(),
    this->samples.data(), this->values.data(), this->gradients.data() };
}
