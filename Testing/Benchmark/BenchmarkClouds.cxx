// SPDX-License-Identifier: GPL-3.0-or-later
#include "BenchmarkClouds.h"

#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkXMLImageDataReader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

namespace clouds
{
namespace
{

using Position = std::array<double, 3>;

class Random
{
public:
  double operator()() { return static_cast<double>(this->Generator() >> 11) * 0x1p-53; }
  Position inCube()
  {
    const double x = (*this)() - 0.5;
    const double y = (*this)() - 0.5;
    const double z = (*this)() - 0.5;
    return { side * x, side * y, side * z };
  }

private:
  std::mt19937_64 Generator{ 1 };
};

double distanceToCenter(const Position& p)
{
  return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
}

template <class PositionAt, class ValueAt>
vtkSmartPointer<vtkPolyData> makeCloud(
  std::size_t count, const PositionAt& positionAt, const ValueAt& valueAt)
{
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(static_cast<vtkIdType>(count));
  vtkNew<vtkFloatArray> values;
  values->SetName("value");
  values->SetNumberOfTuples(static_cast<vtkIdType>(count));
  for (std::size_t i = 0; i < count; ++i)
  {
    const Position position = positionAt(i);
    std::copy(position.begin(), position.end(), coordinates->GetPointer(0) + 3 * i);
    values->GetPointer(0)[i] = static_cast<float>(valueAt(position));
  }
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  cloud->GetPointData()->SetScalars(values);
  return cloud;
}

/// Trilinear interpolation in an image, at a position in units of its cells.
double interpolated(vtkDataArray* values, const int dimensions[3], const Position& p)
{
  std::array<vtkIdType, 3> cell;
  Position t;
  for (int axis = 0; axis < 3; ++axis)
  {
    cell[axis] = std::min(static_cast<vtkIdType>(p[axis]), vtkIdType{ dimensions[axis] - 2 });
    t[axis] = p[axis] - static_cast<double>(cell[axis]);
  }
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const std::array<int, 3> step{ corner & 1, (corner >> 1) & 1, corner >> 2 };
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      weight *= step[axis] ? t[axis] : 1.0 - t[axis];
    }
    const vtkIdType id =
      cell[0] + step[0] + dimensions[0] * (cell[1] + step[1] + dimensions[1] * (cell[2] + step[2]));
    sum += weight * values->GetComponent(id, 0);
  }
  return sum;
}

} // namespace

vtkSmartPointer<vtkPolyData> uniform(std::size_t count)
{
  Random random;
  return makeCloud(
    count, [&](std::size_t) { return random.inCube(); }, distanceToCenter);
}

vtkSmartPointer<vtkPolyData> clustered(std::size_t count)
{
  // Distances from the cluster's center are uniform, so that density decreases with their square.
  Random random;
  const Position middle{ 70.0, 0.0, 0.0 };
  const auto positionAt = [&](std::size_t)
  {
    for (;;)
    {
      const double distance = 1.0 + 99.0 * random();
      Position p = random.inCube();
      const double length = distanceToCenter(p);
      for (int axis = 0; axis < 3; ++axis)
      {
        p[axis] = middle[axis] + distance * p[axis] / length;
      }
      if (std::all_of(p.begin(), p.end(), [](double c) { return std::abs(c) < side / 2; }))
      {
        return p;
      }
    }
  };
  return makeCloud(count, positionAt, distanceToCenter);
}

vtkSmartPointer<vtkPolyData> slab(std::size_t count)
{
  Random random;
  const auto positionAt = [&](std::size_t)
  {
    Position p = random.inCube();
    p[2] /= 20.0;
    return p;
  };
  return makeCloud(count, positionAt, distanceToCenter);
}

vtkSmartPointer<vtkPolyData> lattice(std::size_t count)
{
  const auto n = static_cast<std::size_t>(std::round(std::cbrt(static_cast<double>(count))));
  const double spacing = side / static_cast<double>(n);
  const auto coordinate = [=](std::size_t i)
  { return spacing * (static_cast<double>(i) + 0.5) - side / 2; };
  const auto positionAt = [=](std::size_t i) {
    return Position{ coordinate(i % n), coordinate(i / n % n), coordinate(i / n / n) };
  };
  return makeCloud(n * n * n, positionAt, distanceToCenter);
}

vtkSmartPointer<vtkPolyData> resampled(const std::string& file, std::size_t count)
{
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkImageData* const image = reader->GetOutput();
  vtkDataArray* const values = image->GetPointData()->GetArray(0);
  int dimensions[3];
  image->GetDimensions(dimensions);
  if (!values || *std::min_element(dimensions, dimensions + 3) < 2)
  {
    throw std::runtime_error(file + " is not a VTK XML image of a volume with point data");
  }
  Random random;
  const auto positionAt = [&](std::size_t)
  {
    Position p;
    for (int axis = 0; axis < 3; ++axis)
    {
      p[axis] = random() * (dimensions[axis] - 1);
    }
    return p;
  };
  return makeCloud(
    count, positionAt, [&](const Position& p) { return interpolated(values, dimensions, p); });
}

} // namespace clouds
