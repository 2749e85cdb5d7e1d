// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "AnalyticSurface.h"

#include "vtkScatteredIsopointFilter.h"
#include "vtkScatteredIsosurfaceFilter.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkCompositeDataIterator.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

/// Shared by the tests of the filters.
namespace filtertesting
{

using analytic::dot;
using analytic::length;
using analytic::Vector;
using Isopoints = vtkScatteredIsopointFilter;
using Isosurface = vtkScatteredIsosurfaceFilter;
using Sample = std::array<double, 4>; // x y z value
using Samples = std::vector<Sample>;

constexpr int ofPoints = vtkDataObject::FIELD_ASSOCIATION_POINTS;
constexpr int ofCells = vtkDataObject::FIELD_ASSOCIATION_CELLS;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

template <class TArray = vtkFloatArray>
vtkSmartPointer<TArray> newArray(const char* name, vtkIdType tuples, int components = 1)
{
  auto array = vtkSmartPointer<TArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

/// An array of numberAt(0), numberAt(1), ...
template <class TArray = vtkDoubleArray, class NumberAt>
vtkSmartPointer<TArray> arrayOf(const char* name, vtkIdType count, const NumberAt& numberAt)
{
  const auto array = newArray<TArray>(name, count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    array->SetValue(i, static_cast<typename TArray::ValueType>(numberAt(i)));
  }
  return array;
}

/// An array of ghost bits.
template <class BitsAt>
vtkSmartPointer<vtkUnsignedCharArray> ghostsOf(vtkIdType count, const BitsAt& bitsAt)
{
  return arrayOf<vtkUnsignedCharArray>(vtkDataSetAttributes::GhostArrayName(), count, bitsAt);
}

/// An array of texts textAt(0), textAt(1), ...
template <class TextAt>
vtkSmartPointer<vtkStringArray> textsOf(const char* name, vtkIdType count, const TextAt& textAt)
{
  auto texts = vtkSmartPointer<vtkStringArray>::New();
  texts->SetName(name);
  for (vtkIdType i = 0; i < count; ++i)
  {
    texts->InsertNextValue(textAt(i));
  }
  return texts;
}

inline Vector placeOf(vtkDataSet* data, vtkIdType point)
{
  Vector place;
  data->GetPoint(point, place.data());
  return place;
}

inline Vector tupleOf(vtkDataArray* array, vtkIdType i)
{
  return { array->GetComponent(i, 0), array->GetComponent(i, 1), array->GetComponent(i, 2) };
}

/// Replaces all positions by moved(position) and marks nothing as modified.
inline void move(vtkPoints* points, const std::function<Vector(const Vector&)>& moved)
{
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    Vector place;
    points->GetPoint(i, place.data());
    points->SetPoint(i, moved(place).data());
  }
}

/// Makes a field of the position the active scalars of the points.
template <class TArray = vtkDoubleArray>
vtkSmartPointer<TArray> setScalars(
  vtkDataSet* data, const std::function<double(const Vector&)>& field, const char* name = "f")
{
  const auto scalars = arrayOf<TArray>(
    name, data->GetNumberOfPoints(), [&](vtkIdType i) { return field(placeOf(data, i)); });
  data->GetPointData()->SetScalars(scalars);
  return scalars;
}

/// The values of newCloud().
inline vtkDoubleArray* distancesOf(vtkDataSet* cloud)
{
  return vtkDoubleArray::SafeDownCast(cloud->GetPointData()->GetArray("distance"));
}

/// Random points in a cube of side 2 around the origin, with the arrays "distance" (to the origin,
/// the active scalars), "x" and "position".
inline vtkSmartPointer<vtkPolyData> newCloud(vtkIdType count, int pointType = VTK_FLOAT)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(pointType);
  points->SetNumberOfPoints(count);
  const auto position = newArray("position", count, 3);
  std::mt19937 random(1);
  for (vtkIdType i = 0; i < count; ++i)
  {
    Vector p;
    std::generate(
      p.begin(), p.end(), [&]() { return static_cast<float>(random() * 0x1p-31 - 1.0); });
    points->SetPoint(i, p.data());
    position->SetTuple(i, p.data());
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  setScalars(
    cloud, [](const Vector& p) { return std::hypot(p[0], p[1], p[2]); }, "distance");
  cloud->GetPointData()->AddArray(
    arrayOf<vtkFloatArray>("x", count, [&](vtkIdType i) { return position->GetComponent(i, 0); }));
  cloud->GetPointData()->AddArray(position);
  return cloud;
}

/// A cloud in double precision with the values "f".
inline vtkSmartPointer<vtkPolyData> cloudOf(const Samples& samples)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Sample& sample : samples)
  {
    points->InsertNextPoint(sample.data());
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  cloud->GetPointData()->SetScalars(arrayOf("f", static_cast<vtkIdType>(samples.size()),
    [&](vtkIdType i) { return samples[static_cast<std::size_t>(i)][3]; }));
  return cloud;
}

/// Each n-th sample of a cloud, from a first one on.
inline vtkSmartPointer<vtkPolyData> everyNth(vtkPolyData* cloud, vtkIdType first, vtkIdType n)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(cloud->GetPoints()->GetDataType());
  auto part = vtkSmartPointer<vtkPolyData>::New();
  part->SetPoints(points);
  part->GetPointData()->CopyAllocate(cloud->GetPointData());
  for (vtkIdType i = first; i < cloud->GetNumberOfPoints(); i += n)
  {
    const vtkIdType copy = points->InsertNextPoint(cloud->GetPoint(i));
    part->GetPointData()->CopyData(cloud->GetPointData(), i, copy);
  }
  return part;
}

/// The points of a cubic lattice of spacing 1 around the origin, with a field of the position.
inline Samples latticeOf(int size, const std::function<double(const Vector&)>& field)
{
  Samples samples;
  for (int i = 0; i < size * size * size; ++i)
  {
    const double half = 0.5 * (size - 1);
    const Vector p{ i % size - half, i / size % size - half, i / size / size - half };
    samples.push_back({ p[0], p[1], p[2], field(p) });
  }
  return samples;
}

/// newCloud() as a grid of vertices, whose arrays are those of its cells.
inline vtkSmartPointer<vtkUnstructuredGrid> newVertexCells(vtkIdType count)
{
  const auto cloud = newCloud(count);
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(cloud->GetPoints());
  for (vtkIdType i = 0; i < count; ++i)
  {
    grid->InsertNextCell(VTK_VERTEX, 1, &i);
  }
  grid->GetCellData()->ShallowCopy(cloud->GetPointData());
  return grid;
}

inline vtkSmartPointer<vtkMultiBlockDataSet> blocksOf(
  const std::vector<vtkSmartPointer<vtkDataObject>>& blocks)
{
  auto all = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (unsigned int i = 0; i < blocks.size(); ++i)
  {
    all->SetBlock(i, blocks[i]);
  }
  return all;
}

/// Keeps the messages of one event of a filter.
class MessageWatcher : public vtkCommand
{
public:
  static MessageWatcher* New() { return new MessageWatcher; }

  void Execute(vtkObject*, unsigned long, void* message) override
  {
    this->All.emplace_back(static_cast<const char*>(message));
  }

  std::size_t count() const { return this->All.size(); }
  std::string last() const { return this->All.empty() ? std::string() : this->All.back(); }

  std::vector<std::string> All;
};

inline vtkSmartPointer<MessageWatcher> watchMessages(vtkObject* filter, unsigned long event)
{
  const auto watcher = vtkSmartPointer<MessageWatcher>::Take(MessageWatcher::New());
  filter->AddObserver(event, watcher);
  return watcher;
}

inline vtkSmartPointer<MessageWatcher> watchErrors(vtkObject* filter)
{
  return watchMessages(filter, vtkCommand::ErrorEvent);
}

template <class TFilter = Isopoints>
vtkSmartPointer<TFilter> newFilter(vtkDataObject* input, double isovalue = 0.7)
{
  auto filter = vtkSmartPointer<TFilter>::New();
  filter->SetInputDataObject(input);
  filter->SetValue(0, isovalue);
  return filter;
}

/// The filters of points and of triangles.
inline std::vector<vtkSmartPointer<vtkScatteredContourFilter>> bothFilters(
  vtkDataObject* input, double isovalue = 0.7)
{
  return { newFilter(input, isovalue), newFilter<Isosurface>(input, isovalue) };
}

/// The output after an update.
inline vtkPolyData* outputOf(vtkScatteredContourFilter* filter)
{
  filter->Update();
  return filter->GetOutput();
}

/// An array of the points or, otherwise, of the cells.
inline vtkDataArray* findArray(vtkPolyData* output, const char* name)
{
  vtkDataArray* const array = output->GetPointData()->GetArray(name);
  return array ? array : output->GetCellData()->GetArray(name);
}

inline std::vector<double> numbersOf(vtkDataArray* array)
{
  std::vector<double> numbers;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    for (int component = 0; component < array->GetNumberOfComponents(); ++component)
    {
      numbers.push_back(array->GetComponent(i, component));
    }
  }
  return numbers;
}

inline std::vector<double> pointsOf(vtkPolyData* output)
{
  return output->GetPoints() ? numbersOf(output->GetPoints()->GetData()) : std::vector<double>();
}

/// A data object, or all blocks of a composite that are not null.
inline std::vector<vtkDataObject*> leavesOf(vtkDataObject* output)
{
  auto* const blocks = vtkCompositeDataSet::SafeDownCast(output);
  if (!blocks)
  {
    return { output };
  }
  std::vector<vtkDataObject*> leaves;
  const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    leaves.push_back(iterator->GetCurrentDataObject());
  }
  return leaves;
}

/// A surface, or those of all blocks.
inline std::vector<vtkPolyData*> surfacesOf(vtkDataObject* output)
{
  std::vector<vtkPolyData*> surfaces;
  for (vtkDataObject* const leaf : leavesOf(output))
  {
    surfaces.push_back(vtkPolyData::SafeDownCast(leaf));
  }
  return surfaces;
}

/// All numbers of a surface or of blocks of surfaces: positions, arrays, and corners of cells.
inline std::vector<double> everythingOf(vtkDataObject* output)
{
  std::vector<double> all;
  const auto append = [&all](const std::vector<double>& more)
  { all.insert(all.end(), more.begin(), more.end()); };
  for (vtkPolyData* const surface : surfacesOf(output))
  {
    append(pointsOf(surface));
    for (const int association : { ofPoints, ofCells })
    {
      vtkDataSetAttributes* const attributes = surface->GetAttributes(association);
      for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
      {
        append(numbersOf(attributes->GetArray(i)));
      }
    }
    append(numbersOf(surface->GetVerts()->GetConnectivityArray()));
    append(numbersOf(surface->GetPolys()->GetConnectivityArray()));
  }
  return all;
}

/// The corners of all triangles.
inline std::vector<std::array<vtkIdType, 3>> trianglesOf(vtkPolyData* surface)
{
  std::vector<std::array<vtkIdType, 3>> triangles;
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < surface->GetNumberOfPolys(); ++i)
  {
    surface->GetPolys()->GetCellAtId(i, corners);
    EXPECT_EQ(corners->GetNumberOfIds(), 3);
    triangles.push_back({ corners->GetId(0), corners->GetId(1), corners->GetId(2) });
  }
  return triangles;
}

inline void expectEmpty(vtkDataObject* output)
{
  EXPECT_EQ(output->GetNumberOfElements(vtkDataObject::POINT), 0);
  EXPECT_EQ(output->GetNumberOfElements(vtkDataObject::CELL), 0);
}

inline void expectContains(const std::string& text, const std::string& part)
{
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

} // namespace filtertesting
