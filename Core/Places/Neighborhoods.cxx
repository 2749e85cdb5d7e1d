// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Places/Neighborhoods.h"

#include "Core/Tree/Scaling.h"

#include <algorithm>
#include <utility>

namespace isopoint
{

void Neighborhoods::surroundings(std::size_t place, bool isNumbered, NearbySamples& result) const
{
  result.clear();
  for (std::size_t i = this->begins[place]; i < this->begins[place + 1]; ++i)
  {
    const std::uint32_t position = this->around[i];
    result.offsets.push_back(this->positions[position] - this->places[place]);
    for (std::size_t id = this->idBegins[position]; id < this->idBegins[position + 1]; ++id)
    {
      result.ids.push_back(isNumbered ? id : this->ids[id]);
    }
    result.idBegins.push_back(result.ids.size());
  }
  result.reach = this->reaches[place];
  result.fitted = std::min(fittedCount(this->options.method), result.offsets.size());
}

void probeNeighborhoods(const Execution& execution, const Neighborhoods& neighborhoods,
  const std::vector<ProbedArray>& arrays, bool areNumbered)
{
  using Worker = std::pair<PlaceEvaluator, NearbySamples>;
  forEachItem(
    execution, { neighborhoods.places.size(), 2048, 256 },
    [&]() { return Worker(PlaceEvaluator(neighborhoods.options, arrays), NearbySamples()); },
    [&](Worker& worker, std::size_t place)
    {
      neighborhoods.surroundings(place, areNumbered, worker.second);
      worker.first.evaluateAgain(place, worker.second, neighborhoods.kinds[place],
        neighborhoods.weights.empty()
          ? nullptr
          : neighborhoods.weights.data() + laneCount * neighborhoods.begins[place]);
    },
    execution.progress);
  divideGradients(execution, arrays, neighborhoods.places.size(), neighborhoods.exponent);
}

void divideGradients(const Execution& execution, const std::vector<ProbedArray>& arrays,
  std::size_t places, int exponent)
{
  for (const ProbedArray& array : arrays)
  {
    if (array.gradients && exponent != 0)
    {
      forEachIndex(execution, 3 * static_cast<std::size_t>(array.components) * places,
        [&](std::size_t i) { divide(array.gradients[i], exponent); });
    }
  }
}

} // namespace isopoint
