// SPDX-License-Identifier: GPL-3.0-or-later
// Every kind of input gives what the same samples as a plain cloud give.
#include "FilterTesting.h"

#include "vtkAMRBox.h"
#include "vtkBitArray.h"
#include "vtkCellArray.h"
#include "vtkCellCenters.h"
#include "vtkCellData.h"
#include "vtkExplicitStructuredGrid.h"
#include "vtkHyperTree.h"
#include "vtkHyperTreeGrid.h"
#include "vtkHyperTreeGridNonOrientedCursor.h"
#include "vtkHyperTreeGridNonOrientedGeometryCursor.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNonOverlappingAMR.h"
#include "vtkOverlappingAMR.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkRectilinearGrid.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"
#include "vtkTable.h"
#include "vtkUniformGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <functional>
#include <limits>

using namespace filtertesting;

namespace
{

constexpr double isovalue = 0.3;

double fieldAt(const double p[3])
{
  return p[0] * p[0] + 0.7 * p[1] + 0.3 * p[2] * p[2] * p[0];
}

/// Samples put together by a test, in the order of their ids.
struct Samples
{
  std::vector<std::array<double, 3>> positions;
  std::vector<double> values;

  void add(const double p[3], double value)
  {
    this->positions.push_back({ p[0], p[1], p[2] });
    this->values.push_back(value);
  }
};

vtkSmartPointer<vtkPolyData> cloudOf(const Samples& samples)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const auto f = newArray<vtkDoubleArray>("f", static_cast<vtkIdType>(samples.values.size()));
  for (std::size_t i = 0; i < samples.values.size(); ++i)
  {
    points->InsertNextPoint(samples.positions[i].data());
    f->SetValue(static_cast<vtkIdType>(i), samples.values[i]);
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  cloud->GetPointData()->SetScalars(f);
  return cloud;
}

/// Positions, normals, radii and scalars of a surface.
std::vector<double> everythingOf(vtkPolyData* output)
{
  std::vector<double> all = pointsOf(output);
  for (const char* const name : { "f", "Normals", "Radius" })
  {
    vtkDataArray* const array = output->GetPointData()->GetArray(name);
    for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
    {
      for (int c = 0; c < array->GetNumberOfComponents(); ++c)
      {
        all.push_back(array->GetComponent(i, c));
      }
    }
  }
  return all;
}

vtkNew<vtkScatteredIsopointFilter> newFilter(
  vtkDataObject* input, int association = vtkDataObject::FIELD_ASSOCIATION_POINTS)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(input);
  filter->SetValue(0, isovalue);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->SetInputArrayToProcess(0, 0, 0, association, "f");
  return filter;
}

/// The input gives, to the last bit, what the samples give.
void expectSame(vtkDataObject* input, int association, const Samples& samples)
{
  const auto expected = newFilter(cloudOf(samples));
  expected->Update();
  EXPECT_GT(expected->GetOutput()->GetNumberOfPoints(), 20);
  const auto filter = newFilter(input, association);
  const auto errors = watchErrors(filter);
  filter->Update();
  EXPECT_EQ(errors->Count, 0) << errors->Last;
  ASSERT_TRUE(filter->GetOutput());
  EXPECT_EQ(everythingOf(filter->GetOutput()), everythingOf(expected->GetOutput()));
}

void addPointField(vtkDataSet* input)
{
  const auto f = newArray<vtkDoubleArray>("f", input->GetNumberOfPoints());
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    f->SetValue(i, fieldAt(input->GetPoint(i)));
  }
  input->GetPointData()->AddArray(f);
}

Samples pointSamples(vtkDataSet* input)
{
  Samples samples;
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    samples.add(input->GetPoint(i), input->GetPointData()->GetArray("f")->GetComponent(i, 0));
  }
  return samples;
}

void append(Samples& samples, const Samples& more)
{
  samples.positions.insert(samples.positions.end(), more.positions.begin(), more.positions.end());
  samples.values.insert(samples.values.end(), more.values.begin(), more.values.end());
}

/// The mean of a cell's corners: its centre, for boxes and for tetrahedra alike.
std::array<double, 3> meanOfCorners(vtkDataSet* input, vtkIdType cell)
{
  vtkNew<vtkIdList> corners;
  input->GetCellPoints(cell, corners);
  std::array<double, 3> mean{};
  for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      mean[axis] +=
        input->GetPoint(corners->GetId(i))[axis] / static_cast<double>(corners->GetNumberOfIds());
    }
  }
  return mean;
}

void addCellField(vtkDataSet* input)
{
  const auto f = newArray<vtkDoubleArray>("f", input->GetNumberOfCells());
  for (vtkIdType i = 0; i < input->GetNumberOfCells(); ++i)
  {
    f->SetValue(i, fieldAt(meanOfCorners(input, i).data()));
  }
  input->GetCellData()->AddArray(f);
}

vtkSmartPointer<vtkUnsignedCharArray> newGhosts(vtkIdType count)
{
  const auto ghosts = newArray<vtkUnsignedCharArray>(vtkDataSetAttributes::GhostArrayName(), count);
  ghosts->Fill(0);
  return ghosts;
}

/// A box of cells of side `spacing`. All coordinates are exact, so that the same position reached
/// along another way is the same to the last bit.
template <class TImage = vtkImageData>
vtkSmartPointer<TImage> newImage(int cells, double spacing, double x, double y, double z)
{
  auto image = vtkSmartPointer<TImage>::New();
  image->SetDimensions(cells + 1, cells + 1, cells + 1);
  image->SetSpacing(spacing, spacing, spacing);
  image->SetOrigin(x, y, z);
  return image;
}

vtkSmartPointer<vtkRectilinearGrid> rectilinearOf(vtkImageData* image)
{
  auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
  grid->SetDimensions(image->GetDimensions());
  vtkNew<vtkDoubleArray> coordinates[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < image->GetDimensions()[axis]; ++i)
    {
      coordinates[axis]->InsertNextValue(image->GetOrigin()[axis] + i * image->GetSpacing()[axis]);
    }
  }
  grid->SetXCoordinates(coordinates[0]);
  grid->SetYCoordinates(coordinates[1]);
  grid->SetZCoordinates(coordinates[2]);
  return grid;
}

vtkSmartPointer<vtkPoints> pointsOfDataSet(vtkDataSet* input)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    points->InsertNextPoint(input->GetPoint(i));
  }
  return points;
}

vtkSmartPointer<vtkUnstructuredGrid> unstructuredOf(vtkDataSet* input)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(pointsOfDataSet(input));
  grid->Allocate(input->GetNumberOfCells());
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    input->GetCellPoints(cell, corners);
    grid->InsertNextCell(input->GetCellType(cell), corners);
  }
  return grid;
}

/// A box of cells as every kind of data set with cells.
std::vector<vtkSmartPointer<vtkDataSet>> everyGrid()
{
  const auto image = newImage(8, 0.25, -1.0, -1.0, -1.0);
  auto structured = vtkSmartPointer<vtkStructuredGrid>::New();
  structured->SetDimensions(image->GetDimensions());
  structured->SetPoints(pointsOfDataSet(image));
  const auto unstructured = unstructuredOf(image);
  auto explicitGrid = vtkSmartPointer<vtkExplicitStructuredGrid>::New();
  explicitGrid->SetExtent(0, 8, 0, 8, 0, 8);
  explicitGrid->SetPoints(pointsOfDataSet(image));
  vtkNew<vtkCellArray> cells;
  for (vtkIdType cell = 0; cell < image->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> corners;
    image->GetCellPoints(cell, corners);
    const vtkIdType ring[8] = { corners->GetId(0), corners->GetId(1), corners->GetId(3),
      corners->GetId(2), corners->GetId(4), corners->GetId(5), corners->GetId(7),
      corners->GetId(6) };
    cells->InsertNextCell(8, ring);
  }
  explicitGrid->SetCells(cells);
  explicitGrid->ComputeFacesConnectivityFlagsArray();
  auto uniform = vtkSmartPointer<vtkUniformGrid>::New();
  uniform->ShallowCopy(image);
  return { image, rectilinearOf(image), structured, unstructured, explicitGrid, uniform };
}

} // namespace

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

// Cells of every size, a flat image, one that is turned, one of a single row.
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

TEST(Inputs, CellsWithAHiddenPointAndPointsOfHiddenCellsAloneAreLeftOut)
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

namespace
{

/// Blocks of several kinds that abut: shared faces are doubled.
std::vector<vtkSmartPointer<vtkDataSet>> abuttingBlocks()
{
  auto second = rectilinearOf(newImage(4, 0.25, 0.0, -1.0, -1.0));
  vtkSmartPointer<vtkDataSet> third = unstructuredOf(newImage(4, 0.25, -1.0, 0.0, -1.0));
  std::vector<vtkSmartPointer<vtkDataSet>> blocks{ newImage(4, 0.25, -1.0, -1.0, -1.0), second,
    third };
  for (vtkDataSet* const block : blocks)
  {
    addPointField(block);
  }
  return blocks;
}

Samples pointSamples(const std::vector<vtkSmartPointer<vtkDataSet>>& blocks)
{
  Samples samples;
  for (vtkDataSet* const block : blocks)
  {
    append(samples, pointSamples(block));
  }
  return samples;
}

/// The same blocks in every composite that is a tree.
std::vector<vtkSmartPointer<vtkCompositeDataSet>> everyTree(
  const std::vector<vtkSmartPointer<vtkDataSet>>& blocks)
{
  auto flat = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  auto nested = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  vtkNew<vtkMultiBlockDataSet> inner;
  auto partitioned = vtkSmartPointer<vtkPartitionedDataSet>::New();
  auto collection = vtkSmartPointer<vtkPartitionedDataSetCollection>::New();
  for (unsigned int i = 0; i < blocks.size(); ++i)
  {
    flat->SetBlock(2 * i, blocks[i]); // with gaps
    partitioned->SetPartition(i, blocks[i]);
    collection->SetPartition(i, 0, blocks[i]);
    i == 0 ? nested->SetBlock(0, blocks[i]) : inner->SetBlock(i, blocks[i]);
  }
  nested->SetBlock(1, inner);
  return { flat, nested, partitioned, collection };
}

} // namespace

TEST(Inputs, AllBlocksFormOneCloud)
{
  const auto blocks = abuttingBlocks();
  for (vtkCompositeDataSet* const composite : everyTree(blocks))
  {
    SCOPED_TRACE(composite->GetClassName());
    expectSame(composite, vtkDataObject::FIELD_ASSOCIATION_POINTS, pointSamples(blocks));
  }
}

TEST(Inputs, BlocksOfCellData)
{
  auto blocks = abuttingBlocks();
  Samples samples;
  for (vtkDataSet* const block : blocks)
  {
    addCellField(block);
    for (vtkIdType cell = 0; cell < block->GetNumberOfCells(); ++cell)
    {
      samples.add(meanOfCorners(block, cell).data(),
        block->GetCellData()->GetArray("f")->GetComponent(cell, 0));
    }
  }
  for (vtkCompositeDataSet* const composite : everyTree(blocks))
  {
    SCOPED_TRACE(composite->GetClassName());
    expectSame(composite, vtkDataObject::FIELD_ASSOCIATION_CELLS, samples);
  }
}

TEST(Inputs, BlockByBlockKeepsTheStructure)
{
  const auto blocks = abuttingBlocks();
  for (vtkCompositeDataSet* const composite : everyTree(blocks))
  {
    SCOPED_TRACE(composite->GetClassName());
    const auto filter = newFilter(composite);
    filter->ContourBlocksOn();
    filter->Update();
    auto* const output = vtkCompositeDataSet::SafeDownCast(filter->GetOutputDataObject(0));
    ASSERT_TRUE(output);
    EXPECT_STREQ(output->GetClassName(), composite->GetClassName());
    const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    std::size_t block = 0;
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      auto* const surface = vtkPolyData::SafeDownCast(output->GetDataSet(iterator));
      ASSERT_TRUE(surface);
      const auto alone = newFilter(blocks[block++]);
      alone->Update();
      EXPECT_GT(surface->GetNumberOfPoints(), 0);
      EXPECT_EQ(everythingOf(surface), everythingOf(alone->GetOutput()));
    }
    EXPECT_EQ(block, blocks.size());

    filter->ContourBlocksOff();
    filter->Update();
    ASSERT_TRUE(filter->GetOutput());
    const auto together = newFilter(cloudOf(pointSamples(blocks)));
    together->Update();
    EXPECT_EQ(everythingOf(filter->GetOutput()), everythingOf(together->GetOutput()));
  }
}

TEST(Inputs, OnlyArraysOfAllBlocksSurvive)
{
  const auto blocks = abuttingBlocks();
  const auto addTo = [&](std::size_t block, vtkAbstractArray* array, const char* name)
  {
    array->SetName(name);
    array->SetNumberOfTuples(blocks[block]->GetNumberOfPoints());
    blocks[block]->GetPointData()->AddArray(array);
  };
  for (std::size_t block = 0; block < 3; ++block)
  {
    vtkNew<vtkStringArray> names;
    addTo(block, names, "names");
    vtkNew<vtkDoubleArray> everywhere;
    addTo(block, everywhere, "everywhere");
    for (vtkIdType i = 0; i < blocks[block]->GetNumberOfPoints(); ++i)
    {
      names->SetValue(i, std::string(1, static_cast<char>('a' + block)));
      everywhere->SetValue(i, 2.0 * blocks[block]->GetPoint(i)[0]);
    }
  }
  vtkNew<vtkDoubleArray> somewhere;
  addTo(1, somewhere, "somewhere");
  vtkNew<vtkIntArray> whole;
  addTo(0, whole, "of several types");
  addTo(1, whole, "of several types");
  vtkNew<vtkFloatArray> real;
  addTo(2, real, "of several types");
  blocks[2]->GetPointData()->GetArray("everywhere")->SetNumberOfComponents(1);
  const auto tooShort = newArray("short", 2);
  for (vtkDataSet* const block : blocks)
  {
    block->GetPointData()->AddArray(tooShort);
  }

  const auto filter = newFilter(everyTree(blocks)[0]);
  const auto errors = watchErrors(filter);
  filter->Update();
  EXPECT_EQ(errors->Count, 0);
  vtkPolyData* const output = filter->GetOutput();
  ASSERT_GT(output->GetNumberOfPoints(), 20);
  vtkPointData* const data = output->GetPointData();
  for (const char* const name : { "somewhere", "of several types", "short" })
  {
    EXPECT_FALSE(data->HasArray(name)) << name;
  }
  ASSERT_TRUE(data->GetArray("everywhere") && data->GetAbstractArray("names"));
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    ASSERT_NEAR(
      data->GetArray("everywhere")->GetComponent(i, 0), 2.0 * output->GetPoint(i)[0], 1e-14);
  }
}

TEST(Inputs, BlocksWithoutTheArrayTakeNoPartAndAreCounted)
{
  auto blocks = abuttingBlocks();
  const vtkIdType count = blocks[1]->GetNumberOfPoints();
  blocks[1]->GetPointData()->RemoveArray("f");
  const auto composite = everyTree(blocks)[1];
  const auto filter = newFilter(composite);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(), count);
  blocks.erase(blocks.begin() + 1);
  expectSame(composite, vtkDataObject::FIELD_ASSOCIATION_POINTS, pointSamples(blocks));

  filter->ContourBlocksOn();
  filter->Update();
  auto* const output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_TRUE(output);
  EXPECT_TRUE(output->GetBlock(0));
  auto* const inner = vtkMultiBlockDataSet::SafeDownCast(output->GetBlock(1));
  ASSERT_TRUE(inner);
  EXPECT_FALSE(inner->GetBlock(1));
  EXPECT_TRUE(inner->GetBlock(2));
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(), count);

  for (vtkDataSet* const block : blocks)
  {
    block->GetPointData()->RemoveArray("f");
  }
  composite->Modified();
  const auto errors = watchErrors(filter);
  for (const bool byBlock : { false, true })
  {
    filter->SetContourBlocks(byBlock);
    filter->Update();
    EXPECT_EQ(
      vtkCompositeDataSet::SafeDownCast(filter->GetOutputDataObject(0)) != nullptr, byBlock);
    EXPECT_EQ(filter->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::POINT), 0);
  }
  EXPECT_EQ(errors->Count, 2);
  EXPECT_NE(errors->Last.find("no point array named \"f\""), std::string::npos);
}

namespace
{

/// Two levels: a coarse box and a fine one over its lower half along x. Values are the samples'
/// positions' field, so that cells of both levels lie on one surface.
vtkSmartPointer<vtkOverlappingAMR> newOverlapping()
{
  auto amr = vtkSmartPointer<vtkOverlappingAMR>::New();
  const int blocksPerLevel[2] = { 1, 1 };
  amr->Initialize(2, blocksPerLevel);
  const double origin[3] = { -1.0, -1.0, -1.0 };
  amr->SetOrigin(origin);
  amr->SetGridDescription(VTK_XYZ_GRID);
  const auto coarse = newImage<vtkUniformGrid>(8, 0.25, -1.0, -1.0, -1.0);
  vtkNew<vtkUniformGrid> fine;
  fine->SetDimensions(9, 17, 17);
  fine->SetSpacing(0.125, 0.125, 0.125);
  fine->SetOrigin(-1.0, -1.0, -1.0);
  for (unsigned int level = 0; level < 2; ++level)
  {
    vtkUniformGrid* const grid = level == 0 ? coarse.Get() : fine.Get();
    addCellField(grid);
    addPointField(grid);
    double spacing[3];
    grid->GetSpacing(spacing);
    amr->SetSpacing(level, spacing);
    vtkAMRBox box(
      grid->GetOrigin(), grid->GetDimensions(), grid->GetSpacing(), origin, VTK_XYZ_GRID);
    amr->SetAMRBox(level, 0, box);
    amr->SetDataSet(level, 0, grid);
  }
  const auto ghosts = newGhosts(coarse->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < coarse->GetNumberOfCells(); ++cell)
  {
    ghosts->SetValue(cell, cell % 8 < 4 ? vtkDataSetAttributes::REFINEDCELL : 0);
  }
  coarse->GetCellData()->AddArray(ghosts);
  return amr;
}

} // namespace

TEST(Inputs, OverlappingAmrCountsEachPlaceOnce)
{
  const auto amr = newOverlapping();
  Samples cells;
  Samples points;
  for (unsigned int level = 0; level < 2; ++level)
  {
    vtkUniformGrid* const grid = amr->GetDataSet(level, 0);
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      if (level == 1 || cell % 8 >= 4)
      {
        cells.add(meanOfCorners(grid, cell).data(),
          grid->GetCellData()->GetArray("f")->GetComponent(cell, 0));
      }
    }
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
    {
      if (level == 1 || i % 9 >= 4)
      {
        points.add(grid->GetPoint(i), fieldAt(grid->GetPoint(i)));
      }
    }
  }
  expectSame(amr, vtkDataObject::FIELD_ASSOCIATION_CELLS, cells);
  expectSame(amr, vtkDataObject::FIELD_ASSOCIATION_POINTS, points);

  const auto filter = newFilter(amr, vtkDataObject::FIELD_ASSOCIATION_CELLS);
  filter->ContourBlocksOn();
  filter->Update();
  auto* const levels = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_TRUE(levels);
  ASSERT_EQ(levels->GetNumberOfBlocks(), 2u);
  for (unsigned int level = 0; level < 2; ++level)
  {
    auto* const boxes = vtkMultiBlockDataSet::SafeDownCast(levels->GetBlock(level));
    ASSERT_TRUE(boxes);
    const auto alone = newFilter(amr->GetDataSet(level, 0), vtkDataObject::FIELD_ASSOCIATION_CELLS);
    alone->Update();
    EXPECT_GT(alone->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_EQ(everythingOf(vtkPolyData::SafeDownCast(boxes->GetBlock(0))),
      everythingOf(alone->GetOutput()));
  }
}

TEST(Inputs, NonOverlappingAmr)
{
  vtkNew<vtkNonOverlappingAMR> amr;
  const int blocksPerLevel[2] = { 1, 2 };
  amr->Initialize(2, blocksPerLevel);
  amr->SetDataSet(0, 0, newImage<vtkUniformGrid>(8, 0.25, -1.0, -1.0, -1.0));
  amr->SetDataSet(1, 1, newImage<vtkUniformGrid>(8, 0.125, 1.0, -1.0, -1.0)); // one box is missing
  Samples samples;
  for (unsigned int level = 0; level < 2; ++level)
  {
    vtkUniformGrid* const grid = amr->GetDataSet(level, level);
    addCellField(grid);
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      samples.add(meanOfCorners(grid, cell).data(),
        grid->GetCellData()->GetArray("f")->GetComponent(cell, 0));
    }
  }
  expectSame(amr, vtkDataObject::FIELD_ASSOCIATION_CELLS, samples);
}

namespace
{

/// Trees of one to three levels; coarse nodes have values far off, which must not count.
vtkSmartPointer<vtkHyperTreeGrid> newTrees(Samples& leaves, bool withMaskAndGhosts)
{
  auto trees = vtkSmartPointer<vtkHyperTreeGrid>::New();
  trees->SetDimensions(5, 5, 5);
  trees->SetBranchFactor(2);
  vtkNew<vtkDoubleArray> coordinates;
  for (int i = 0; i < 5; ++i)
  {
    coordinates->InsertNextValue(-1.0 + 0.5 * i);
  }
  trees->SetXCoordinates(coordinates);
  trees->SetYCoordinates(coordinates);
  trees->SetZCoordinates(coordinates);
  vtkIdType offset = 0;
  for (vtkIdType tree = 0; tree < 64; ++tree)
  {
    vtkNew<vtkHyperTreeGridNonOrientedCursor> cursor;
    trees->InitializeNonOrientedCursor(cursor, tree, true);
    cursor->SetGlobalIndexStart(offset);
    if (tree % 3 != 0)
    {
      cursor->SubdivideLeaf();
      cursor->ToChild(static_cast<unsigned char>(tree % 8));
      cursor->SubdivideLeaf();
      cursor->ToParent();
    }
    offset += cursor->GetTree()->GetNumberOfVertices();
  }
  const auto f = newArray<vtkDoubleArray>("f", offset);
  f->Fill(1e6);
  const auto ghosts = newGhosts(offset);
  vtkNew<vtkBitArray> mask;
  mask->SetNumberOfValues(offset);
  const std::function<void(vtkHyperTreeGridNonOrientedGeometryCursor*)> visit =
    [&](vtkHyperTreeGridNonOrientedGeometryCursor* cursor)
  {
    const vtkIdType id = cursor->GetGlobalNodeIndex();
    mask->SetValue(id, 0);
    if (!cursor->IsLeaf())
    {
      for (unsigned char child = 0; child < cursor->GetNumberOfChildren(); ++child)
      {
        cursor->ToChild(child);
        visit(cursor);
        cursor->ToParent();
      }
      return;
    }
    double center[3];
    cursor->GetPoint(center);
    f->SetValue(id, fieldAt(center));
    if (withMaskAndGhosts && (id % 7 == 3 || id % 11 == 4))
    {
      id % 7 == 3 ? mask->SetValue(id, 1) : ghosts->SetValue(id, 1);
      return;
    }
    leaves.add(center, fieldAt(center));
  };
  for (vtkIdType tree = 0; tree < 64; ++tree)
  {
    vtkNew<vtkHyperTreeGridNonOrientedGeometryCursor> cursor;
    trees->InitializeNonOrientedGeometryCursor(cursor, tree);
    visit(cursor);
  }
  if (withMaskAndGhosts)
  {
    trees->SetMask(mask);
    trees->GetCellData()->AddArray(ghosts);
  }
  trees->GetCellData()->SetScalars(f);
  return trees;
}

} // namespace

TEST(Inputs, LeavesOfHyperTrees)
{
  for (const bool withMaskAndGhosts : { false, true })
  {
    SCOPED_TRACE(withMaskAndGhosts);
    Samples leaves;
    const auto trees = newTrees(leaves, withMaskAndGhosts);
    const auto expected = newFilter(cloudOf(leaves));
    expected->Update();
    const auto filter = newFilter(trees, vtkDataObject::FIELD_ASSOCIATION_CELLS);
    filter->Update();
    // Ids differ, and with them the order of the points, where coarse nodes stand between leaves.
    const auto sorted = [](vtkPolyData* output)
    {
      std::vector<std::array<double, 3>> points(
        static_cast<std::size_t>(output->GetNumberOfPoints()));
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        output->GetPoint(static_cast<vtkIdType>(i), points[i].data());
      }
      std::sort(points.begin(), points.end());
      return points;
    };
    ASSERT_EQ(sorted(filter->GetOutput()).size(), sorted(expected->GetOutput()).size());
    EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 20);
    const auto found = sorted(filter->GetOutput());
    const auto wanted = sorted(expected->GetOutput());
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        ASSERT_NEAR(found[i][axis], wanted[i][axis], 1e-12);
      }
    }
    const vtkIdType leafCount = trees->GetNumberOfLeaves();
    EXPECT_EQ(filter->GetNumberOfSkippedSamples(),
      leafCount - static_cast<vtkIdType>(leaves.values.size()));

    vtkNew<vtkMultiBlockDataSet> blocks;
    blocks->SetBlock(0, trees);
    const auto inBlocks = newFilter(blocks, vtkDataObject::FIELD_ASSOCIATION_CELLS);
    inBlocks->Update();
    EXPECT_EQ(everythingOf(inBlocks->GetOutput()), everythingOf(filter->GetOutput()));
  }
}

TEST(Inputs, ATimeSeriesOfBlocksIsRightAtEachStep)
{
  std::vector<vtkSmartPointer<vtkDataSet>> blocks = abuttingBlocks();
  for (vtkDataSet* const block : blocks)
  {
    addCellField(block);
  }
  const auto kept = newFilter(everyTree(blocks)[0]);
  const auto expectFresh = [&](int association)
  {
    SCOPED_TRACE(association);
    for (const bool byBlock : { false, true, false })
    {
      kept->SetContourBlocks(byBlock);
      kept->SetInputArrayToProcess(0, 0, 0, association, "f");
      kept->SetInputData(everyTree(blocks)[0]);
      kept->Update();
      const auto fresh = newFilter(everyTree(blocks)[0], association);
      fresh->SetContourBlocks(byBlock);
      fresh->SetValue(0, kept->GetValue(0));
      fresh->Update();
      if (!byBlock)
      {
        EXPECT_GT(fresh->GetOutput()->GetNumberOfPoints(), 0);
        EXPECT_EQ(everythingOf(kept->GetOutput()), everythingOf(fresh->GetOutput()));
        continue;
      }
      auto* const found = vtkMultiBlockDataSet::SafeDownCast(kept->GetOutputDataObject(0));
      auto* const expected = vtkMultiBlockDataSet::SafeDownCast(fresh->GetOutputDataObject(0));
      ASSERT_EQ(found->GetNumberOfBlocks(), expected->GetNumberOfBlocks());
      for (unsigned int i = 0; i < found->GetNumberOfBlocks(); i += 2)
      {
        EXPECT_EQ(everythingOf(vtkPolyData::SafeDownCast(found->GetBlock(i))),
          everythingOf(vtkPolyData::SafeDownCast(expected->GetBlock(i))));
      }
    }
  };
  const auto expectFreshForBoth = [&]()
  {
    expectFresh(vtkDataObject::FIELD_ASSOCIATION_POINTS);
    expectFresh(vtkDataObject::FIELD_ASSOCIATION_CELLS);
  };
  expectFreshForBoth();
  kept->SetValue(0, 0.1);
  expectFreshForBoth();

  // Values change in place, in one block only.
  for (vtkDataArray* const f :
    { blocks[1]->GetPointData()->GetArray("f"), blocks[2]->GetCellData()->GetArray("f") })
  {
    for (vtkIdType i = 0; i < f->GetNumberOfTuples(); i += 3)
    {
      f->SetComponent(i, 0, 0.8 * f->GetComponent(i, 0) - 0.05);
    }
    f->Modified();
  }
  expectFreshForBoth();

  // Positions change in place, in one block only.
  vtkPoints* const points = vtkPointSet::SafeDownCast(blocks[2])->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    const double* const p = points->GetPoint(i);
    points->SetPoint(i, p[0] + 0.1 * p[2], 1.25 * p[1], p[2]);
  }
  points->Modified();
  expectFreshForBoth();

  // Samples become ghosts, the array of a block vanishes, blocks change places, one goes.
  const auto ghosts = newGhosts(blocks[0]->GetNumberOfPoints());
  blocks[0]->GetPointData()->AddArray(ghosts);
  for (vtkIdType i = 0; i < 30; ++i)
  {
    ghosts->SetValue(i, vtkDataSetAttributes::DUPLICATEPOINT);
  }
  expectFreshForBoth();
  std::swap(blocks[0], blocks[2]);
  expectFreshForBoth();
  blocks.pop_back();
  expectFreshForBoth();
}

// The array of one step is not there in the next, and back again.
TEST(Inputs, ArraysThatVanishAndComeBack)
{
  const auto image = newImage(8, 0.25, -1.0, -1.0, -1.0);
  addPointField(image);
  const vtkSmartPointer<vtkDataArray> f = image->GetPointData()->GetArray("f");
  const auto filter = newFilter(image);
  const auto errors = watchErrors(filter);
  filter->Update();
  const auto expected = everythingOf(filter->GetOutput());
  image->GetPointData()->RemoveArray("f");
  filter->Update();
  expectEmpty(filter->GetOutput());
  EXPECT_EQ(errors->Count, 1);
  image->GetPointData()->AddArray(f);
  filter->Update();
  EXPECT_EQ(errors->Count, 1);
  EXPECT_EQ(everythingOf(filter->GetOutput()), expected);
}

TEST(Inputs, MixedTypesOfPointsAndScalarsLoseNothing)
{
  auto cloud = newCloud(4000);
  cloud->GetPointData()->GetArray("distance")->SetName("f");
  vtkNew<vtkPolyData> lower;
  vtkNew<vtkPolyData> upper;
  Samples samples;
  vtkNew<vtkPoints> doubles;
  doubles->SetDataTypeToDouble();
  vtkNew<vtkPoints> floats;
  floats->SetDataTypeToFloat();
  vtkNew<vtkIntArray> whole;
  whole->SetName("f");
  vtkNew<vtkDoubleArray> real;
  real->SetName("f");
  for (vtkIdType i = 0; i < 4000; ++i)
  {
    double p[3];
    cloud->GetPoint(i, p);
    const double value = cloud->GetPointData()->GetArray("f")->GetComponent(i, 0);
    if (i < 2000)
    {
      p[0] += 1e-12;
      doubles->InsertNextPoint(p);
      real->InsertNextValue(value);
      samples.add(p, value);
    }
    else
    {
      floats->InsertNextPoint(p);
      whole->InsertNextValue(value > 0.7 ? 1 : 0);
      samples.add(p, value > 0.7 ? 1.0 : 0.0);
    }
  }
  lower->SetPoints(doubles);
  lower->GetPointData()->SetScalars(real);
  upper->SetPoints(floats);
  upper->GetPointData()->SetScalars(whole);
  vtkNew<vtkPartitionedDataSet> blocks;
  blocks->SetPartition(0, lower);
  blocks->SetPartition(1, upper);
  expectSame(blocks, vtkDataObject::FIELD_ASSOCIATION_POINTS, samples);
}

TEST(Inputs, ACompositeWithoutPointsIsOneError)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  vtkNew<vtkPolyData> nothing;
  vtkNew<vtkTable> table;
  blocks->SetBlock(0, nothing);
  blocks->SetBlock(1, table);
  const auto filter = newFilter(blocks);
  const auto errors = watchErrors(filter);
  filter->Update();
  EXPECT_EQ(errors->Count, 1);
  EXPECT_NE(errors->Last.find("no points"), std::string::npos);
  expectEmpty(filter->GetOutput());
}
