// SPDX-License-Identifier: GPL-3.0-or-later
// The filters on several ranks: what fails on one of them ends the update of all with one error and
// empty outputs, and the next update works.
#include "FailingAllocator.h"
#include "FilterTesting.h"
#include "ThreadController.h"

#include "vtkScatteredIsosurfaceFilter.h"

#include "vtkIdTypeArray.h"
#include "vtkStringArray.h"

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

using namespace filtertesting;

namespace
{

constexpr int ranks = 3;

/// One rank's samples of a cloud, dealt out one to each in turn.
vtkSmartPointer<vtkPolyData> newPart(vtkPolyData* cloud, int rank)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(cloud->GetPoints()->GetDataType());
  const auto distance = newArray<vtkDoubleArray>("distance", 0);
  const auto position = newArray("position", 0, 3);
  vtkNew<vtkStringArray> names;
  names->SetName("names");
  for (vtkIdType i = rank; i < cloud->GetNumberOfPoints(); i += ranks)
  {
    points->InsertNextPoint(cloud->GetPoint(i));
    distance->InsertNextTuple1(cloud->GetPointData()->GetScalars()->GetTuple1(i));
    position->InsertNextTuple(cloud->GetPointData()->GetArray("position")->GetTuple(i));
    names->InsertNextValue(std::to_string(i % 97));
  }
  auto part = vtkSmartPointer<vtkPolyData>::New();
  part->SetPoints(points);
  part->GetPointData()->SetScalars(distance);
  part->GetPointData()->AddArray(position);
  part->GetPointData()->AddArray(names);
  return part;
}

/// The points of all ranks' outputs, in the order of the ranks.
using Outputs = std::vector<std::vector<double>>;

struct Result
{
  Outputs failed; // of the update with a failure
  Outputs next;   // of the next one
  std::atomic<int> errors{ 0 };
  std::string message;
  std::atomic<bool> wasReached{ false };
};

/// Updates the filter on all ranks while the n-th large allocation fails, then again.
template <class TFilter>
void updateFailing(long n, const std::vector<vtkSmartPointer<vtkPolyData>>& parts, Result& result)
{
  result.failed.assign(ranks, {});
  result.next.assign(ranks, {});
  std::mutex mutex;
  onThreadControllers(ranks,
    [&](vtkMultiProcessController* controller)
    {
      const auto rank = static_cast<std::size_t>(controller->GetLocalProcessId());
      vtkNew<TFilter> filter;
      filter->SetController(controller);
      filter->SetInputData(parts[rank]);
      filter->SetValue(0, 0.7);
      const auto errors = watchErrors(filter);
      controller->Barrier();
      if (rank == 0 && n > 0)
      {
        failingallocator::failAt(n, false);
      }
      controller->Barrier();
      filter->Update();
      controller->Barrier();
      if (rank == 0 && n > 0)
      {
        result.wasReached = failingallocator::stop() >= n;
      }
      controller->Barrier();
      result.failed[rank] = pointsOf(filter->GetOutput());
      result.errors += errors->Count;
      if (errors->Count > 0)
      {
        const std::lock_guard<std::mutex> lock(mutex);
        result.message = errors->Last;
      }
      filter->Modified();
      filter->Update();
      result.next[rank] = pointsOf(filter->GetOutput());
    });
}

template <class TFilter>
void failEach()
{
  const vtkSmartPointer<vtkPolyData> cloud = newCloud(1500);
  std::vector<vtkSmartPointer<vtkPolyData>> parts;
  for (int rank = 0; rank < ranks; ++rank)
  {
    parts.push_back(newPart(cloud, rank));
  }
  Result undisturbed;
  updateFailing<TFilter>(0, parts, undisturbed);
  const Outputs expected = undisturbed.next;
  ASSERT_EQ(undisturbed.failed, expected);
  ASSERT_EQ(undisturbed.errors, 0);
  int failures = 0;
  bool wasReached = true;
  for (long n = 1; wasReached; n += n < 40 ? 1 : 17)
  {
    SCOPED_TRACE(n);
    Result result;
    updateFailing<TFilter>(n, parts, result);
    wasReached = result.wasReached;
    if (result.errors == 0)
    {
      // No allocation failed, or only one of what would speed a later update up.
      ASSERT_EQ(result.failed, expected);
    }
    else
    {
      ++failures;
      ASSERT_EQ(result.errors, 1) << result.message;
      ASSERT_NE(result.message.find("Out of memory"), std::string::npos) << result.message;
      ASSERT_EQ(result.failed, Outputs(ranks));
    }
    ASSERT_EQ(result.next, expected);
  }
  EXPECT_GT(failures, 20);
}

} // namespace

TEST(RanksFilter, LackOfMemoryOnOneRankEndsTheUpdateOfAll)
{
  failEach<vtkScatteredIsopointFilter>();
}

TEST(RanksFilter, LackOfMemoryOnOneRankEndsTheTrianglesOfAll)
{
  failEach<vtkScatteredIsosurfaceFilter>();
}

namespace
{

/// The number of errors of all ranks, of which each makes a filter.
int errorsOf(const std::function<vtkSmartPointer<vtkScatteredContourFilter>(int rank)>& newFilter)
{
  const vtkSmartPointer<vtkPolyData> cloud = newCloud(300);
  std::atomic<int> errors{ 0 };
  onThreadControllers(ranks,
    [&](vtkMultiProcessController* controller)
    {
      const int rank = controller->GetLocalProcessId();
      const vtkSmartPointer<vtkScatteredContourFilter> filter = newFilter(rank);
      filter->SetController(controller);
      filter->SetInputData(newPart(cloud, rank));
      filter->SetValue(0, 0.7);
      const auto watcher = watchErrors(filter);
      filter->Update();
      errors += watcher->Count;
    });
  return errors;
}

} // namespace

TEST(RanksFilter, DifferentOptionsAreOneError)
{
  const auto newPoints = []() { return vtkSmartPointer<vtkScatteredIsopointFilter>::New(); };
  EXPECT_EQ(errorsOf(
              [&](int rank)
              {
                const auto filter = newPoints();
                filter->SetMinimumSpacing(rank == 0 ? 0.0 : -0.0);
                return filter;
              }),
    0);
  EXPECT_EQ(errorsOf(
              [&](int rank)
              {
                const auto filter = newPoints();
                filter->SetAngle(30.0 + rank);
                return filter;
              }),
    1);
  EXPECT_EQ(errorsOf(
              [](int rank)
              {
                const auto filter = vtkSmartPointer<vtkScatteredIsosurfaceFilter>::New();
                filter->SetRegularize(rank == 0);
                return filter;
              }),
    1);
  EXPECT_EQ(errorsOf(
              [&](int rank)
              {
                const auto filter = newPoints();
                filter->SetInputArrayToProcess(0, 0, 0,
                  rank == 1 ? vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS
                            : vtkDataObject::FIELD_ASSOCIATION_POINTS,
                  "distance");
                return filter;
              }),
    1);
  EXPECT_EQ(errorsOf(
              [&](int rank) -> vtkSmartPointer<vtkScatteredContourFilter>
              {
                if (rank == 1)
                {
                  return vtkSmartPointer<vtkScatteredIsosurfaceFilter>::New();
                }
                return newPoints();
              }),
    1);
}
