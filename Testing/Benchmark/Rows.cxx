// SPDX-License-Identifier: GPL-3.0-or-later
#include "Rows.h"

#include "Delaunay.h"

#include "vtkContourFilter.h"
#include "vtkDataArray.h"
#include "vtkDelaunay3D.h"
#include "vtkFloatArray.h"
#include "vtkFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointInterpolator.h"
#include "vtkSMPTools.h"
#include "vtkScatteredIsopointFilter.h"
#include "vtkScatteredIsosurfaceFilter.h"
#include "vtkShepardKernel.h"
#include "vtkStaticPointLocator.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>

namespace
{

Row describe(const Task& task, const std::string& what, double copy)
{
  Row row;
  row.cloud = task.cloud;
  row.what = what;
  row.samples = static_cast<std::size_t>(task.samples->GetNumberOfPoints());
  row.threads = task.threads;
  row.copySeconds = copy;
  return row;
}

Row measureUpdate(const Task& task, const std::string& what, double copy,
  vtkScatteredContourFilter* filter, double isovalue)
{
  filter->SetValue(0, isovalue);
  filter->Modified();
  Row row = measure(describe(task, what, copy), [filter]() { filter->Update(); });
  row.surfacePoints = static_cast<std::size_t>(filter->GetOutput()->GetNumberOfPoints());
  if (task.isSphere)
  {
    measureSphere(row, filter->GetOutput(), isovalue);
  }
  return row;
}

/// What is computed in addition to isopoints on their edges.
enum class Extras
{
  None,
  Projection, // and the field's gradients
  All         // and normals and radii: the defaults
};

template <class TFilter = vtkScatteredIsopointFilter>
vtkNew<TFilter> newFilter(const Task& task, Extras extras)
{
  vtkNew<TFilter> filter;
  filter->SetInputData(task.samples);
  filter->SetComputeNormals(extras == Extras::All);
  if constexpr (std::is_same_v<TFilter, vtkScatteredIsopointFilter>)
  {
    filter->SetComputeSplats(extras == Extras::All);
  }
  filter->SetComputeGradients(extras == Extras::Projection);
  if (extras == Extras::None)
  {
    filter->SetProjection(vtkScatteredIsopointFilter::NO_PROJECTION);
  }
  filter->UseAllCoresOff();
  return filter;
}

/// The faster of two runs.
template <class Measurement>
Row fasterOfTwo(const Measurement& measurement)
{
  const Row first = measurement();
  const Row second = measurement();
  return second.seconds < first.seconds ? second : first;
}

template <class TFilter = vtkScatteredIsopointFilter>
Row measureNewFilter(const Task& task, const std::string& what, double copy, Extras extras)
{
  return fasterOfTwo(
    [&]()
    {
      const auto filter = newFilter<TFilter>(task, extras);
      return measureUpdate(task, what, copy, filter, task.isovalue);
    });
}

/// Adds a multiple of the x coordinate to the values.
void tilt(vtkPolyData* samples, double slope)
{
  auto* const values = vtkFloatArray::SafeDownCast(samples->GetPointData()->GetScalars());
  for (vtkIdType i = 0; i < samples->GetNumberOfPoints(); ++i)
  {
    values->SetValue(i, static_cast<float>(values->GetValue(i) + slope * samples->GetPoint(i)[0]));
  }
  values->Modified();
}

/// Resamples to a grid that yields about `surfacePoints` points: a sphere of radius r crosses
/// 6 pi (r / spacing)^2 edges of a grid.
Row measureResampling(const Task& task, double copy, std::size_t surfacePoints)
{
  double bounds[6];
  task.samples->GetBounds(bounds);
  const double spacing =
    task.isovalue * std::sqrt(6.0 * 3.14159265358979 / static_cast<double>(surfacePoints));
  vtkNew<vtkImageData> grid;
  int dimensions[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    dimensions[axis] = static_cast<int>((bounds[2 * axis + 1] - bounds[2 * axis]) / spacing) + 1;
  }
  grid->SetDimensions(dimensions);
  grid->SetSpacing(spacing, spacing, spacing);
  grid->SetOrigin(bounds[0], bounds[2], bounds[4]);
  vtkNew<vtkStaticPointLocator> locator;
  vtkNew<vtkShepardKernel> kernel;
  kernel->SetKernelFootprintToNClosest();
  kernel->SetNumberOfPoints(8);
  vtkNew<vtkPointInterpolator> interpolator;
  interpolator->SetInputData(grid);
  interpolator->SetSourceData(task.samples);
  interpolator->SetLocator(locator);
  interpolator->SetKernel(kernel);
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputConnection(interpolator->GetOutputPort());
  contour->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "value");
  contour->ComputeNormalsOff();
  contour->SetValue(0, task.isovalue);
  Row row = measure(describe(task, "VTK: resample to a grid (8 closest) + Flying Edges", copy),
    [&]() { contour->Update(); });
  measureSphere(row, contour->GetOutput(), task.isovalue);
  return row;
}

Row measureVtkDelaunay(const Task& task, double copy)
{
  vtkNew<vtkDelaunay3D> delaunay;
  delaunay->SetInputData(task.samples);
  vtkNew<vtkContourFilter> contour;
  contour->SetInputConnection(delaunay->GetOutputPort());
  contour->SetValue(0, task.isovalue);
  Row row =
    measure(describe(task, "VTK: vtkDelaunay3D + contour", copy), [&]() { contour->Update(); });
  row.threads = 1;
  measureSphere(row, contour->GetOutput(), task.isovalue);
  return row;
}

Row measureCgal(const Task& task, double copy, bool parallel)
{
  const tbb::global_control limit(
    tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(task.threads));
  vtkSmartPointer<vtkPolyData> surface;
  Row row = measure(describe(task,
                      parallel ? "CGAL: Delaunay, parallel + crossing edges"
                               : "CGAL: Delaunay, sequential + crossing edges",
                      copy),
    [&]() { surface = contourDelaunay(task.samples, task.isovalue, parallel); });
  row.threads = parallel ? task.threads : 1;
  measureSphere(row, surface, task.isovalue);
  return row;
}

} // namespace

double copySeconds(vtkPolyData* samples)
{
  auto* const positions = vtkFloatArray::SafeDownCast(samples->GetPoints()->GetData());
  auto* const values = vtkFloatArray::SafeDownCast(samples->GetPointData()->GetScalars());
  const auto count = static_cast<std::size_t>(samples->GetNumberOfPoints());
  std::vector<float> target(4 * count);
  double best = 0.0;
  for (int run = 0; run < 5; ++run)
  {
    const auto start = std::chrono::steady_clock::now();
    std::memcpy(target.data(), positions->GetPointer(0), 3 * count * sizeof(float));
    std::memcpy(target.data() + 3 * count, values->GetPointer(0), count * sizeof(float));
    const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    best = run == 0 ? seconds : std::min(best, seconds);
  }
  return best;
}

std::vector<Row> measureOurs(const Task& task, double copy)
{
  std::vector<Row> rows;
  vtkSMPTools::Initialize(task.threads);
  const Row first = measureNewFilter(task, "isopoints", copy, Extras::None);
  rows.push_back(first);
  rows.push_back(
    measureNewFilter(task, "isopoints, projected, gradients", copy, Extras::Projection));
  rows.push_back(measureNewFilter(task, "isopoints, projected, normals, radii", copy, Extras::All));
  rows.push_back(
    measureNewFilter<vtkScatteredIsosurfaceFilter>(task, "triangles", copy, Extras::None));
  rows.push_back(measureNewFilter<vtkScatteredIsosurfaceFilter>(
    task, "triangles, projected, normals", copy, Extras::All));

  const auto filter = newFilter(task, Extras::None);
  measureUpdate(task, "(first, to be kept)", copy, filter, task.isovalue);
  if (task.isSphere)
  {
    rows.push_back(measureUpdate(task, "then isovalue 69.9", copy, filter, 69.9));
    rows.push_back(measureUpdate(task, "then isovalue 30", copy, filter, 30.0));
    rows.push_back(measureUpdate(task, "then isovalue 70 again", copy, filter, 70.0));
  }
  // Moves the surface at least as far as the next step of a simulation would.
  constexpr double slope = 0.125;
  Task tilted = task;
  tilted.isSphere = false;
  tilt(task.samples, slope);
  rows.push_back(
    measureUpdate(tilted, "then new values at the same positions", copy, filter, task.isovalue));
  tilt(task.samples, -slope);

  if (task.threads > 1)
  {
    vtkSMPTools::Initialize(1);
    Task alone = task;
    alone.threads = 1;
    rows.push_back(measureNewFilter(alone, "isopoints", copy, Extras::None));
    rows.push_back(
      measureNewFilter(alone, "isopoints, projected, normals, radii", copy, Extras::All));
    vtkSMPTools::Initialize(task.threads);
  }
  for (Row& row : rows)
  {
    row.oursSeconds = first.seconds;
  }
  return rows;
}

std::vector<Row> measureTriangles(const Task& task, double copy)
{
  vtkSMPTools::Initialize(task.threads);
  std::vector<Row> rows;
  rows.push_back(
    measureNewFilter<vtkScatteredIsosurfaceFilter>(task, "triangles", copy, Extras::None));
  rows.push_back(measureCgal(task, copy, true));
  for (Row& row : rows)
  {
    row.oursSeconds = rows.front().seconds;
  }
  return rows;
}

std::vector<Row> measurePeers(const Task& task, double copy, const Row& ours)
{
  constexpr std::size_t vtkDelaunayLimit = 50000; // it takes over a minute for 100,000
  std::vector<Row> rows;
  rows.push_back(fasterOfTwo([&]() { return measureResampling(task, copy, ours.surfacePoints); }));
  rows.push_back(fasterOfTwo([&]() { return measureCgal(task, copy, true); }));
  rows.push_back(fasterOfTwo([&]() { return measureCgal(task, copy, false); }));
  if (ours.samples <= vtkDelaunayLimit)
  {
    rows.push_back(measureVtkDelaunay(task, copy));
  }
  for (Row& row : rows)
  {
    row.oursSeconds = ours.seconds;
  }
  return rows;
}
