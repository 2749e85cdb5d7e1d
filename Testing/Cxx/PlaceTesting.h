// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Clouds.h"

#include "Core/Probe.h"

namespace places
{

using namespace isopoint;
using Numbers = std::vector<double>;

constexpr std::array<PlaceMethod, 5> allMethods{ PlaceMethod::Blend, PlaceMethod::Cubic,
  PlaceMethod::Quadratic, PlaceMethod::Affine, PlaceMethod::Nearest };

/// An array of samples, by sample, then component.
struct Array
{
  Numbers numbers;
  int components = 1;
  double valueError = 0.0;
};

/// The results of arrays at places.
struct Probed
{
  std::vector<Numbers> values; // by array
  std::vector<Numbers> gradients;
  std::vector<std::uint8_t> kinds; // by place

  bool isOutside(std::size_t place) const
  {
    return (this->kinds[place] & isopoint::PlaceOutside) != 0;
  }

  /// The results at one place.
  Probed at(std::size_t place) const
  {
    Probed one;
    one.kinds.push_back(this->kinds[place]);
    const auto part = [&](const Numbers& numbers)
    {
      const std::size_t each = numbers.size() / this->kinds.size();
      const double* const first = numbers.data() + each * place;
      return Numbers(first, first + each);
    };
    std::transform(this->values.begin(), this->values.end(), std::back_inserter(one.values), part);
    std::transform(
      this->gradients.begin(), this->gradients.end(), std::back_inserter(one.gradients), part);
    return one;
  }

  /// The bits of all numbers; a NaN is as good as another one.
  std::string bytes() const
  {
    std::string all(this->kinds.begin(), this->kinds.end());
    for (const std::vector<Numbers>* const arrays : { &this->values, &this->gradients })
    {
      for (const Numbers& numbers : *arrays)
      {
        for (const double number : numbers)
        {
          const double written = std::isnan(number) ? 1e300 : number;
          all.append(reinterpret_cast<const char*>(&written), sizeof(written));
        }
      }
    }
    return all;
  }
};

inline std::vector<isopoint::ProbedArray> probedArrays(
  const std::vector<Array>& arrays, std::size_t placeCount, Probed& results)
{
  std::vector<isopoint::ProbedArray> probed(arrays.size());
  results.values.resize(arrays.size());
  results.gradients.resize(arrays.size());
  for (std::size_t a = 0; a < arrays.size(); ++a)
  {
    const auto components = static_cast<std::size_t>(arrays[a].components);
    results.values[a].resize(components * placeCount);
    results.gradients[a].resize(3 * components * placeCount);
    probed[a].components = arrays[a].components;
    probed[a].valueError = arrays[a].valueError;
    probed[a].values = results.values[a].data();
    probed[a].gradients = results.gradients[a].data();
    probed[a].read = [&array = arrays[a], components](
                       const std::uint64_t* ids, std::size_t count, int component, double* numbers)
    {
      for (std::size_t i = 0; i < count; ++i)
      {
        numbers[i] = array.numbers[components * ids[i] + static_cast<std::size_t>(component)];
      }
    };
  }
  return probed;
}

inline Probed probe(isopoint::IsosurfaceExtractor& extractor, const std::vector<Vector>& places,
  const ProbeOptions& options, const std::vector<Array>& arrays, std::size_t threads = 1)
{
  Probed results;
  results.kinds.resize(places.size());
  extractor.probe(clouds::executionOn(threads), places, options,
    probedArrays(arrays, places.size(), results), results.kinds.data());
  return results;
}

inline Probed probe(const clouds::Cloud& cloud, const std::vector<Vector>& places,
  const ProbeOptions& options, const std::vector<Array>& arrays)
{
  auto extractor = clouds::loaded(cloud);
  return probe(extractor, places, options, arrays);
}

/// Random places in a box, some of them at samples.
inline std::vector<Vector> randomPlaces(
  const clouds::Cloud& cloud, std::size_t count, double lower, double upper, std::uint64_t seed)
{
  const clouds::Cloud random = clouds::uniform(count, seed);
  std::vector<Vector> places;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vector unit = random.at(i);
    places.push_back(i % 16 == 0 && cloud.size() > 0
                       ? cloud.at(i % cloud.size())
                       : Vector{ lower, lower, lower } + (upper - lower) * unit);
  }
  return places;
}

/// The values of a cloud; vectors of it; and values that some samples lack.
inline std::vector<Array> variousArrays(const clouds::Cloud& cloud)
{
  std::vector<Array> arrays{ { cloud.values }, { {}, 3 }, { cloud.values, 1, 0.25 } };
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const double value = cloud.values[i];
    arrays[1].numbers.insert(arrays[1].numbers.end(), { value, value * value, cloud.at(i)[0] });
    if (i % 5 == 0 || cloud.at(i)[0] > 0.8)
    {
      arrays[2].numbers[i] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return arrays;
}

/// The numbers of some of the samples.
inline std::vector<Array> slice(std::vector<Array> arrays, std::size_t first, std::size_t count)
{
  for (Array& array : arrays)
  {
    const auto components = static_cast<std::size_t>(array.components);
    const double* const begin = array.numbers.data() + components * first;
    array.numbers = Numbers(begin, begin + components * count);
  }
  return arrays;
}

} // namespace places
