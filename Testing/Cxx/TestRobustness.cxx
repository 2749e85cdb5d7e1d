// SPDX-License-Identifier: GPL-3.0-or-later
// Events around an update: progress and aborts, inputs that are freed or change, filters side by
// side.
#include "FilterTesting.h"

#include "vtkScatteredIsosurfaceFilter.h"

#include "vtkCellData.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

vtkSmartPointer<vtkUnstructuredGrid> newVertexCells(vtkIdType count)
{
  const auto cloud = newCloud(count);
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(cloud->GetPoints());
  for (vtkIdType i = 0; i < count; ++i)
  {
    grid->InsertNextCell(VTK_VERTEX, 1, &i);
  }
  grid->GetCellData()->ShallowCopy(cloud->GetPointData());
  return grid;
}

/// Filters with inputs of points, of cells and of blocks, and the one of triangles.
std::vector<vtkSmartPointer<vtkScatteredContourFilter>> filtersOfEveryInput()
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, newVertexCells(12000));
  blocks->SetBlock(1, newVertexCells(8000));
  std::vector<vtkSmartPointer<vtkScatteredContourFilter>> filters;
  const std::vector<vtkSmartPointer<vtkDataObject>> inputs{ newCloud(20000), newVertexCells(20000),
    blocks, blocks };
  for (vtkDataObject* const input : inputs)
  {
    filters.push_back(vtkSmartPointer<vtkScatteredIsopointFilter>::New());
    filters.back()->SetInputData(input);
    filters.back()->SetInputArrayToProcess(0, 0, 0,
      input->IsA("vtkPolyData") ? vtkDataObject::FIELD_ASSOCIATION_POINTS
                                : vtkDataObject::FIELD_ASSOCIATION_CELLS,
      "distance");
    filters.back()->GenerateValues(3, 0.5, 0.8);
  }
  filters.back()->ContourBlocksOn();
  filters.push_back(vtkSmartPointer<vtkScatteredIsosurfaceFilter>::New());
  filters.back()->SetInputData(inputs[0]);
  filters.back()->GenerateValues(3, 0.5, 0.8);
  return filters;
}

} // namespace

TEST(Robustness, ProgressIncreasesFromZeroToOneInEachUpdate)
{
  for (vtkScatteredContourFilter* const filter : filtersOfEveryInput())
  {
    const auto watcher = vtkSmartPointer<ProgressWatcher>::Take(ProgressWatcher::New());
    filter->AddObserver(vtkCommand::ProgressEvent, watcher);
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
  constexpr unsigned int count = 11;
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned int i = 0; i < count; ++i)
  {
    blocks->SetBlock(i, newCloud(500 * (i + 1)));
  }
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(blocks);
  filter->ContourBlocksOn();
  filter->SetValue(0, 0.7);
  const auto watcher = vtkSmartPointer<ProgressWatcher>::Take(ProgressWatcher::New());
  filter->AddObserver(vtkCommand::ProgressEvent, watcher);
  filter->Update();
  const std::vector<double>& seen = watcher->Seen;
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  for (unsigned int i = 1; i <= count; ++i)
  {
    EXPECT_GT(std::count_if(seen.begin(), seen.end(),
                [i](double share) { return std::abs(share - i / double{ count }) < 1e-12; }),
      0)
      << i;
  }
}

TEST(Robustness, AnAbortAtAnyTimeGivesAnEmptyOutputAndAReusableFilter)
{
  for (vtkScatteredContourFilter* const filter : filtersOfEveryInput())
  {
    const auto watcher = vtkSmartPointer<ProgressWatcher>::Take(ProgressWatcher::New());
    const auto errors = watchErrors(filter);
    filter->AddObserver(vtkCommand::ProgressEvent, watcher);
    filter->KeepTreeOff(); // so that each update builds its tree
    filter->Update();
    const vtkIdType expected = filter->GetOutputDataObject(0)->GetNumberOfElements(0);
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
      EXPECT_EQ(filter->GetOutputDataObject(0)->GetNumberOfElements(0), 0) << event;
      EXPECT_EQ(filter->GetErrorCode(), 0u);
      watcher->AbortAt = std::numeric_limits<std::size_t>::max();
      filter->SetAbortExecute(0);
      filter->Modified();
      filter->Update();
      EXPECT_EQ(filter->GetOutputDataObject(0)->GetNumberOfElements(0), expected);
    }
    EXPECT_EQ(errors->Count, 0);
  }
}

TEST(Robustness, AnInputMayBeFreedBetweenUpdates)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetValue(0, 0.7);
  std::vector<double> expected;
  for (int update = 0; update < 4; ++update)
  {
    auto cloud = newCloud(10000);
    filter->SetInputData(cloud);
    cloud = nullptr;
    filter->Update();
    const std::vector<double> found = pointsOf(filter->GetOutput());
    EXPECT_FALSE(found.empty());
    expected = expected.empty() ? found : expected;
    EXPECT_EQ(found, expected);
    filter->SetInputData(nullptr);
  }
}

// A kept tree holds no reference to an array of the input.
TEST(Robustness, AnInputIsNotReferencedAfterAnUpdate)
{
  for (const bool ofCells : { false, true })
  {
    const auto input = newVertexCells(1000);
    input->GetPointData()->ShallowCopy(input->GetCellData());
    vtkDataArray* const array = input->GetPointData()->GetArray("distance");
    vtkDataArray* const points = input->GetPoints()->GetData();
    const int arrayReferences = array->GetReferenceCount();
    const int pointReferences = points->GetReferenceCount();
    vtkNew<vtkScatteredIsopointFilter> filter;
    filter->SetInputData(input);
    filter->SetInputArrayToProcess(0, 0, 0,
      ofCells ? vtkDataObject::FIELD_ASSOCIATION_CELLS : vtkDataObject::FIELD_ASSOCIATION_POINTS,
      "distance");
    filter->SetValue(0, 0.7);
    filter->Update();
    EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_EQ(array->GetReferenceCount(), arrayReferences);
    EXPECT_EQ(points->GetReferenceCount(), pointReferences);
  }
}

TEST(Robustness, AnInputThatShrinksIsReadAgain)
{
  const auto cloud = newCloud(10000);
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(cloud);
  filter->SetValue(0, 0.7);
  filter->Update();
  cloud->ShallowCopy(newCloud(100));
  filter->Update();
  vtkNew<vtkScatteredIsopointFilter> fresh;
  fresh->SetInputData(newCloud(100));
  fresh->SetValue(0, 0.7);
  fresh->Update();
  EXPECT_GT(fresh->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(pointsOf(filter->GetOutput()), pointsOf(fresh->GetOutput()));
}

TEST(Robustness, FiltersRunSideBySideInThreads)
{
  vtkNew<vtkScatteredIsopointFilter> alone;
  alone->SetInputData(newCloud(30000));
  alone->SetValue(0, 0.7);
  alone->Update();
  const std::vector<double> expected = pointsOf(alone->GetOutput());
  EXPECT_FALSE(expected.empty());
  // Each has a data set of its own, as VTK demands; arrays are shared.
  const auto cloud = newCloud(30000);
  std::vector<vtkSmartPointer<vtkPolyData>> inputs;
  std::vector<std::vector<double>> found(3);
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    inputs.push_back(vtkSmartPointer<vtkPolyData>::New());
    inputs.back()->ShallowCopy(cloud);
  }
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    threads.emplace_back(
      [input = inputs[i].Get(), &points = found[i]]()
      {
        for (int update = 0; update < 3; ++update)
        {
          vtkNew<vtkScatteredIsopointFilter> filter;
          filter->SetInputData(input);
          filter->SetValue(0, 0.7);
          filter->Update();
          points = pointsOf(filter->GetOutput());
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

TEST(Robustness, AFilterMayBeFreedWhileAnotherSharesItsInput)
{
  const auto cloud = newCloud(10000);
  vtkNew<vtkScatteredIsopointFilter> kept;
  kept->SetInputData(cloud);
  kept->SetValue(0, 0.7);
  {
    vtkNew<vtkScatteredIsopointFilter> freed;
    freed->SetInputData(cloud);
    freed->SetValue(0, 0.7);
    freed->Update();
    kept->Update();
  }
  const std::vector<double> before = pointsOf(kept->GetOutput());
  kept->SetAngle(50.0);
  kept->Update();
  kept->SetAngle(54.7);
  kept->Update();
  EXPECT_FALSE(before.empty());
  EXPECT_EQ(pointsOf(kept->GetOutput()), before);
}
