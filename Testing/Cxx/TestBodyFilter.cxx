// SPDX-License-Identifier: GPL-3.0-or-later
// The filter of bodies: kinds of samples, arrays, kept trees, messages. TestBodies tests the bodies
// themselves.
#include "InputTesting.h"

#include "vtkScatteredBodyFilter.h"

#include "vtkErrorCode.h"

#include <cerrno>
#include <limits>
#include <map>
#include <utility>

using namespace inputtesting;

namespace
{

using Body = vtkScatteredBodyFilter;

vtkSmartPointer<Body> bodyOf(vtkDataObject* samples)
{
  auto filter = vtkSmartPointer<Body>::New();
  filter->SetInputDataObject(samples);
  filter->SetOutputPointsPrecision(Body::DOUBLE_PRECISION);
  return filter;
}

/// Six times the volume, after checking that each edge has two triangles in opposite directions.
double sixVolumesOf(vtkPolyData* surface)
{
  std::map<std::pair<vtkIdType, vtkIdType>, int> sides;
  double volume = 0.0;
  for (const auto& [a, b, c] : trianglesOf(surface))
  {
    for (const auto& side : { std::pair(a, b), std::pair(b, c), std::pair(c, a) })
    {
      ++sides[side];
    }
    const Vector p = placeOf(surface, a);
    const Vector q = placeOf(surface, b);
    const Vector r = placeOf(surface, c);
    volume += p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
              p[2] * (q[0] * r[1] - q[1] * r[0]);
  }
  for (const auto& [side, count] : sides)
  {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(sides.count({ side.second, side.first }), 1u);
  }
  return volume;
}

} // namespace

TEST(BodyFilter, SamplesOfEveryKindAreOneCloud)
{
  forEachGridAndCloud(
    [](vtkDataSet* samples, vtkPolyData* cloud)
    {
      const auto filter = bodyOf(samples);
      EXPECT_GT(sixVolumesOf(updated(filter)), 0.0);
      EXPECT_EQ(everythingOf(filter->GetOutput()), everythingOf(updated(bodyOf(cloud))));
    });
  const auto cloud = newCloud(2000, VTK_DOUBLE);
  const auto blocks = blocksOf({ everyNth(cloud, 0, 2), nullptr, everyNth(cloud, 1, 2) });
  EXPECT_EQ(
    updated(bodyOf(blocks))->GetNumberOfPolys(), updated(bodyOf(cloud))->GetNumberOfPolys());
  const auto filter = bodyOf(newCloudWithGhosts(1002, 1000));
  updated(filter);
  EXPECT_EQ(filter->GetNumberOfSamples(), 1002);
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(), 2);
}

TEST(BodyFilter, IsTheIsosurfaceWithCappingBelowAllValues)
{
  const auto cloud = newCloud(4000, VTK_DOUBLE);
  const auto isosurface = newFilter<Isosurface>(cloud, -std::numeric_limits<double>::infinity());
  isosurface->CappingOn();
  isosurface->SetProjection(Isosurface::NO_PROJECTION);
  isosurface->ComputeNormalsOff();
  for (const double share : { 0.0, 0.5 })
  {
    const auto filter = bodyOf(cloud);
    filter->SetMinimumPieceSize(share);
    isosurface->SetMinimumPieceSize(share);
    isosurface->Update();
    vtkPolyData* const surface = updated(filter);
    EXPECT_EQ(trianglesOf(surface), trianglesOf(isosurface->GetOutput()));
    EXPECT_EQ(surface->GetCellData()->GetNumberOfArrays(), 0);
    EXPECT_EQ(filter->GetNumberOfExtractedPoints(), surface->GetNumberOfPoints());
    // Points are samples, with their arrays.
    for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
    {
      const vtkIdType sample = cloud->FindPoint(surface->GetPoint(i));
      EXPECT_EQ(placeOf(surface, i), placeOf(cloud, sample));
      EXPECT_EQ(
        distancesOf(surface)->GetComponent(i, 0), distancesOf(cloud)->GetComponent(sample, 0));
    }
  }
}

TEST(BodyFilter, FollowsSamplesAndOptions)
{
  const auto cloud = newCloud(3000, VTK_DOUBLE);
  const auto filter = bodyOf(cloud);
  const auto expectNew = [&]()
  {
    const auto fresh = bodyOf(cloud);
    fresh->SetDropGaps(filter->GetDropGaps());
    expectAsNew(filter, fresh, 100);
  };
  expectNew();
  move(cloud->GetPoints(),
    [](const Vector& p) {
      return Vector{ p[0] + (p[0] > 0.0), p[1], p[2] };
    });
  cloud->GetPoints()->Modified();
  expectNew(); // two bodies
  const double apart = sixVolumesOf(filter->GetOutput());
  filter->DropGapsOff();
  expectNew();
  EXPECT_GT(sixVolumesOf(filter->GetOutput()), 1.3 * apart);
  filter->KeepTreeOff();
  distancesOf(cloud)->FillValue(1.0);
  distancesOf(cloud)->Modified();
  expectNew();
  EXPECT_EQ(distancesOf(filter->GetOutput())->GetRange()[0], 1.0);
}

TEST(BodyFilter, MessagesNameTheCause)
{
  const auto filter = bodyOf(vtkSmartPointer<vtkPolyData>::New());
  const auto errors = watchErrors(filter);
  filter->Update();
  expectContains(errors->last(), "no points or cells");
  EXPECT_EQ(filter->GetErrorCode(), static_cast<unsigned long>(EINVAL));
  const auto cloud = newCloud(1000);
  vtkNew<vtkPolyData> bare; // no array is needed
  bare->SetPoints(cloud->GetPoints());
  EXPECT_GT(sixVolumesOf(updated(bodyOf(bare))), 0.0);
  move(cloud->GetPoints(), [](const Vector& p) { return Vector{ p[0], p[1], 0.0 }; });
  filter->SetInputDataObject(cloud);
  const auto warnings = watchMessages(filter, vtkCommand::WarningEvent);
  expectEmpty(updated(filter));
  expectContains(warnings->last(), "No body: the samples are in one plane. Add samples beside it.");
  move(cloud->GetPoints(), [](const Vector&) { return Vector{ notANumber, 0.0, 0.0 }; });
  cloud->GetPoints()->Modified();
  expectEmpty(updated(filter));
  expectContains(warnings->last(), "There is no surface. Mend the positions.");
}
