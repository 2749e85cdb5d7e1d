// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Probe.h"

#include "Core/IsosurfaceExtractor.h"
#include "Core/Places/FindNeighborhoods.h"
#include "Core/Places/ProbePlaces.h"
#include "Core/Ranks/ItemNumbers.h"
#include "Core/Ranks/NodeExchange.h"
#include "Core/Tree/Scaling.h"

#include <algorithm>
#include <type_traits>
#include <variant>

namespace isopoint
{

namespace
{

/// Places divided by 2^exponent, as the positions of a cloud.
std::vector<Vector> divided(
  const Execution& execution, const std::vector<Vector>& places, int exponent)
{
  std::vector<Vector> result = places;
  if (exponent != 0)
  {
    forEachIndex(execution, result.size(),
      [&](std::size_t place)
      {
        for (double& coordinate : result[place])
        {
          divide(coordinate, exponent);
        }
      });
  }
  return result;
}

} // namespace

void IsosurfaceExtractor::probe(const Execution& execution, const std::vector<Vector>& places,
  const ProbeOptions& options, const std::vector<ProbedArray>& arrays, std::uint8_t* kinds)
{
  if (this->Processes)
  {
    const Neighborhoods found =
      this->findNeighborhoods(partOf(execution, 0.0, 0.5), places, options);
    if (kinds)
    {
      std::copy(found.kinds.begin(), found.kinds.end(), kinds);
    }
    this->probe(partOf(execution, 0.5, 1.0), found, arrays);
    return;
  }
  std::visit(
    [&](auto& cloud)
    {
      using TSample = std::decay_t<decltype(cloud.tree.samples[0])>;
      OwnNodes<TSample> nodes(execution, cloud.tree);
      forSurroundings(
        execution, cloud.tree, nodes, options, divided(execution, places, cloud.exponent),
        [&]() { return PlaceEvaluator(options, arrays); },
        [&](PlaceEvaluator& evaluator, std::size_t place, const SurroundingsSearch<TSample>& search)
        {
          const std::uint8_t kind = evaluator.enter(search.around());
          evaluator.evaluate(place, search.around(), kind);
          if (kinds)
          {
            kinds[place] = kind;
          }
        });
      divideGradients(execution, arrays, places.size(), cloud.exponent);
    },
    this->Cloud);
  execution.progress(1.0);
}

Neighborhoods IsosurfaceExtractor::findNeighborhoods(
  const Execution& execution, const std::vector<Vector>& places, const ProbeOptions& options)
{
  return std::visit(
    [&](auto& cloud)
    {
      using TSample = std::decay_t<decltype(cloud.tree.samples[0])>;
      const auto find = [&](auto&& nodes)
      {
        Neighborhoods found = neighborhoodsOf(
          execution, cloud.tree, nodes, divided(execution, places, cloud.exponent), options);
        found.exponent = cloud.exponent;
        return found;
      };
      return this->Processes
               ? find(NodeExchange<TSample>(*this->Processes, cloud.tree, cloud.begins))
               : find(OwnNodes<TSample>(execution, cloud.tree));
    },
    this->Cloud);
}

void IsosurfaceExtractor::probe(const Execution& execution, const Neighborhoods& neighborhoods,
  const std::vector<ProbedArray>& arrays)
{
  if (!this->Processes)
  {
    probeNeighborhoods(execution, neighborhoods, arrays);
    return;
  }
  ItemNumbers items(*this->Processes, this->ItemCounts, neighborhoods.ids);
  for (const ProbedArray& array : arrays)
  {
    std::vector<std::vector<double>> numbers; // by component, then index in the neighborhoods' ids
    numbers.reserve(static_cast<std::size_t>(array.components));
    for (int component = 0; component < array.components; ++component)
    {
      numbers.push_back(items.fetch([&](const std::uint64_t* ids, std::size_t count, double* result)
        { array.read(ids, count, component, result); }));
    }
    ProbedArray fetched = array;
    fetched.read = [&numbers](
                     const std::uint64_t* ids, std::size_t count, int component, double* result)
    {
      for (std::size_t i = 0; i < count; ++i)
      {
        result[i] = numbers[static_cast<std::size_t>(component)][ids[i]];
      }
    };
    if (array.writeNearest)
    {
      fetched.writeNearest = [&](std::size_t place, const std::uint64_t* index)
      { array.writeNearest(place, index ? &neighborhoods.ids[*index] : nullptr); };
    }
    probeNeighborhoods(execution, neighborhoods, { fetched }, true);
  }
}

} // namespace isopoint
