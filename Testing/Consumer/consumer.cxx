// SPDX-License-Identifier: GPL-3.0-or-later
// The installed filters and the mapper in a program: isopoints and triangles of a sphere.
#include <vtkIsopointSplatMapper.h>
#include <vtkScatteredIsopointFilter.h>
#include <vtkScatteredIsosurfaceFilter.h>

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <cmath>
#include <cstdlib>

int main()
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> distances;
  distances->SetName("distance");
  for (int i = 0; i < 20 * 20 * 20; ++i)
  {
    const double x = i % 20 - 9.5;
    const double y = i / 20 % 20 - 9.5;
    const double z = i / 400 - 9.5;
    points->InsertNextPoint(x, y, z);
    distances->InsertNextValue(std::sqrt(x * x + y * y + z * z));
  }
  vtkNew<vtkPolyData> samples;
  samples->SetPoints(points);
  samples->GetPointData()->SetScalars(distances);

  vtkNew<vtkScatteredIsopointFilter> isopoints;
  isopoints->SetInputData(samples);
  isopoints->SetValue(0, 6.0);
  vtkNew<vtkIsopointSplatMapper> mapper;
  mapper->SetInputConnection(isopoints->GetOutputPort());
  mapper->Update();
  vtkNew<vtkScatteredIsosurfaceFilter> surface;
  surface->SetInputData(samples);
  surface->SetValue(0, 6.0);
  surface->Update();
  const bool isRight = isopoints->GetOutput()->GetNumberOfPoints() > 300 &&
                       std::abs(mapper->GetBounds()[1] - 6.0) < 1.0 &&
                       surface->GetOutput()->GetNumberOfPolys() > 600;
  return isRight ? EXIT_SUCCESS : EXIT_FAILURE;
}
