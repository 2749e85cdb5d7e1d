// SPDX-License-Identifier: GPL-3.0-or-later
// Each large allocation of an update is made to fail: there is one error, the output is empty, and
// the next update of the filter works.
#include "FailingAllocator.h"
#include "FilterTesting.h"

#include "vtkScatteredBodyFilter.h"
#include "vtkScatteredGradientFilter.h"
#include "vtkScatteredGridFilter.h"
#include "vtkScatteredLineFilter.h"
#include "vtkScatteredProbeFilter.h"
#include "vtkScatteredSliceFilter.h"

#include "vtkImageData.h"
#include "vtkSphere.h"

#include <cerrno>

using namespace filtertesting;

namespace
{

/// Makes the n-th large allocation of an update fail, for each n.
/// @param newPrepared makes a filter, ready to be updated
/// @param numbersOf all numbers of its output
/// @param fewest allocations that fail
template <class TFilter, class Prepare, class Numbers>
void failEach(const Prepare& newPrepared, const Numbers& numbersOf, int fewest)
{
  const auto numbersOfUpdate = [&](TFilter* filter)
  {
    filter->Update();
    return numbersOf(filter->GetOutputDataObject(0));
  };
  const std::vector<double> expected = numbersOfUpdate(newPrepared());
  ASSERT_FALSE(expected.empty());
  int failures = 0;
  for (const bool andAllLater : { false, true })
  {
    bool failed = true;
    for (long n = 1; failed; ++n)
    {
      ASSERT_LT(n, 2000);
      SCOPED_TRACE(testing::Message() << "allocation " << n << (andAllLater ? " and later" : ""));
      const vtkSmartPointer<TFilter> filter = newPrepared();
      const auto errors = watchErrors(filter);
      failingallocator::failAt(n, andAllLater);
      filter->Update();
      failed = failingallocator::stop() >= n;
      if (errors->All.empty())
      {
        // No allocation failed, or only one of what would speed a later update up.
        ASSERT_EQ(numbersOf(filter->GetOutputDataObject(0)), expected);
        ASSERT_EQ(filter->GetErrorCode(), 0u);
      }
      else
      {
        ++failures;
        ASSERT_EQ(errors->count(), 1u);
        ASSERT_EQ(filter->GetErrorCode(), ENOMEM);
        expectContains(errors->last(), "memory");
        ASSERT_EQ(filter->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::POINT), 0);
      }
      filter->Modified();
      ASSERT_EQ(numbersOfUpdate(filter), expected);
    }
  }
  EXPECT_GT(failures, fewest);
}

/// The same for a filter of isosurfaces.
/// @param prepare sets a filter up, ready to be updated
template <class TFilter>
void failEach(vtkDataObject* input, const std::function<void(TFilter*)>& prepare)
{
  failEach<TFilter>(
    [&]()
    {
      const auto filter = newFilter<TFilter>(input);
      filter->SetValue(1, 0.5);
      prepare(filter);
      return filter;
    },
    everythingOf, 20);
}

/// The numbers of all arrays of the points, of all blocks, NaN as infinity.
std::vector<double> arraysOf(vtkDataObject* output)
{
  std::vector<double> numbers;
  for (vtkDataObject* const leaf : leavesOf(output))
  {
    vtkDataSetAttributes* const points = leaf->GetAttributes(vtkDataObject::POINT);
    for (int i = 0; i < points->GetNumberOfArrays(); ++i)
    {
      for (const double number : numbersOf(points->GetArray(i)))
      {
        numbers.push_back(std::isnan(number) ? infinity : number);
      }
    }
  }
  return numbers;
}

} // namespace

TEST(OutOfMemory, ACloudOfPoints)
{
  failEach<Isopoints>(newCloud(4000), [](Isopoints*) {});
}

TEST(OutOfMemory, AnotherIsovalueOnAKeptTree)
{
  failEach<Isopoints>(newCloud(4000),
    [](Isopoints* filter)
    {
      filter->Update();
      filter->SetValue(0, 0.9);
    });
}

TEST(OutOfMemory, NewValuesOnAKeptTree)
{
  const auto cloud = newCloud(4000);
  vtkNew<vtkPolyData> next;
  next->ShallowCopy(cloud);
  setScalars(
    next, [](const Vector& p) { return std::abs(p[0]); }, "distance");
  failEach<Isopoints>(cloud,
    [&](Isopoints* filter)
    {
      filter->Update();
      filter->SetInputData(next);
    });
}

TEST(OutOfMemory, BlocksAndCells)
{
  const auto blocks = blocksOf({ newVertexCells(600), newVertexCells(600) });
  for (const bool byBlock : { false, true })
  {
    failEach<Isopoints>(blocks,
      [&](Isopoints* filter)
      {
        filter->SetInputArrayToProcess(0, 0, 0, ofCells, "distance");
        filter->SetContourBlocks(byBlock);
      });
  }
}

TEST(OutOfMemory, Triangles)
{
  failEach<Isosurface>(newCloud(4000), [](Isosurface* filter) { filter->SetNumberOfContours(1); });
}

TEST(OutOfMemory, TrianglesOfATetrahedralizationOfAllSamples)
{
  failEach<Isosurface>(newCloud(1500),
    [](Isosurface* filter)
    {
      filter->SetInputArrayToProcess(0, 0, 0, ofPoints, "x");
      filter->SetProjection(Isopoints::NO_PROJECTION);
      filter->SetNumberOfContours(1);
      filter->SetValue(0, 0.01);
    });
}

TEST(OutOfMemory, Slices)
{
  const auto samples = blocksOf({ newCloud(1200), newCloud(1300) });
  vtkNew<vtkSphere> sphere;
  failEach<vtkScatteredSliceFilter>(
    [&]()
    {
      auto filter = vtkSmartPointer<vtkScatteredSliceFilter>::New();
      filter->SetInputData(samples);
      filter->SetCutFunction(sphere);
      return filter;
    },
    everythingOf, 10);
}

TEST(OutOfMemory, Bodies)
{
  const auto samples = blocksOf({ newCloud(1200), newCloud(1300) });
  failEach<vtkScatteredBodyFilter>(
    [&]()
    {
      auto filter = vtkSmartPointer<vtkScatteredBodyFilter>::New();
      filter->SetInputData(samples);
      return filter;
    },
    everythingOf, 10);
}

TEST(OutOfMemory, ValuesAtPlaces)
{
  const auto samples = blocksOf({ newCloud(800), newCloud(700) });
  const auto places = blocksOf({ newCloud(700), newCloud(800) });
  failEach<vtkScatteredProbeFilter>(
    [&]()
    {
      auto filter = vtkSmartPointer<vtkScatteredProbeFilter>::New();
      filter->SetInputData(places);
      filter->SetSourceData(samples);
      filter->MarkBlankPointsAndCellsOn();
      return filter;
    },
    arraysOf, 10);
  failEach<vtkScatteredGradientFilter>(
    [&]()
    {
      auto filter = vtkSmartPointer<vtkScatteredGradientFilter>::New();
      filter->SetInputData(samples);
      filter->SetInputArrayToProcess(0, 0, 0, ofPoints, "position");
      filter->ComputeVorticityOn();
      return filter;
    },
    arraysOf, 10);
  failEach<vtkScatteredGridFilter>(
    [&]()
    {
      auto filter = vtkSmartPointer<vtkScatteredGridFilter>::New();
      filter->SetInputData(samples);
      filter->SetSamplingDimensions(10, 10, 10);
      return filter;
    },
    arraysOf, 10);
  failEach<vtkScatteredLineFilter>(
    [&]()
    {
      auto filter = vtkSmartPointer<vtkScatteredLineFilter>::New();
      filter->SetInputData(samples);
      return filter;
    },
    arraysOf, 10);
}
