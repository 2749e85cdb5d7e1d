// SPDX-License-Identifier: GPL-3.0-or-later
#include "AccuracySamples.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace accuracy
{
namespace
{

using analytic::Vector;

class Random : public clouds::Random
{
public:
  using clouds::Random::Random;

  double inSide() { return 2.0 * (*this)() - 1.0; }

  Vector inCube()
  {
    const double x = this->inSide();
    const double y = this->inSide();
    return { x, y, this->inSide() };
  }

  /// Normally distributed with the standard deviation 1, by the method of Box and Muller.
  double normal()
  {
    const double size = std::sqrt(-2.0 * std::log(1.0 - (*this)()));
    return size * std::cos(2.0 * 3.14159265358979323846 * (*this)());
  }
};

bool isInCube(const Vector& p)
{
  return std::all_of(p.begin(), p.end(), [](double c) { return std::abs(c) <= 1.0; });
}

std::vector<Vector> uniform(std::size_t count)
{
  Random random(11);
  std::vector<Vector> positions(count);
  std::generate(positions.begin(), positions.end(), [&]() { return random.inCube(); });
  return positions;
}

std::vector<Vector> clustered(std::size_t count)
{
  constexpr double uniformShare = 0.3;
  constexpr double width = 0.15;
  Random random(12);
  std::array<Vector, 12> centers;
  std::generate(centers.begin(), centers.end(), [&]() { return random.inCube(); });
  std::vector<Vector> positions;
  while (positions.size() < count)
  {
    Vector p = random.inCube();
    if (random() >= uniformShare)
    {
      p = centers[static_cast<std::size_t>(random() * centers.size())];
      for (double& coordinate : p)
      {
        coordinate += width * random.normal();
      }
    }
    if (isInCube(p))
    {
      positions.push_back(p);
    }
  }
  return positions;
}

std::vector<Vector> jittered(std::size_t count)
{
  constexpr double jitter = 0.4;
  Random random(13);
  const auto n = static_cast<std::size_t>(std::round(std::cbrt(static_cast<double>(count))));
  const double cell = 2.0 / static_cast<double>(n);
  std::vector<Vector> positions;
  for (std::size_t i = 0; i < n * n * n; ++i)
  {
    Vector p;
    const std::array<std::size_t, 3> index{ i % n, i / n % n, i / n / n };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      p[axis] = -1.0 + cell * (static_cast<double>(index[axis]) + 0.5 + jitter * random.inSide());
    }
    positions.push_back(p);
  }
  return positions;
}

std::vector<Vector> lines(std::size_t count)
{
  constexpr double anisotropy = 4.0;
  Random random(14);
  const double step = meanSpacing(count) / std::cbrt(anisotropy * anisotropy);
  const auto perLine = static_cast<std::size_t>(2.0 / step);
  std::vector<Vector> positions;
  for (std::size_t line = 0; line < count / perLine; ++line)
  {
    const double x = random.inSide();
    const double y = random.inSide();
    const double phase = random();
    for (std::size_t i = 0; i < perLine; ++i)
    {
      positions.push_back(
        { x, y, -1.0 + 2.0 * (static_cast<double>(i) + phase) / static_cast<double>(perLine) });
    }
  }
  return positions;
}

} // namespace

double meanSpacing(std::size_t count)
{
  return 2.0 / std::cbrt(static_cast<double>(count));
}

std::vector<Vector> positionsOf(const std::string& sampling, std::size_t count)
{
  if (sampling == "uniform")
  {
    return uniform(count);
  }
  if (sampling == "clustered")
  {
    return clustered(count);
  }
  if (sampling == "jittered")
  {
    return jittered(count);
  }
  if (sampling == "lines")
  {
    return lines(count);
  }
  throw std::invalid_argument("there is no sampling named " + sampling);
}

double deviationOf(const analytic::Surface& surface)
{
  constexpr int count = 100000;
  Random random(15);
  double sum = 0.0;
  double sumOfSquares = 0.0;
  for (int i = 0; i < count; ++i)
  {
    const double value = surface.value(random.inCube());
    sum += value;
    sumOfSquares += value * value;
  }
  return std::sqrt(sumOfSquares / count - (sum / count) * (sum / count));
}

vtkSmartPointer<vtkPolyData> sampled(
  const analytic::Surface& surface, const std::vector<Vector>& positions, double noiseDeviation)
{
  Random random(16);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> values;
  values->SetName("value");
  for (const Vector& p : positions)
  {
    points->InsertNextPoint(p.data());
    values->InsertNextValue(surface.value(p) + noiseDeviation * random.normal());
  }
  auto samples = vtkSmartPointer<vtkPolyData>::New();
  samples->SetPoints(points);
  samples->GetPointData()->SetScalars(values);
  return samples;
}

std::vector<Vector> gridPositions(std::size_t count)
{
  const auto n = static_cast<std::size_t>(std::round(std::cbrt(static_cast<double>(count))));
  const auto coordinate = [n](std::size_t i)
  { return -1.0 + 2.0 * static_cast<double>(i) / static_cast<double>(n - 1); };
  std::vector<Vector> positions;
  for (std::size_t i = 0; i < n * n * n; ++i)
  {
    positions.push_back({ coordinate(i % n), coordinate(i / n % n), coordinate(i / n / n) });
  }
  return positions;
}

} // namespace accuracy
