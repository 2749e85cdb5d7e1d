// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef DegenerateTesting_h
#define DegenerateTesting_h

#include "FilterTesting.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

/// Shared by the tests of degenerate clouds and extreme numbers.
namespace degeneratetesting
{

using namespace filtertesting;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

using Sample = std::array<double, 4>; // x y z value

inline vtkSmartPointer<vtkPolyData> cloudOf(const std::vector<Sample>& samples)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const auto f = newArray<vtkDoubleArray>("f", static_cast<vtkIdType>(samples.size()));
  for (const Sample& sample : samples)
  {
    f->SetValue(points->InsertNextPoint(sample.data()), sample[3]);
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  cloud->GetPointData()->SetScalars(f);
  return cloud;
}

/// The output for one isovalue.
struct Surface
{
  vtkSmartPointer<vtkPolyData> Output;
  vtkIdType Skipped = 0;

  vtkIdType count() const { return this->Output->GetNumberOfPoints(); }
  std::array<double, 3> point(vtkIdType i) const
  {
    std::array<double, 3> p;
    this->Output->GetPoint(i, p.data());
    return p;
  }
};

/// Updates a filter, and expects no error, all default arrays, and finite numbers.
inline Surface contour(
  vtkDataSet* input, double isovalue, int projection = vtkScatteredIsopointFilter::CUBIC_FIT)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  const auto errors = watchErrors(filter);
  filter->SetInputData(input);
  filter->SetValue(0, isovalue);
  filter->SetProjection(projection);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->Update();
  EXPECT_EQ(errors->Count, 0) << errors->Last;
  Surface surface{ filter->GetOutput(), filter->GetNumberOfSkippedSamples() };
  for (const char* const name : { "f", "Normals", "Radius" })
  {
    vtkDataArray* const array = surface.Output->GetPointData()->GetArray(name);
    EXPECT_TRUE(array) << name;
    for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
    {
      for (int component = 0; component < array->GetNumberOfComponents(); ++component)
      {
        EXPECT_TRUE(std::isfinite(array->GetComponent(i, component))) << name << " " << i;
      }
    }
  }
  for (const double coordinate : pointsOf(surface.Output))
  {
    EXPECT_TRUE(std::isfinite(coordinate));
  }
  return surface;
}

inline Surface contour(const std::vector<Sample>& samples, double isovalue)
{
  return contour(cloudOf(samples), isovalue);
}

/// Random samples in a cube of side 2 with the distance to its center as values.
inline std::vector<Sample> distances(std::size_t count)
{
  std::mt19937 random(7);
  std::vector<Sample> samples(count);
  for (Sample& sample : samples)
  {
    std::generate_n(sample.begin(), 3, [&]() { return random() * 0x1p-31 - 1.0; });
    sample[3] = std::hypot(sample[0], sample[1], sample[2]);
  }
  return samples;
}

inline std::vector<Sample> changed(
  std::vector<Sample> samples, const std::function<void(Sample&)>& change)
{
  std::for_each(samples.begin(), samples.end(), change);
  return samples;
}

} // namespace degeneratetesting

#endif
