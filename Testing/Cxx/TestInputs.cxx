// SPDX-License-Identifier: GPL-3.0-or-later
// Every kind of data set yields the same output as a point cloud of the same samples.
#include "InputTesting.h"

#include "Input/vtkIsopointCompatibility.h"

using namespace inputtesting;

namespace
{

struct Older
{
  int cells() const { return 1; }
};

struct Newer
{
  int cells() const { return 1; }
  int newCells() const { return 2; }
};

template <class T>
int cellsOf(const T& object)
{
  return vtkCallNewer(
    &object, [](auto* any) -> decltype(any->newCells()) { return any->newCells(); },
    [](auto* any) { return any->cells(); });
}

} // namespace

TEST(Inputs, FunctionsOfNewerVersionsAreFound)
{
  EXPECT_EQ(cellsOf(Older()), 1);
  EXPECT_EQ(cellsOf(Newer()), 2);
}

TEST(Inputs, PointDataOfEveryDataSet)
{
  std::vector<vtkSmartPointer<vtkDataSet>> inputs = everyGrid();
  auto pointSet = vtkSmartPointer<vtkPointSet>::New();
  pointSet->SetPoints(pointsOfDataSet(inputs[0]));
  inputs.push_back(pointSet);
  auto polyData = vtkSmartPointer<vtkPolyData>::New();
  polyData->SetPoints(pointsOfDataSet(inputs[0]));
  inputs.push_back(polyData);
  for (vtkDataSet* const input : inputs)
  {
    SCOPED_TRACE(input->GetClassName());
    addPointField(input);
    expectSame(input, vtkDataObject::FIELD_ASSOCIATION_POINTS, pointSamples(input));
  }
}

TEST(Inputs, CellDataAreSamplesAtTheCellsCenters)
{
  for (vtkDataSet* const input : everyGrid())
  {
    SCOPED_TRACE(input->GetClassName());
    addCellField(input);
    Samples samples;
    for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
    {
      samples.add(meanOfCorners(input, cell).data(),
        input->GetCellData()->GetArray("f")->GetComponent(cell, 0));
    }
    expectSame(input, vtkDataObject::FIELD_ASSOCIATION_CELLS, samples);
    expectSame(input, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, samples);
  }
}

// Cells of different types, a flat image, one of a single row, a rotated one.
TEST(Inputs, CellCentersAreThoseOfVtkCellCenters)
{
  const auto check = [](vtkDataSet* input, double tolerance)
  {
    SCOPED_TRACE(input->GetClassName());
    const auto f = newArray<vtkDoubleArray>("f", input->GetNumberOfCells());
    for (vtkIdType i = 0; i < input->GetNumberOfCells(); ++i)
    {
      f->SetValue(i, static_cast<double>((i * 37) % 11) / 11.0);
    }
    input->GetCellData()->SetScalars(f);
    vtkNew<vtkCellCenters> centers;
    centers->SetInputData(input);
    centers->Update();
    const auto expected = newFilter(centers->GetOutput());
    expected->Update();
    const auto found = newFilter(input, vtkDataObject::FIELD_ASSOCIATION_CELLS);
    found->Update();
    const std::vector<double> expectedPoints = pointsOf(expected->GetOutput());
    const std::vector<double> foundPoints = pointsOf(found->GetOutput());
    EXPECT_FALSE(expectedPoints.empty());
    ASSERT_EQ(foundPoints.size(), expectedPoints.size());
    for (std::size_t i = 0; i < foundPoints.size(); ++i)
    {
      ASSERT_NEAR(foundPoints[i], expectedPoints[i], tolerance);
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
  vtkNew<vtkImageData> flat;
  flat->SetDimensions(20, 1, 20);
  check(flat, 0.0);
  flat->SetDimensions(40, 1, 1);
  check(flat, 0.0);
  const auto turned = newImage(6, 0.5, 3.0, 4.0, 5.0);
  turned->SetDirectionMatrix(0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
  turned->SetExtent(2, 8, -3, 4, 1, 6);
  check(turned, 1e-12);
}

TEST(Inputs, EmptyCellsAreLeftOutAndCounted)
{
  const auto grid = unstructuredOf(newImage(8, 0.25, -1.0, -1.0, -1.0));
  grid->InsertNextCell(VTK_EMPTY_CELL, 0, nullptr);
  addCellField(grid);
  const auto filter = newFilter(grid, vtkDataObject::FIELD_ASSOCIATION_CELLS);
  filter->Update();
  EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 20);
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(), 1);
}

TEST(Inputs, GhostAndHiddenCellsAreLeftOut)
{
  for (const unsigned char bit : { vtkDataSetAttributes::DUPLICATECELL,
         vtkDataSetAttributes::HIDDENCELL, vtkDataSetAttributes::REFINEDCELL })
  {
    for (vtkDataSet* const input : everyGrid())
    {
      SCOPED_TRACE(testing::Message() << input->GetClassName() << " " << int(bit));
      addCellField(input);
      const auto ghosts = newGhosts(input->GetNumberOfCells());
      Samples samples;
      for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
      {
        if (cell % 5 == 2)
        {
          ghosts->SetValue(cell, bit);
          continue;
        }
        samples.add(meanOfCorners(input, cell).data(),
          input->GetCellData()->GetArray("f")->GetComponent(cell, 0));
      }
      input->GetCellData()->AddArray(ghosts);
      expectSame(input, vtkDataObject::FIELD_ASSOCIATION_CELLS, samples);
    }
  }
}

TEST(Inputs, CellsWithAHiddenPointAndPointsOfHiddenCellsOnlyAreLeftOut)
{
  const auto image = newImage(8, 0.25, -1.0, -1.0, -1.0);
  addCellField(image);
  addPointField(image);
  const auto pointGhosts = newGhosts(image->GetNumberOfPoints());
  pointGhosts->SetValue(100, vtkDataSetAttributes::HIDDENPOINT);
  image->GetPointData()->AddArray(pointGhosts);
  Samples samples;
  for (vtkIdType cell = 0; cell < image->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> corners;
    image->GetCellPoints(cell, corners);
    if (corners->IsId(100) < 0)
    {
      samples.add(meanOfCorners(image, cell).data(),
        image->GetCellData()->GetArray("f")->GetComponent(cell, 0));
    }
  }
  expectSame(image, vtkDataObject::FIELD_ASSOCIATION_CELLS, samples);

  image->GetPointData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  const auto cellGhosts = newGhosts(image->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < image->GetNumberOfCells(); ++cell)
  {
    cellGhosts->SetValue(cell, cell % 8 >= 4 ? vtkDataSetAttributes::REFINEDCELL : 0);
  }
  image->GetCellData()->AddArray(cellGhosts);
  Samples visible;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    if (i % 9 <= 4)
    {
      visible.add(image->GetPoint(i), fieldAt(image->GetPoint(i)));
    }
  }
  expectSame(image, vtkDataObject::FIELD_ASSOCIATION_POINTS, visible);
}

// An array that is removed in one step and added again in the next.
TEST(Inputs, ArraysMayBeRemovedAndAddedAgain)
{
  const auto image = newImage(8, 0.25, -1.0, -1.0, -1.0);
  addPointField(image);
  const vtkSmartPointer<vtkDataArray> f = image->GetPointData()->GetArray("f");
  const auto filter = newFilter(image);
  const auto errors = watchErrors(filter);
  filter->Update();
  const auto expected = everythingOf(filter->GetOutput());
  EXPECT_FALSE(expected.empty());
  image->GetPointData()->RemoveArray("f");
  filter->Update();
  expectEmpty(filter->GetOutput());
  EXPECT_EQ(errors->Count, 1);
  image->GetPointData()->AddArray(f);
  filter->Update();
  EXPECT_EQ(errors->Count, 1);
  EXPECT_EQ(everythingOf(filter->GetOutput()), expected);
}
