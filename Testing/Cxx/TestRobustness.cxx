// SPDX-License-Identifier: GPL-3.0-or-later
// Events around an update: progress and aborts, inputs that are freed or change, filters side by
// side.
#include "FilterTesting.h"

#include <thread>

using namespace filtertesting;

namespace
{

/// Records a filter's progress and aborts it at the n-th event.
class ProgressWatcher : public vtkCommand
{
public:
  static ProgressWatcher* New() { return new ProgressWatcher; }

  void Execute(vtkObject* caller, unsigned long, void* progress) override
  {
    this->Seen.push_back(*static_cast<double*>(progress));
    EXPECT_STREQ(static_cast<vtkAlgorithm*>(caller)->GetProgressText(),
      caller->IsA("vtkScatteredIsosurfaceFilter") ? "Scattered Isosurface" : "Scattered Isopoints");
    if (this->Seen.size() == this->AbortAt)
    {
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    }
  }

  std::vector<double> Seen;
  std::size_t AbortAt = std::numeric_limits<std::size_t>::max();
};

vtkSmartPointer<ProgressWatcher> watchProgress(vtkScatteredContourFilter* filter)
{
  const auto watcher = vtkSmartPointer<ProgressWatcher>::Take(ProgressWatcher::New());
  filter->AddObserver(vtkCommand::ProgressEvent, watcher);
  return watcher;
}

/// Filters of points, cells and blocks, and the filter of triangles.
std::vector<vtkSmartPointer<vtkScatteredContourFilter>> filtersOfEveryInput()
{
  const auto blocks = blocksOf({ newVertexCells(12000), newVertexCells(8000) });
  const std::vector<vtkSmartPointer<vtkScatteredContourFilter>> filters{ newFilter(newCloud(20000)),
    newFilter<Isosurface>(newCloud(20000)), newFilter(newVertexCells(20000)), newFilter(blocks),
    newFilter(blocks) };
  for (std::size_t i = 0; i < filters.size(); ++i)
  {
    filters[i]->SetInputArrayToProcess(0, 0, 0, i < 2 ? ofPoints : ofCells, "distance");
    filters[i]->GenerateValues(3, 0.5, 0.8);
  }
  filters.back()->ContourBlocksOn();
  return filters;
}

} // namespace

TEST(Robustness, ProgressIncreasesFromZeroToOneInEachUpdate)
{
  for (vtkScatteredContourFilter* const filter : filtersOfEveryInput())
  {
    const auto watcher = watchProgress(filter);
    for (int update = 0; update < 3; ++update)
    {
      watcher->Seen.clear();
      filter->SetValue(0, 0.4 + 0.02 * update);
      filter->Update();
      const std::vector<double>& seen = watcher->Seen;
      ASSERT_GE(seen.size(), 40u);
      EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
      EXPECT_EQ(seen.front(), 0.0);
      EXPECT_EQ(seen.back(), 1.0);
      for (std::size_t i = 1; i < seen.size(); ++i)
      {
        EXPECT_LE(seen[i] - seen[i - 1], 0.15) << "after " << seen[i - 1];
      }
    }
  }
}

TEST(Robustness, ProgressGivesEachBlockTheSameShare)
{
  constexpr int count = 11;
  std::vector<vtkSmartPointer<vtkDataObject>> clouds;
  for (int i = 1; i <= count; ++i)
  {
    clouds.emplace_back(newCloud(500 * i));
  }
  const auto filter = newFilter(blocksOf(clouds));
  filter->ContourBlocksOn();
  const auto watcher = watchProgress(filter);
  filter->Update();
  const std::vector<double>& seen = watcher->Seen;
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  for (int i = 1; i <= count; ++i)
  {
    EXPECT_TRUE(std::any_of(seen.begin(), seen.end(),
      [i](double share) { return std::abs(share - i / double{ count }) < 1e-12; }))
      << i;
  }
}

TEST(Robustness, AnAbortAtAnyTimeGivesAnEmptyOutputAndAReusableFilter)
{
  for (vtkScatteredContourFilter* const filter : filtersOfEveryInput())
  {
    const auto watcher = watchProgress(filter);
    const auto errors = watchErrors(filter);
    filter->KeepTreeOff(); // so that each update builds its tree
    filter->Update();
    const auto countPoints = [filter]()
    { return filter->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::POINT); };
    const vtkIdType expected = countPoints();
    EXPECT_GT(expected, 500);
    // The last two events report the end of the update.
    ASSERT_GT(watcher->Seen.size(), 4u);
    const std::size_t events = watcher->Seen.size() - 2;
    for (std::size_t event = 1; event <= events; event += 1 + events / 12)
    {
      filter->Modified();
      watcher->Seen.clear();
      watcher->AbortAt = event;
      filter->Update();
      EXPECT_EQ(countPoints(), 0) << event;
      EXPECT_EQ(filter->GetErrorCode(), 0u);
      watcher->AbortAt = std::numeric_limits<std::size_t>::max();
      filter->SetAbortExecute(0);
      filter->Modified();
      filter->Update();
      EXPECT_EQ(countPoints(), expected);
    }
    EXPECT_EQ(errors->count(), 0u);
  }
}

TEST(Robustness, AnInputMayBeFreedOrShrinkBetweenUpdates)
{
  const auto filter = newFilter(nullptr);
  for (const vtkIdType count : { 10000, 10000, 100, 10000 })
  {
    const std::vector<double> expected = pointsOf(outputOf(newFilter(newCloud(count))));
    EXPECT_FALSE(expected.empty());
    filter->SetInputData(newCloud(count));
    EXPECT_EQ(pointsOf(outputOf(filter)), expected);
    filter->SetInputData(nullptr);
  }
  const auto cloud = newCloud(10000);
  filter->SetInputData(cloud);
  filter->Update();
  cloud->ShallowCopy(newCloud(100));
  EXPECT_EQ(pointsOf(outputOf(filter)), pointsOf(outputOf(newFilter(newCloud(100)))));
}

// A kept tree holds no reference to an array of the input.
TEST(Robustness, AnInputIsNotReferencedAfterAnUpdate)
{
  for (const int association : { ofPoints, ofCells })
  {
    const auto input = newVertexCells(1000);
    input->GetPointData()->ShallowCopy(input->GetCellData());
    vtkDataArray* const points = input->GetPoints()->GetData();
    const int arrayReferences = distancesOf(input)->GetReferenceCount();
    const int pointReferences = points->GetReferenceCount();
    const auto filter = newFilter(input);
    filter->SetInputArrayToProcess(0, 0, 0, association, "distance");
    EXPECT_GT(outputOf(filter)->GetNumberOfPoints(), 0);
    EXPECT_EQ(distancesOf(input)->GetReferenceCount(), arrayReferences);
    EXPECT_EQ(points->GetReferenceCount(), pointReferences);
  }
}

TEST(Robustness, FiltersRunSideBySideInThreads)
{
  const auto cloud = newCloud(30000);
  const std::vector<double> expected = pointsOf(outputOf(newFilter(cloud)));
  EXPECT_FALSE(expected.empty());
  std::vector<std::vector<double>> found(3);
  std::vector<std::thread> threads;
  for (std::vector<double>& points : found)
  {
    // Each has a data set of its own, as VTK demands; arrays are shared.
    auto input = vtkSmartPointer<vtkPolyData>::New();
    input->ShallowCopy(cloud);
    threads.emplace_back(
      [input, &points]()
      {
        for (int update = 0; update < 3; ++update)
        {
          points = pointsOf(outputOf(newFilter(input)));
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (const std::vector<double>& points : found)
  {
    EXPECT_EQ(points, expected);
  }
}
