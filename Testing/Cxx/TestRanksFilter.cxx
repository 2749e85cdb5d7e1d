// SPDX-License-Identifier: GPL-3.0-or-later
// The filters on several ranks: what fails on one of them ends the update of all with one error and
// empty outputs, and the next update works.
#include "FailingAllocator.h"
#include "FilterTesting.h"
#include "ThreadController.h"

#include <atomic>
#include <mutex>

using namespace filtertesting;

namespace
{

constexpr int ranks = 3;

vtkSmartPointer<vtkPolyData> newCloudWithNames(vtkIdType count)
{
  const auto cloud = newCloud(count);
  cloud->GetPointData()->AddArray(
    textsOf("names", count, [](vtkIdType i) { return std::to_string(i % 97); }));
  return cloud;
}

/// The points of all ranks' outputs, in the order of the ranks.
using Outputs = std::vector<std::vector<double>>;

struct Result
{
  Outputs failed{ ranks }; // of the update with a failure
  Outputs next{ ranks };   // of the next one
  std::vector<std::string> errors;
  bool wasReached = false;
};

/// Updates the filter on all ranks while the n-th large allocation fails, then again.
template <class TFilter>
Result updateFailing(long n, vtkPolyData* cloud)
{
  Result result;
  std::vector<vtkSmartPointer<vtkPolyData>> parts;
  for (int rank = 0; rank < ranks; ++rank)
  {
    parts.push_back(everyNth(cloud, rank, ranks));
  }
  std::mutex mutex;
  onThreadControllers(ranks,
    [&](vtkMultiProcessController* controller)
    {
      const auto rank = static_cast<std::size_t>(controller->GetLocalProcessId());
      const auto filter = newFilter<TFilter>(parts[rank]);
      filter->SetController(controller);
      const auto errors = watchErrors(filter);
      const auto onFirst = [&](const std::function<void()>& work)
      {
        controller->Barrier();
        if (rank == 0 && n > 0)
        {
          work();
        }
        controller->Barrier();
      };
      onFirst([&]() { failingallocator::failAt(n, false); });
      filter->Update();
      onFirst([&]() { result.wasReached = failingallocator::stop() >= n; });
      result.failed[rank] = pointsOf(filter->GetOutput());
      {
        const std::lock_guard<std::mutex> lock(mutex);
        result.errors.insert(result.errors.end(), errors->All.begin(), errors->All.end());
      }
      filter->Modified();
      result.next[rank] = pointsOf(outputOf(filter));
    });
  return result;
}

template <class TFilter>
void failEach()
{
  const auto cloud = newCloudWithNames(1500);
  const Result undisturbed = updateFailing<TFilter>(0, cloud);
  const Outputs expected = undisturbed.next;
  ASSERT_EQ(undisturbed.failed, expected);
  ASSERT_TRUE(undisturbed.errors.empty());
  int failures = 0;
  bool wasReached = true;
  for (long n = 1; wasReached; n += n < 40 ? 1 : 17)
  {
    SCOPED_TRACE(n);
    const Result result = updateFailing<TFilter>(n, cloud);
    wasReached = result.wasReached;
    // Without an error no allocation failed, or only one of what would speed a later update up.
    ASSERT_EQ(result.failed, result.errors.empty() ? expected : Outputs(ranks));
    if (!result.errors.empty())
    {
      ++failures;
      ASSERT_EQ(result.errors.size(), 1u) << testing::PrintToString(result.errors);
      expectContains(result.errors[0], "memory");
    }
    ASSERT_EQ(result.next, expected);
  }
  EXPECT_GT(failures, 20);
}

} // namespace

TEST(RanksFilter, LackOfMemoryOnOneRankEndsTheUpdateOfAll)
{
  failEach<Isopoints>();
}

TEST(RanksFilter, LackOfMemoryOnOneRankEndsTheTrianglesOfAll)
{
  failEach<Isosurface>();
}

TEST(RanksFilter, DifferentOptionsAreOneError)
{
  struct Case
  {
    const char* name;
    std::function<vtkScatteredContourFilter*(Isopoints*, Isosurface*, int rank)> filterOf;
    std::size_t errors = 1;
  };
  const std::vector<Case> cases{
    { "both zeros",
      [](auto* points, auto*, int rank)
      {
        points->SetAngle(rank == 0 ? 0.0 : -0.0);
        return points;
      },
      0 },
    { "angles",
      [](auto* points, auto*, int rank)
      {
        points->SetAngle(30.0 + rank);
        return points;
      } },
    { "associations",
      [](auto* points, auto*, int rank)
      {
        points->SetInputArrayToProcess(0, 0, 0,
          rank == 1 ? vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS : ofPoints, "distance");
        return points;
      } },
    { "switches",
      [](auto*, auto* triangles, int rank)
      {
        triangles->SetRegularize(rank == 0);
        return triangles;
      } },
    { "filters",
      [](auto* points, auto* triangles, int rank) -> vtkScatteredContourFilter*
      {
        if (rank == 1)
        {
          return triangles;
        }
        return points;
      } },
  };
  const auto cloud = newCloudWithNames(300);
  for (const Case& different : cases)
  {
    std::atomic<std::size_t> errors{ 0 };
    onThreadControllers(ranks,
      [&](vtkMultiProcessController* controller)
      {
        const int rank = controller->GetLocalProcessId();
        const auto part = everyNth(cloud, rank, ranks);
        const auto points = newFilter(part);
        const auto triangles = newFilter<Isosurface>(part);
        vtkScatteredContourFilter* const filter = different.filterOf(points, triangles, rank);
        filter->SetController(controller);
        const auto watcher = watchErrors(filter);
        filter->Update();
        errors += watcher->count();
      });
    EXPECT_EQ(errors, different.errors) << different.name;
  }
}
