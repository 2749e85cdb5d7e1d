// SPDX-License-Identifier: GPL-3.0-or-later
// Each large allocation of an update is made to fail: there is one error, the output is empty, and
// the next update of the filter works.
#include "FailingAllocator.h"
#include "FilterTesting.h"

#include <cerrno>

using namespace filtertesting;

namespace
{

/// Makes the n-th large allocation of the update after `prepare` fail, for each n.
/// @param prepare sets a filter up, ready to be updated
template <class TFilter>
void failEach(vtkDataObject* input, const std::function<void(TFilter*)>& prepare)
{
  const auto newPrepared = [&]()
  {
    const auto filter = newFilter<TFilter>(input);
    filter->SetValue(1, 0.5);
    prepare(filter);
    return filter;
  };
  const auto everythingOfUpdate = [](TFilter* filter)
  {
    filter->Update();
    return everythingOf(filter->GetOutputDataObject(0));
  };
  const std::vector<double> expected = everythingOfUpdate(newPrepared());
  ASSERT_FALSE(expected.empty());
  int failures = 0;
  for (const bool andAllLater : { false, true })
  {
    bool failed = true;
    for (long n = 1; failed; ++n)
    {
      ASSERT_LT(n, 2000);
      SCOPED_TRACE(testing::Message() << "allocation " << n << (andAllLater ? " and later" : ""));
      const auto filter = newPrepared();
      const auto errors = watchErrors(filter);
      failingallocator::failAt(n, andAllLater);
      filter->Update();
      failed = failingallocator::stop() >= n;
      if (errors->All.empty())
      {
        // No allocation failed, or only one of what would speed a later update up.
        ASSERT_EQ(everythingOf(filter->GetOutputDataObject(0)), expected);
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
      ASSERT_EQ(everythingOfUpdate(filter), expected);
    }
  }
  EXPECT_GT(failures, 20);
}

} // namespace

TEST(OutOfMemory, ACloudOfPoints)
{
  failEach<Isopoints>(newCloud(4000), [](Isopoints*) {});
}

TEST(OutOfMemory, ThinnedPoints)
{
  failEach<Isopoints>(newCloud(4000),
    [](Isopoints* filter)
    {
      filter->SetMinimumSpacing(0.5);
      filter->ComputeNormalsOff();
      filter->ComputeSplatsOff();
    });
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
