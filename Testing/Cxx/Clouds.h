// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef Clouds_h
#define Clouds_h

#include "Random.h"

#include "Core/IsosurfaceExtractor.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <optional>
#include <thread>
#include <vector>

namespace clouds
{

/// How much a long test looks at: less under the thread sanitizer, where all takes twenty times as
/// long.
constexpr std::size_t lessIfSlow(std::size_t count)
{
#ifdef __SANITIZE_THREAD__
  return count / 4;
#else
  return count;
#endif
}

/// Samples for the tests; ids are indices.
struct Cloud
{
  std::vector<double> positions; // x y z each
  std::vector<double> values;

  std::size_t size() const { return this->values.size(); }

  void add(double x, double y, double z, double value)
  {
    for (const double coordinate : { x, y, z })
    {
      this->positions.push_back(coordinate);
    }
    this->values.push_back(value);
  }
};

/// A smooth field with several sheets in the unit cube.
inline double waves(double x, double y, double z)
{
  return std::sin(7.0 * x) + std::cos(5.0 * y + x) + std::sin(6.0 * z - 2.0 * y);
}

inline Cloud uniform(std::size_t count, std::uint64_t seed)
{
  Random random(seed);
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double x = random();
    const double y = random();
    const double z = random();
    cloud.add(x, y, z, waves(x, y, z));
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
    const double x = scale * (random() - 0.5);
    const double y = scale * (random() - 0.5);
    const double z = scale * (random() - 0.5);
    cloud.add(x, y, z, waves(x / scale, y, z) + std::log(scale));
  }
  return cloud;
}

/// A regular lattice, in the order of an image's points.
inline Cloud lattice(int nx, int ny, int nz)
{
  Cloud cloud;
  for (int z = 0; z < nz; ++z)
  {
    for (int y = 0; y < ny; ++y)
    {
      for (int x = 0; x < nx; ++x)
      {
        cloud.add(x, y, z, std::round(5.0 * waves(0.1 * x, 0.1 * y, 0.1 * z)));
      }
    }
  }
  return cloud;
}

/// Coordinates and values from a few whole numbers: many samples share planes, lines and positions.
inline Cloud coarse(std::size_t count, int steps, std::uint64_t seed)
{
  Random random(seed);
  Cloud cloud;
  const auto step = [&]() { return std::floor(steps * random()); };
  for (std::size_t i = 0; i < count; ++i)
  {
    const double x = step();
    const double y = step();
    const double z = step();
    cloud.add(x, y, z, std::floor(10.0 * random()));
  }
  return cloud;
}

/// Keeps the first coordinates, as many as `dimensions`; the others become constant.
inline Cloud flattened(Cloud cloud, int dimensions)
{
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    for (int axis = dimensions; axis < 3; ++axis)
    {
      cloud.positions[3 * i + axis] = 0.25;
    }
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
    const double x = i % 2 ? -depth * (1.0 + random()) : 4.0 + random();
    const double y = random();
    const double z = random();
    cloud.add(x, y, z, i % 3 ? 0.0 : 1.0);
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
    double position[3];
    position[line % 3] = place();
    position[(line + 1) % 3] = offsets[2 * line];
    position[(line + 2) % 3] = offsets[2 * line + 1];
    cloud.add(position[0], position[1], position[2],
      line % 2 ? random() - 0.25 : waves(position[0], position[1], position[2]));
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
    if (i % 3 == 0)
    {
      cloud.add(x, y, 0.0, value);
    }
    else if (i % 3 == 1)
    {
      cloud.add(1.0 + x, 0.0, y, -value);
    }
    else
    {
      cloud.add(0.0, 0.0, t - 3.14159, value + 0.5);
    }
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
        for (std::size_t begin = next.fetch_add(grain); begin < count;
             begin = next.fetch_add(grain))
        {
          task(begin, std::min(begin + grain, count));
        }
      };
      std::vector<std::thread> helpers;
      for (std::size_t i = 1; i < threads; ++i)
      {
        helpers.emplace_back(work);
      }
      work();
      for (std::thread& helper : helpers)
      {
        helper.join();
      }
    };
  }
  return execution;
}

/// Reads a cloud for an extractor.
inline auto readerOf(const Cloud& cloud)
{
  return [&cloud](std::size_t id, auto* position, auto& value)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      position[axis] = static_cast<std::decay_t<decltype(*position)>>(
        cloud.positions[3 * id + static_cast<std::size_t>(axis)]);
    }
    value = static_cast<std::decay_t<decltype(value)>>(cloud.values[id]);
    return true;
  };
}

/// The isosurface of a loaded cloud.
template <class TExtractor>
isopoint::Isosurface extractFrom(TExtractor&& extractor, const isopoint::Execution& execution,
  double isovalue, double angle = isopoint::defaultAngle, bool dropsGaps = false,
  std::optional<isopoint::FitRequest> fit = std::nullopt)
{
  isopoint::ExtractionRequest request;
  request.isosurface = { isovalue, angle, dropsGaps, fit };
  return extractor.extract(execution, request).surface;
}

template <class TCoordinate = double, class TValue = double>
isopoint::Isosurface extract(const Cloud& cloud, double isovalue, double angle,
  std::size_t threads = 1, bool dropsGaps = false)
{
  const isopoint::Execution execution = executionOn(threads);
  isopoint::IsosurfaceExtractor extractor;
  extractor.load<TCoordinate, TValue>(execution, cloud.size(), readerOf(cloud));
  return extractFrom(extractor, execution, isovalue, angle, dropsGaps);
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

/// The same samples with the values of a field of the position, an isopoint::Vector.
template <class Field>
Cloud withValuesOf(Cloud cloud, const Field& field)
{
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const double* const p = cloud.positions.data() + 3 * i;
    cloud.values[i] = field({ p[0], p[1], p[2] });
  }
  return cloud;
}

} // namespace clouds

#endif
