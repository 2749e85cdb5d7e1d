// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FilterTesting_h
#define FilterTesting_h

#include "vtkScatteredIsopointFilter.h"

#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

/// Shared by the tests of the filter.
namespace filtertesting
{

template <class TArray = vtkFloatArray>
vtkSmartPointer<TArray> newArray(const char* name, vtkIdType tuples, int components = 1)
{
  auto array = vtkSmartPointer<TArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

/// Random points in a cube of side 2 around the origin, with the arrays "distance" (to the origin,
/// the active scalars), "x" and "position".
inline vtkSmartPointer<vtkPolyData> newCloud(vtkIdType count, int pointType = VTK_FLOAT)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(pointType);
  points->SetNumberOfPoints(count);
  const auto distance = newArray<vtkDoubleArray>("distance", count);
  const auto x = newArray("x", count);
  const auto position = newArray("position", count, 3);
  std::mt19937 random(1);
  for (vtkIdType i = 0; i < count; ++i)
  {
    double p[3];
    for (double& coordinate : p)
    {
      coordinate = static_cast<float>(random() * 0x1p-31 - 1.0);
    }
    points->SetPoint(i, p);
    position->SetTuple(i, p);
    x->SetValue(i, static_cast<float>(p[0]));
    distance->SetValue(i, std::hypot(p[0], p[1], p[2]));
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  cloud->GetPointData()->SetScalars(distance);
  cloud->GetPointData()->AddArray(x);
  cloud->GetPointData()->AddArray(position);
  return cloud;
}

/// Counts a filter's errors and keeps the last message.
class ErrorWatcher : public vtkCommand
{
public:
  static ErrorWatcher* New() { return new ErrorWatcher; }

  void Execute(vtkObject*, unsigned long, void* message) override
  {
    ++this->Count;
    this->Last = static_cast<const char*>(message);
  }

  int Count = 0;
  std::string Last;
};

inline vtkSmartPointer<ErrorWatcher> watchErrors(vtkScatteredContourFilter* filter)
{
  const auto watcher = vtkSmartPointer<ErrorWatcher>::Take(ErrorWatcher::New());
  filter->AddObserver(vtkCommand::ErrorEvent, watcher);
  return watcher;
}

inline std::vector<double> pointsOf(vtkPolyData* output)
{
  std::vector<double> coordinates;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    coordinates.insert(coordinates.end(), output->GetPoint(i), output->GetPoint(i) + 3);
  }
  return coordinates;
}

inline void expectEmpty(vtkPolyData* output)
{
  EXPECT_EQ(output->GetNumberOfPoints(), 0);
  EXPECT_EQ(output->GetNumberOfCells(), 0);
}

} // namespace filtertesting

#endif
