// SPDX-License-Identifier: GPL-3.0-or-later
// Every kind of data set yields the same output as a point cloud of the same samples.
#include "InputTesting.h"

#include "Common/vtkIsopointCompatibility.h"

#include "vtkCellCenters.h"

using namespace inputtesting;

TEST(Inputs, FunctionsOfNewerVersionsAreFound)
{
  const auto sizeOf = [](const auto& object)
  {
    return vtkCallNewer(
      &object, [](auto* any) -> decltype(any->size()) { return any->size(); },
      [](auto*) { return std::size_t{ 7 }; });
  };
  EXPECT_EQ(sizeOf(std::string("ab")), 2u);
  EXPECT_EQ(sizeOf(5), 7u);
}

TEST(Inputs, PointDataOfEveryDataSet)
{
  for (const double spacing : { 0.25, 0.23 }) // coordinates of the second are rounded
  {
    std::vector<vtkSmartPointer<vtkDataSet>> inputs = everyGrid(spacing);
    inputs.emplace_back(vtkSmartPointer<vtkPointSet>::New());
    inputs.emplace_back(vtkSmartPointer<vtkPolyData>::New());
    for (vtkDataSet* const input : inputs)
    {
      SCOPED_TRACE(input->GetClassName());
      if (input->GetNumberOfPoints() == 0)
      {
        vtkPointSet::SafeDownCast(input)->SetPoints(pointsOfDataSet(inputs[0]));
      }
      addField(input, ofPoints);
      expectSame(input, ofPoints, samplesOf(inputs[0], ofPoints));
    }
  }
}

TEST(Inputs, CellDataAreSamplesAtTheCellsCenters)
{
  for (vtkDataSet* const input : everyGrid())
  {
    SCOPED_TRACE(input->GetClassName());
    addField(input, ofCells);
    expectSame(input, ofCells, samplesOf(input, ofCells));
    expectSame(
      input, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, samplesOf(input, ofCells));
  }
}

// Cells of different types, a flat image, one of a single row, a rotated one.
TEST(Inputs, CellCentersAreThoseOfVtkCellCenters)
{
  const auto check = [](vtkDataSet* input, double tolerance)
  {
    SCOPED_TRACE(input->GetClassName());
    addScatteredField(input, vtkDataObject::CELL, input->GetNumberOfCells());
    vtkNew<vtkCellCenters> centers;
    centers->SetInputData(input);
    centers->Update();
    const std::vector<double> expected = pointsOf(outputOf(filterOf(centers->GetOutput())));
    const std::vector<double> found = pointsOf(outputOf(filterOf(input, ofCells)));
    EXPECT_FALSE(expected.empty());
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      ASSERT_NEAR(found[i], expected[i], tolerance);
    }
  };
  vtkNew<vtkUnstructuredGrid> mixed;
  mixed->SetPoints(newCloud(400, VTK_DOUBLE)->GetPoints());
  const int types[6] = { VTK_TETRA, VTK_HEXAHEDRON, VTK_TRIANGLE, VTK_LINE, VTK_VERTEX,
    VTK_QUADRATIC_TETRA };
  const int sizes[6] = { 4, 8, 3, 2, 1, 10 };
  for (int i = 0; i < 300; ++i)
  {
    vtkNew<vtkIdList> corners;
    for (int corner = 0; corner < sizes[i % 6]; ++corner)
    {
      corners->InsertNextId((i * 13 + corner * 29) % 400);
    }
    mixed->InsertNextCell(types[i % 6], corners);
  }
  check(mixed, 0.0);
  check(newImage({ 19, 0, 19 }, 1.0, {}), 0.0);
  check(newImage({ 39, 0, 0 }, 1.0, {}), 0.0);
  const auto turned = newImage({ 6, 6, 6 }, 0.5, { 3.0, 4.0, 5.0 });
  turned->SetDirectionMatrix(0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
  turned->SetExtent(2, 8, -3, 4, 1, 6);
  check(turned, 1e-12);
}

TEST(Inputs, EmptyCellsAreLeftOutAndCounted)
{
  const auto grid = unstructuredOf(newImage({ 8, 8, 8 }, 0.25));
  grid->InsertNextCell(VTK_EMPTY_CELL, 0, nullptr);
  addField(grid, ofCells);
  const auto filter = filterOf(grid, ofCells);
  EXPECT_GT(outputOf(filter)->GetNumberOfPoints(), 20);
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(), 1);
}

// An array that is removed in one step and added again in the next.
TEST(Inputs, ArraysMayBeRemovedAndAddedAgain)
{
  const auto image = newImage({ 8, 8, 8 }, 0.25);
  addField(image, ofPoints);
  const vtkSmartPointer<vtkDataArray> f = image->GetPointData()->GetArray("f");
  const auto filter = filterOf(image);
  const auto errors = watchErrors(filter);
  const auto expected = everythingOf(outputOf(filter));
  EXPECT_FALSE(expected.empty());
  image->GetPointData()->RemoveArray("f");
  expectEmpty(outputOf(filter));
  EXPECT_EQ(errors->count(), 1u);
  image->GetPointData()->AddArray(f);
  EXPECT_EQ(everythingOf(outputOf(filter)), expected);
  EXPECT_EQ(errors->count(), 1u);
}
