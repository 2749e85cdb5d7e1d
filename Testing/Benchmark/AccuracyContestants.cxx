// SPDX-License-Identifier: GPL-3.0-or-later
#include "AccuracyContestants.h"

#include "MarchingTetrahedra.h"

#include "vtkDataArray.h"
#include "vtkFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointInterpolator.h"
#include "vtkScatteredIsopointFilter.h"
#include "vtkShepardKernel.h"
#include "vtkStaticPointLocator.h"

#include <cmath>

namespace accuracy
{
namespace
{

using Surface = vtkSmartPointer<vtkPolyData>;

/// This project's filter with the properties that `choose(filter)` sets.
template <class Choose>
Contestant ours(const std::string& mode, const Choose& choose)
{
  return { mode,
    [choose](vtkPolyData* samples, double isovalue) -> Surface
    {
      vtkNew<vtkScatteredIsopointFilter> filter;
      filter->SetInputData(samples);
      filter->SetValue(0, isovalue);
      filter->UseAllCoresOff();
      choose(filter.Get());
      filter->Update();
      return filter->GetOutput();
    } };
}

vtkSmartPointer<vtkImageData> gridOver(vtkIdType nodes)
{
  const int n = static_cast<int>(std::round(std::cbrt(static_cast<double>(nodes))));
  auto grid = vtkSmartPointer<vtkImageData>::New();
  grid->SetDimensions(n, n, n);
  const double spacing = 2.0 / (n - 1);
  grid->SetSpacing(spacing, spacing, spacing);
  grid->SetOrigin(-1.0, -1.0, -1.0);
  return grid;
}

Surface flyingEdges(vtkImageData* grid, double isovalue)
{
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(grid);
  contour->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "value");
  contour->SetValue(0, isovalue);
  contour->ComputeNormalsOn();
  contour->Update();
  return contour->GetOutput();
}

Surface resample(vtkPolyData* samples, double isovalue)
{
  vtkNew<vtkStaticPointLocator> locator;
  vtkNew<vtkShepardKernel> kernel;
  kernel->SetKernelFootprintToNClosest();
  kernel->SetNumberOfPoints(8);
  vtkNew<vtkPointInterpolator> interpolator;
  interpolator->SetInputData(gridOver(samples->GetNumberOfPoints()));
  interpolator->SetSourceData(samples);
  interpolator->SetLocator(locator);
  interpolator->SetKernel(kernel);
  interpolator->Update();
  return flyingEdges(vtkImageData::SafeDownCast(interpolator->GetOutput()), isovalue);
}

Surface marchingCubes(vtkPolyData* nodes, double isovalue)
{
  const vtkSmartPointer<vtkImageData> grid = gridOver(nodes->GetNumberOfPoints());
  grid->GetPointData()->SetScalars(nodes->GetPointData()->GetScalars());
  return flyingEdges(grid, isovalue);
}

} // namespace

std::vector<Contestant> scatteredContestants()
{
  using Filter = vtkScatteredIsopointFilter;
  return {
    ours("isopoints, linear interpolation",
      [](Filter* filter)
      {
        filter->SetProjection(Filter::NO_PROJECTION);
        filter->SetNormalMethod(Filter::NORMALS_FROM_PLANES);
      }),
    ours("isopoints", [](Filter*) {}),
    ours(
      "isopoints, with creases", [](Filter* filter) { filter->SetProjection(Filter::CREASE_FIT); }),
    { "CGAL Delaunay + marching tetrahedra", marchingTetrahedra },
    { "VTK resampling (8 closest) + Flying Edges", resample },
  };
}

Contestant gridContestant()
{
  return { "marching cubes on a grid of as many samples", marchingCubes };
}

} // namespace accuracy
