// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds that are hard on a kd-tree, each timed beside a uniform one of the same size.
#include "vtkScatteredIsopointFilter.h"

#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace
{

using Position = std::array<float, 3>;

struct Cloud
{
  std::vector<Position> positions;
  std::vector<float> values;
};

/// Uniform numbers in [0, 1), the same on every platform.
class Random
{
public:
  float operator()() { return static_cast<float>(this->Generator() >> 40) * 0x1p-24f; }

private:
  std::mt19937_64 Generator{ 1 };
};

constexpr const char* usage =
  "usage: IsopointAdversaries [SAMPLES]\n"
  "Contours clouds that are hard on a kd-tree, of SAMPLES samples each (default: 1000000), and prints\n"
  "a Markdown table of their times relative to that of a uniform cloud. Exits with 1 if any of them\n"
  "takes more than five times as long.\n";

float distanceToMiddle(const Position& p)
{
  return std::hypot(p[0] - 0.5f, p[1] - 0.5f, p[2] - 0.5f);
}

/// The cloud of the positions positionAt(i), with the distance to the center as values.
Cloud cloudOf(std::size_t count, const std::function<Position(std::size_t)>& positionAt)
{
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i)
  {
    cloud.positions.push_back(positionAt(i));
    cloud.values.push_back(distanceToMiddle(cloud.positions.back()));
  }
  return cloud;
}

Cloud uniform(std::size_t count)
{
  Random random;
  return cloudOf(count, [&](std::size_t) { return Position{ random(), random(), random() }; });
}

Cloud ordered(Cloud cloud, const std::function<bool(const Position&, const Position&)>& before)
{
  std::sort(cloud.positions.begin(), cloud.positions.end(), before);
  return cloudOf(cloud.positions.size(), [&](std::size_t i) { return cloud.positions[i]; });
}

/// Ascending coordinates and then descending ones.
Cloud organPipe(std::size_t count)
{
  const Cloud sorted = ordered(uniform(count), std::less<Position>());
  return cloudOf(count,
    [&](std::size_t i) { return sorted.positions[i < count / 2 ? 2 * i : 2 * (count - i) - 1]; });
}

Cloud lattice(std::size_t count)
{
  const auto n = static_cast<std::size_t>(std::round(std::cbrt(static_cast<double>(count))));
  const auto coordinate = [n](std::size_t i)
  { return static_cast<float>(i) / static_cast<float>(n - 1); };
  return cloudOf(n * n * n,
    [&](std::size_t i) {
      return Position{ coordinate(i % n), coordinate(i / n % n), coordinate(i / n / n) };
    });
}

Cloud flattened(std::size_t count, int dimensions)
{
  Cloud cloud = uniform(count);
  for (Position& position : cloud.positions)
  {
    std::fill(position.begin() + dimensions, position.end(), 0.5f);
  }
  return cloudOf(count, [&](std::size_t i) { return cloud.positions[i]; });
}

/// A share of the samples at one position; their values stay those of their former positions.
Cloud coincident(std::size_t count, double share)
{
  Cloud cloud = uniform(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    if (static_cast<double>(i % 100) < 100.0 * share)
    {
      cloud.positions[i] = { 0.9f, 0.5f, 0.5f };
    }
  }
  return cloud;
}

Cloud doubled(std::size_t count)
{
  Random random;
  Position last{};
  return cloudOf(count,
    [&](std::size_t i) {
      return last = i % 2 ? last : Position{ random(), random(), random() };
    });
}

/// A layer of samples, a single one in front of its middle, and as many again far behind that one.
/// The cell of the single one touches the cells of all in the layer.
Cloud layerBeforeOne(std::size_t count)
{
  Random random;
  const float depth = 1.0f / std::sqrt(static_cast<float>(count));
  Cloud cloud = cloudOf(count,
    [&](std::size_t i)
    {
      if (i == 0)
      {
        return Position{ depth, 0.5f, 0.5f };
      }
      return Position{ i % 2 ? -depth * (1.0f + random()) : 4.0f + random(), random(), random() };
    });
  for (std::size_t i = 0; i < count; ++i)
  {
    cloud.values[i] = cloud.positions[i][0] < 0.0f ? 0.0f : 0.8f;
  }
  return cloud;
}

/// The same with a quarter of all samples at the position of the single one.
Cloud layerBeforeCoincident(std::size_t count)
{
  Cloud cloud = layerBeforeOne(count);
  for (std::size_t i = 0; i < count; i += 4)
  {
    cloud.positions[i] = cloud.positions[0];
  }
  return cloud;
}

/// Two layers of samples close to each other, and a few in front of their middle: long edges with
/// most samples beside their ends, none of them behind.
Cloud doubleLayerBeforeFew(std::size_t count)
{
  Random random;
  const float depth = 1.0f / std::sqrt(static_cast<float>(count));
  Cloud cloud = cloudOf(count,
    [&](std::size_t i)
    {
      return i < 1000 ? Position{ 0.5f + depth * random(), 0.5f + depth * random(),
        0.5f + depth * random() }
                      : Position{ i % 2 ? 0.0f : -depth, random(), random() };
    });
  for (std::size_t i = 0; i < count; ++i)
  {
    cloud.values[i] = i < 1000 ? 0.0f : 0.8f;
  }
  return cloud;
}

/// Two skew lines at right angles, the Delaunay tetrahedrization of which has quadratic size.
Cloud skewLines(std::size_t count)
{
  Random random;
  return cloudOf(count,
    [&](std::size_t i) {
      return i % 2 ? Position{ 0.25f, random(), 0.5f } : Position{ 0.75f, 0.5f, random() };
    });
}

Cloud clustered(std::size_t count)
{
  Random random;
  return cloudOf(count,
    [&](std::size_t)
    {
      const float scale = std::pow(10.0f, -6.0f * random());
      return Position{ 0.9f + scale * (random() - 0.5f), 0.5f + scale * (random() - 0.5f),
        0.5f + scale * (random() - 0.5f) };
    });
}

Cloud onSphere(std::size_t count)
{
  Cloud cloud = uniform(count);
  for (std::size_t i = 1; i < count; ++i)
  {
    Position& p = cloud.positions[i];
    const float length = distanceToMiddle(p);
    for (float& coordinate : p)
    {
      coordinate = 0.5f + (coordinate - 0.5f) / length;
    }
    cloud.values[i] = 1.0f;
  }
  cloud.positions[0] = { 0.5f, 0.5f, 0.5f };
  cloud.values[0] = 0.0f;
  return cloud;
}

Cloud scaled(Cloud cloud, float scale)
{
  for (Position& position : cloud.positions)
  {
    for (float& coordinate : position)
    {
      coordinate *= scale;
    }
  }
  return cloud;
}

Cloud withValues(Cloud cloud, const std::function<float(float)>& valueOf)
{
  std::transform(cloud.values.begin(), cloud.values.end(), cloud.values.begin(), valueOf);
  return cloud;
}

struct Measured
{
  double seconds;
  vtkIdType isopoints;
};

/// The faster one of two updates of new filters.
Measured measure(const Cloud& cloud, double isovalue)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> values;
  points->SetNumberOfPoints(static_cast<vtkIdType>(cloud.positions.size()));
  values->SetNumberOfValues(static_cast<vtkIdType>(cloud.positions.size()));
  for (std::size_t i = 0; i < cloud.positions.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), cloud.positions[i].data());
    values->SetValue(static_cast<vtkIdType>(i), cloud.values[i]);
  }
  vtkNew<vtkPolyData> input;
  input->SetPoints(points);
  input->GetPointData()->SetScalars(values);
  Measured measured{};
  for (int run = 0; run < 2; ++run)
  {
    vtkNew<vtkScatteredIsopointFilter> filter;
    filter->SetInputData(input);
    filter->SetValue(0, isovalue);
    const auto start = std::chrono::steady_clock::now();
    filter->Update();
    const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    measured.seconds = run == 0 ? seconds : std::min(seconds, measured.seconds);
    measured.isopoints = filter->GetOutput()->GetNumberOfPoints();
  }
  return measured;
}

} // namespace

int main(int argumentCount, char** arguments)
{
  std::size_t count = 1000000;
  if (argumentCount > 1)
  {
    const bool isHelp = std::string(arguments[1]) == "--help";
    char* end = nullptr;
    const double number = std::strtod(arguments[1], &end);
    constexpr double fewest = 1000.0;
    if (isHelp || argumentCount > 2 || *end != '\0' || !(number >= fewest))
    {
      std::fputs(usage, isHelp ? stdout : stderr);
      return isHelp ? 0 : 2;
    }
    count = static_cast<std::size_t>(number);
  }
  constexpr double isovalue = 0.4;
  const auto backwards = [](const Position& a, const Position& b) {
    return Position{ a[2], a[1], a[0] } > Position{ b[2], b[1], b[0] };
  };
  const std::vector<std::pair<std::string, std::function<Cloud()>>> clouds{
    { "sorted", [&]() { return ordered(uniform(count), std::less<Position>()); } },
    { "sorted backwards along z", [&]() { return ordered(uniform(count), backwards); } },
    { "organ pipe", [&]() { return organPipe(count); } },
    { "lattice", [&]() { return lattice(count); } },
    { "coplanar", [&]() { return flattened(count, 2); } },
    { "collinear", [&]() { return flattened(count, 1); } },
    { "all at one position", [&]() { return coincident(count, 1.0); } },
    { "90 % at one position", [&]() { return coincident(count, 0.9); } },
    { "each position twice", [&]() { return doubled(count); } },
    { "a cell that touches half of all", [&]() { return layerBeforeOne(count); } },
    { "coincident samples whose cell touches half of all",
      [&]() { return layerBeforeCoincident(count); } },
    { "a double layer before a thousand", [&]() { return doubleLayerBeforeFew(count); } },
    { "two skew lines", [&]() { return skewLines(count); } },
    { "strongly clustered", [&]() { return clustered(count); } },
    { "on a sphere, one inside", [&]() { return onSphere(count); } },
    { "denormal", [&]() { return scaled(uniform(count), 1e-40f); } },
    { "scaled by 1e30", [&]() { return scaled(uniform(count), 1e30f); } },
    { "constant field", [&]() { return withValues(uniform(count), [](float) { return 0.4f; }); } },
    { "a step at the isovalue", [&]()
      { return withValues(uniform(count), [](float v) { return v < 0.4f ? 0.0f : 0.4f; }); } },
  };
  // The uniform cloud is timed again beside each other one, since the machine's load may change.
  const Cloud uniformCloud = uniform(count);
  const Measured base = measure(uniformCloud, isovalue);
  std::printf("| %zu samples | time relative to uniform | isopoints |\n|---|---|---|\n", count);
  std::printf(
    "| uniform | 1 (%.3f s) | %lld |\n", base.seconds, static_cast<long long>(base.isopoints));
  bool isWithinLimit = true;
  for (const auto& [name, make] : clouds)
  {
    const Measured measured = measure(make(), isovalue);
    const double ratio = measured.seconds / measure(uniformCloud, isovalue).seconds;
    std::printf(
      "| %s | %.2f | %lld |\n", name.c_str(), ratio, static_cast<long long>(measured.isopoints));
    std::fflush(stdout);
    isWithinLimit = isWithinLimit && ratio <= 5.0;
  }
  return isWithinLimit ? 0 : 1;
}
