// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Random.h"

#include "Core/Base/Vector.h"
#include "Core/IsosurfaceExtractor.h"

// Also those that most tests need.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

namespace clouds
{

using isopoint::Vector;

/// The size of a long test: smaller under the thread sanitizer, which is twenty times slower.
constexpr std::size_t lessIfSlow(std::size_t count)
{
#ifdef __SANITIZE_THREAD__
  return count / 4;
#else
  return count;
#endif
}

/// The sum of a number of each item.
template <class Items, class Number>
double sumOf(const Items& items, const Number& number)
{
  return std::accumulate(std::begin(items), std::end(items), 0.0,
    [&](double sum, const auto& item) { return sum + number(item); });
}

/// The largest of a number of each item.
template <class Items, class Number>
double largestOf(const Items& items, const Number& number)
{
  return std::accumulate(std::begin(items), std::end(items),
    -std::numeric_limits<double>::infinity(),
    [&](double largest, const auto& item)
    { return std::max(largest, static_cast<double>(number(item))); });
}

/// How many items a condition holds for.
template <class Items, class Condition>
std::size_t countOf(const Items& items, const Condition& condition)
{
  return static_cast<std::size_t>(std::count_if(std::begin(items), std::end(items), condition));
}

/// Samples for the tests; ids are indices.
struct Cloud
{
  std::vector<double> positions; // x y z each
  std::vector<double> values;

  std::size_t size() const { return this->values.size(); }

  Vector at(std::size_t i) const
  {
    return { this->positions[3 * i], this->positions[3 * i + 1], this->positions[3 * i + 2] };
  }

  void add(const Vector& position, double value)
  {
    this->positions.insert(this->positions.end(), position.begin(), position.end());
    this->values.push_back(value);
  }

  void add(double x, double y, double z, double value) { this->add({ x, y, z }, value); }
};

/// The same samples with the values of a field of the position.
template <class Field>
Cloud withValuesOf(Cloud cloud, const Field& field)
{
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    cloud.values[i] = field(cloud.at(i));
  }
  return cloud;
}

/// The same samples at other positions: move(double*) changes one.
template <class Move>
Cloud moved(Cloud cloud, Move move)
{
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    move(cloud.positions.data() + 3 * i);
  }
  return cloud;
}

inline Cloud scaled(const Cloud& cloud, double x, double y, double z)
{
  return moved(cloud,
    [=](double* p)
    {
      p[0] *= x;
      p[1] *= y;
      p[2] *= z;
    });
}

/// The samples for whose positions a condition holds.
template <class Condition>
Cloud filtered(const Cloud& cloud, Condition condition)
{
  Cloud rest;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    if (condition(cloud.at(i)))
    {
      rest.add(cloud.at(i), cloud.values[i]);
    }
  }
  return rest;
}

/// The samples in another order.
inline Cloud permuted(const Cloud& cloud, const std::vector<std::size_t>& order)
{
  Cloud result;
  for (const std::size_t id : order)
  {
    result.add(cloud.at(id), cloud.values[id]);
  }
  return result;
}

/// The numbers below a count in random order.
inline std::vector<std::size_t> randomOrder(std::size_t count, std::uint64_t seed)
{
  Random random(seed);
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  for (std::size_t i = count - 1; i > 0; --i)
  {
    std::swap(order[i], order[static_cast<std::size_t>(random() * static_cast<double>(i + 1))]);
  }
  return order;
}

/// A smooth field with several sheets in the unit cube.
inline double waves(const Vector& p)
{
  return std::sin(7.0 * p[0]) + std::cos(5.0 * p[1] + p[0]) + std::sin(6.0 * p[2] - 2.0 * p[1]);
}

/// The distance to the middle of the unit cube.
inline double fromMiddle(const Vector& p)
{
  return isopoint::lengthOf(p - Vector{ 0.5, 0.5, 0.5 });
}

inline Cloud uniform(std::size_t count, std::uint64_t seed)
{
  Random random(seed);
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vector p = random.place();
    cloud.add(p, waves(p));
  }
  return cloud;
}

/// Density varies over many orders of magnitude.
inline Cloud clustered(std::size_t count, std::uint64_t seed)
{
  Random random(seed);
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double scale = std::pow(10.0, -4.0 * random());
    const auto [x, y, z] = random.inCube(scale);
    cloud.add(x, y, z, waves({ x / scale, y, z }) + std::log(scale));
  }
  return cloud;
}

/// A regular lattice, in the order of an image's points.
inline Cloud lattice(int nx, int ny, int nz)
{
  Cloud cloud;
  for (int i = 0; i < nx * ny * nz; ++i)
  {
    const Vector p{ 1.0 * (i % nx), 1.0 * (i / nx % ny), 1.0 * (i / nx / ny) };
    cloud.add(p, std::round(5.0 * waves(0.1 * p)));
  }
  return cloud;
}

/// Coordinates and values from a few whole numbers: many samples share planes, lines and positions.
inline Cloud coarse(std::size_t count, int steps, std::uint64_t seed)
{
  Random random(seed);
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto [x, y, z] = random.place();
    cloud.add(std::floor(steps * x), std::floor(steps * y), std::floor(steps * z),
      std::floor(10.0 * random()));
  }
  return cloud;
}

/// Keeps the first coordinates, as many as `dimensions`; the others become constant.
inline Cloud flattened(const Cloud& cloud, int dimensions)
{
  return moved(cloud, [dimensions](double* p) { std::fill(p + dimensions, p + 3, 0.25); });
}

/// Rounds coordinates and values to float.
inline Cloud roundedToFloat(Cloud cloud)
{
  for (std::vector<double>* const numbers : { &cloud.positions, &cloud.values })
  {
    std::copy_n(std::vector<float>(numbers->begin(), numbers->end()).begin(), numbers->size(),
      numbers->begin());
  }
  return cloud;
}

/// Moves a share of the samples to one position.
inline Cloud coincident(Cloud cloud, double share)
{
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    if (static_cast<double>((i * 7919) % cloud.size()) < share * static_cast<double>(cloud.size()))
    {
      std::copy_n(cloud.positions.begin(), 3, cloud.positions.begin() + 3 * i);
    }
  }
  return cloud;
}

/// Nested groups of coincident samples: each group has half of the samples that remain, and three
/// more samples around it, so that separating it from the rest takes four levels of the tree.
inline Cloud nestedCoincident(std::size_t count)
{
  Cloud cloud;
  double center = 0.0;
  double size = 1.0;
  for (std::size_t remaining = count; remaining >= 10; remaining -= remaining / 2 + 3)
  {
    for (std::size_t i = 0; i < remaining / 2; ++i)
    {
      cloud.add(center, center, center, static_cast<double>(i % 7));
    }
    cloud.add(center + size, center, center, 9.0);
    cloud.add(center, center + size, center, -9.0);
    cloud.add(center, center, center + size, 9.0);
    center -= 0.3 * size;
    size *= 0.4;
  }
  return cloud;
}

/// A layer of samples, a single one in front of its middle, and as many again far behind that one.
/// The cell of the single one, whose id is 0, touches the cells of all in the layer.
inline Cloud layerBeforeOne(std::size_t count, std::uint64_t seed)
{
  Random random(seed);
  Cloud cloud;
  const double depth = 1.0 / std::sqrt(static_cast<double>(count));
  cloud.add(depth, 0.5, 0.5, 1.0);
  for (std::size_t i = 1; i < count; ++i)
  {
    const auto [x, y, z] = random.place();
    cloud.add(i % 2 ? -depth * (1.0 + x) : 4.0 + x, y, z, i % 3 ? 0.0 : 1.0);
  }
  return cloud;
}

/// Samples on straight lines along the axes, so that cells of one line touch most of those of the
/// others. The values of each line have both signs.
/// @param steps number of possible positions along an axis, so that samples coincide; 0: any
inline Cloud lines(std::size_t count, std::size_t lineCount, int steps, std::uint64_t seed)
{
  Random random(seed);
  Cloud cloud;
  const auto place = [&]() { return steps > 0 ? std::floor(steps * random()) / steps : random(); };
  std::vector<double> offsets(2 * lineCount);
  std::generate(offsets.begin(), offsets.end(), place);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t line = i % lineCount;
    Vector p;
    p[line % 3] = place();
    p[(line + 1) % 3] = offsets[2 * line];
    p[(line + 2) % 3] = offsets[2 * line + 1];
    cloud.add(p, line % 2 ? random() - 0.25 : waves(p));
  }
  return cloud;
}

/// The curve (t, t^2, t^3), with the values t: its tetrahedralization has quadratic size.
inline Cloud momentCurve(std::size_t count)
{
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double t = static_cast<double>(i) / static_cast<double>(count - 1);
    cloud.add(t, t * t, t * t * t, t);
  }
  return cloud;
}

/// Several turns around the z axis, with the values z.
inline Cloud helix(std::size_t count)
{
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double z = static_cast<double>(i) / static_cast<double>(count - 1);
    cloud.add(std::cos(40.0 * z), std::sin(40.0 * z), z, z);
  }
  return cloud;
}

/// Two skew lines at right angles, with values along both.
inline Cloud twoSkewLines(std::size_t count)
{
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double place = static_cast<double>(i / 2) / static_cast<double>((count + 1) / 2 - 1);
    i % 2 ? cloud.add(0.5, place - 0.5, 1.0, place) : cloud.add(place, 0.0, 0.0, place);
  }
  return cloud;
}

/// Straight wells, as deep as half the width of the field and tilted by up to 20 degrees, with the
/// depth as values.
inline Cloud tiltedWells(std::size_t wellCount, std::size_t countOfWell, std::uint64_t seed)
{
  Random random(seed);
  Cloud cloud;
  for (std::size_t well = 0; well < wellCount; ++well)
  {
    const Vector top{ random(), random(), 0.0 };
    const Vector step{ 0.6 * (random() - 0.5), 0.6 * (random() - 0.5), -1.0 };
    for (std::size_t i = 0; i < countOfWell; ++i)
    {
      const double depth = 0.5 * static_cast<double>(i) / static_cast<double>(countOfWell - 1);
      cloud.add(top + depth * step, depth);
    }
  }
  return cloud;
}

/// Two layers of parallel lines, one above the other, at right angles to each other.
inline Cloud combs(std::size_t count, int teeth, std::uint64_t seed)
{
  Random random(seed);
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double tooth = std::floor(teeth * random()) / teeth;
    const double place = random();
    const bool isUpper = i % 2 == 1;
    cloud.add(isUpper ? place : tooth, isUpper ? tooth : place, isUpper ? 0.8 : 0.2,
      (isUpper ? 0.5 : -0.5) + random() - 0.5);
  }
  return cloud;
}

/// Two linked circles and a straight line through one of them, with values that vary along them.
inline Cloud curves(std::size_t count, std::uint64_t seed)
{
  Random random(seed);
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double t = 6.28318 * random();
    const double x = std::cos(t);
    const double y = std::sin(t);
    const double value = std::sin(3.0 * t);
    const Vector places[] = { { x, y, 0.0 }, { 1.0 + x, 0.0, y }, { 0.0, 0.0, t - 3.14159 } };
    const double values[] = { value, -value, value + 0.5 };
    cloud.add(places[i % 3], values[i % 3]);
  }
  return cloud;
}

/// Runs on exactly this number of threads, whatever the machine has.
inline isopoint::Execution executionOn(std::size_t threads)
{
  isopoint::Execution execution;
  execution.threads = threads;
  if (threads > 1)
  {
    execution.parallelFor = [threads](
                              std::size_t count, std::size_t grain, const isopoint::RangeTask& task)
    {
      std::atomic<std::size_t> next{ 0 };
      const auto work = [&]()
      {
        const std::size_t ranges = (count + grain - 1) / grain;
        for (std::size_t i = next++; i < ranges; i = next++)
        {
          const std::size_t begin = (ranges - 1 - i) * grain; // the last ones first
          task(begin, std::min(begin + grain, count));
        }
      };
      std::vector<std::thread> helpers;
      for (std::size_t i = 1; i < threads; ++i)
      {
        helpers.emplace_back(work);
      }
      work();
      std::for_each(helpers.begin(), helpers.end(), [](std::thread& helper) { helper.join(); });
    };
  }
  return execution;
}

/// Reads a cloud for an extractor.
inline auto readerOf(const Cloud& cloud)
{
  return [&cloud](std::size_t id, auto* position, auto& value)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      position[axis] =
        static_cast<std::decay_t<decltype(*position)>>(cloud.positions[3 * id + axis]);
    }
    value = static_cast<std::decay_t<decltype(value)>>(cloud.values[id]);
    return true;
  };
}

template <class TCoordinate = double, class TValue = double>
isopoint::IsosurfaceExtractor loaded(const Cloud& cloud, std::size_t threads = 1)
{
  isopoint::IsosurfaceExtractor extractor;
  extractor.load<TCoordinate, TValue>(executionOn(threads), cloud.size(), readerOf(cloud));
  return extractor;
}

/// A request for points alone. Points move to their fits if an order is given.
inline isopoint::ExtractionRequest requestOf(double isovalue,
  std::optional<isopoint::FitOrder> order = std::nullopt, bool dropsGaps = false,
  double angle = isopoint::defaultAngle)
{
  isopoint::ExtractionRequest request;
  request.isosurface = { isovalue, angle, dropsGaps, std::nullopt };
  if (order)
  {
    request.isosurface.fit = isopoint::FitRequest{ order, true };
  }
  return request;
}

inline isopoint::ExtractionRequest withSplats(isopoint::ExtractionRequest request)
{
  request.splats = isopoint::SplatOptions();
  return request;
}

inline isopoint::ExtractionRequest withTriangles(
  isopoint::ExtractionRequest request, bool regularizes = false)
{
  request.triangles = true;
  request.isosurface.regularizes = regularizes;
  return request;
}

template <class TCoordinate = double, class TValue = double>
isopoint::ExtractedIsosurface extracted(
  const Cloud& cloud, const isopoint::ExtractionRequest& request, std::size_t threads = 1)
{
  const isopoint::Execution execution = executionOn(threads);
  return loaded<TCoordinate, TValue>(cloud, threads).extract(execution, request);
}

/// The isosurface of a loaded cloud.
template <class TExtractor>
isopoint::Isosurface extractFrom(TExtractor&& extractor, const isopoint::Execution& execution,
  double isovalue, double angle = isopoint::defaultAngle)
{
  return extractor.extract(execution, requestOf(isovalue, std::nullopt, false, angle)).surface;
}

template <class TCoordinate = double, class TValue = double>
isopoint::Isosurface extract(const Cloud& cloud, double isovalue,
  double angle = isopoint::defaultAngle, std::size_t threads = 1, bool dropsGaps = false)
{
  return extracted<TCoordinate, TValue>(
    cloud, requestOf(isovalue, std::nullopt, dropsGaps, angle), threads)
    .surface;
}

/// Turns a position about two axes: what was on planes and spheres is so except for rounding.
inline void turn(double* p)
{
  const double x = 0.8 * p[0] - 0.6 * p[1];
  const double y = 0.6 * p[0] + 0.8 * p[1];
  const double z = p[2];
  p[0] = x;
  p[1] = 0.28 * y - 0.96 * z;
  p[2] = 0.96 * y + 0.28 * z;
}

} // namespace clouds
