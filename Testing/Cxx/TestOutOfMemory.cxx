// SPDX-License-Identifier: GPL-3.0-or-later
// Each large allocation of an update is made to fail: there is one error, the output is empty, and
// the next update of the filter works.
#include "FailingAllocator.h"
#include "FilterTesting.h"

#include "vtkScatteredIsosurfaceFilter.h"

#include "vtkCellData.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkUnstructuredGrid.h"

#include <cerrno>
#include <functional>
#include <limits>

using namespace filtertesting;

namespace
{

/// @returns positions and arrays of the output, of all blocks
std::vector<double> everythingOf(vtkScatteredContourFilter* filter)
{
  std::vector<double> all;
  const auto append = [&all](vtkPolyData* surface)
  {
    const std::vector<double> points = pointsOf(surface);
    all.insert(all.end(), points.begin(), points.end());
    for (int i = 0; i < surface->GetPointData()->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* const array = surface->GetPointData()->GetArray(i);
      for (vtkIdType value = 0; value < array->GetNumberOfValues(); ++value)
      {
        all.push_back(array->GetVariantValue(value).ToDouble());
      }
    }
  };
  if (auto* const blocks = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0)))
  {
    for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
    {
      append(vtkPolyData::SafeDownCast(blocks->GetBlock(i)));
    }
  }
  else
  {
    append(filter->GetOutput());
  }
  return all;
}

/// Makes the n-th large allocation of the update after `prepare` fail, for each n.
/// @param prepare sets a filter up, ready to be updated
template <class TFilter = vtkScatteredIsopointFilter, class Prepare>
void failEach(const Prepare& prepare)
{
  vtkNew<TFilter> undisturbed;
  prepare(undisturbed);
  undisturbed->Update();
  const std::vector<double> expected = everythingOf(undisturbed);
  ASSERT_FALSE(expected.empty());
  int failures = 0;
  for (const bool andAllLater : { false, true })
  {
    bool failed = true;
    for (long n = 1; failed; ++n)
    {
      ASSERT_LT(n, 2000);
      SCOPED_TRACE(testing::Message() << "allocation " << n << (andAllLater ? " and later" : ""));
      vtkNew<TFilter> filter;
      prepare(filter);
      const auto errors = watchErrors(filter);
      failingallocator::failAt(n, andAllLater);
      filter->Update();
      failed = failingallocator::stop() >= n;
      if (errors->Count == 0)
      {
        // No allocation failed, or only one of what would speed a later update up.
        ASSERT_EQ(everythingOf(filter), expected);
        ASSERT_EQ(filter->GetErrorCode(), 0u);
      }
      else
      {
        ++failures;
        ASSERT_EQ(errors->Count, 1);
        ASSERT_EQ(filter->GetErrorCode(), ENOMEM);
        ASSERT_NE(errors->Last.find("Out of memory"), std::string::npos) << errors->Last;
        ASSERT_EQ(filter->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::POINT), 0);
      }
      filter->Modified();
      filter->Update();
      ASSERT_EQ(everythingOf(filter), expected);
    }
  }
  EXPECT_GT(failures, 20);
}

void setUp(vtkScatteredIsopointFilter* filter, vtkDataObject* input)
{
  filter->SetInputData(input);
  filter->SetNumberOfContours(2);
  filter->SetValue(0, 0.7);
  filter->SetValue(1, 0.5);
}

} // namespace

TEST(OutOfMemory, ACloudOfPoints)
{
  const auto cloud = newCloud(4000);
  failEach([&](vtkScatteredIsopointFilter* filter) { setUp(filter, cloud); });
}

TEST(OutOfMemory, ThinnedPoints)
{
  const auto cloud = newCloud(4000);
  failEach(
    [&](vtkScatteredIsopointFilter* filter)
    {
      setUp(filter, cloud);
      filter->SetMinimumSpacing(0.5);
      filter->ComputeNormalsOff();
      filter->ComputeSplatsOff();
    });
}

TEST(OutOfMemory, AnotherIsovalueOnAKeptTree)
{
  const auto cloud = newCloud(4000);
  failEach(
    [&](vtkScatteredIsopointFilter* filter)
    {
      setUp(filter, cloud);
      filter->Update();
      filter->SetValue(0, 0.9);
    });
}

TEST(OutOfMemory, NewValuesOnAKeptTree)
{
  const auto cloud = newCloud(4000);
  const auto values = newArray<vtkDoubleArray>("distance", 4000);
  for (vtkIdType i = 0; i < 4000; ++i)
  {
    values->SetValue(i, std::abs(cloud->GetPoint(i)[0]));
  }
  vtkNew<vtkPolyData> next;
  next->ShallowCopy(cloud);
  next->GetPointData()->SetScalars(values);
  failEach(
    [&](vtkScatteredIsopointFilter* filter)
    {
      setUp(filter, cloud);
      filter->Update();
      filter->SetInputData(next);
    });
}

TEST(OutOfMemory, BlocksAndCells)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned int block = 0; block < 2; ++block)
  {
    const auto cloud = newCloud(600);
    vtkNew<vtkUnstructuredGrid> grid;
    vtkNew<vtkPoints> points;
    points->DeepCopy(cloud->GetPoints());
    for (vtkIdType i = 0; i < 600; ++i)
    {
      grid->InsertNextCell(VTK_VERTEX, 1, &i);
    }
    grid->SetPoints(points);
    grid->GetCellData()->ShallowCopy(cloud->GetPointData());
    blocks->SetBlock(block, grid);
  }
  for (const bool byBlock : { false, true })
  {
    failEach(
      [&](vtkScatteredIsopointFilter* filter)
      {
        setUp(filter, blocks);
        filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "distance");
        filter->SetContourBlocks(byBlock);
      });
  }
}

TEST(OutOfMemory, Triangles)
{
  const vtkSmartPointer<vtkPolyData> cloud = newCloud(4000);
  failEach<vtkScatteredIsosurfaceFilter>(
    [&](vtkScatteredIsosurfaceFilter* filter)
    {
      filter->SetInputData(cloud);
      filter->SetValue(0, 0.6);
    });
}

/// All samples are tetrahedrized.
TEST(OutOfMemory, TrianglesOfNoise)
{
  const vtkSmartPointer<vtkPolyData> cloud = newCloud(1500);
  failEach<vtkScatteredIsosurfaceFilter>(
    [&](vtkScatteredIsosurfaceFilter* filter)
    {
      filter->SetInputData(cloud);
      filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "x");
      filter->SetProjection(vtkScatteredIsopointFilter::NO_PROJECTION);
      filter->SetValue(0, 0.01);
    });
}
