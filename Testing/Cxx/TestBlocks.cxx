// SPDX-License-Identifier: GPL-3.0-or-later
// Composite data: all blocks as one cloud, or each separately.
#include "InputTesting.h"

using namespace inputtesting;

namespace
{

/// Adjacent blocks of several kinds: the points of shared faces are in two of them.
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

Samples samplesOfAll(const std::vector<vtkSmartPointer<vtkDataSet>>& blocks)
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

TEST(Blocks, AllBlocksFormOneCloud)
{
  const auto blocks = abuttingBlocks();
  for (vtkCompositeDataSet* const composite : everyTree(blocks))
  {
    SCOPED_TRACE(composite->GetClassName());
    expectSame(composite, vtkDataObject::FIELD_ASSOCIATION_POINTS, samplesOfAll(blocks));
  }
}

TEST(Blocks, CellDataOfAllBlocksFormOneCloud)
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

TEST(Blocks, ContouringEachBlockKeepsTheStructure)
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
    const auto together = newFilter(cloudOf(samplesOfAll(blocks)));
    together->Update();
    EXPECT_EQ(everythingOf(filter->GetOutput()), everythingOf(together->GetOutput()));
  }
}

TEST(Blocks, OnlyArraysOfAllBlocksAreInTheOutput)
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
  const auto tooShort = newArray("short", 2);
  for (vtkDataSet* const block : blocks)
  {
    block->GetPointData()->AddArray(tooShort);
  }

  const auto filter = newFilter(everyTree(blocks)[0]);
  // Arrays are interpolated along edges; projected points do not lie on these.
  filter->SetProjection(vtkScatteredIsopointFilter::NO_PROJECTION);
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

TEST(Blocks, BlocksWithoutTheArrayTakeNoPartAndAreCounted)
{
  auto blocks = abuttingBlocks();
  const vtkIdType count = blocks[1]->GetNumberOfPoints();
  blocks[1]->GetPointData()->RemoveArray("f");
  const auto composite = everyTree(blocks)[1];
  const auto filter = newFilter(composite);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(), count);
  blocks.erase(blocks.begin() + 1);
  expectSame(composite, vtkDataObject::FIELD_ASSOCIATION_POINTS, samplesOfAll(blocks));

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

TEST(Blocks, EachStepOfATimeSeriesIsAsIfComputedAlone)
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

  // Samples become ghosts; blocks are exchanged; one is removed.
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

TEST(Blocks, MixedTypesOfPointsAndScalarsLoseNoPrecision)
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

TEST(Blocks, ACompositeWithoutPointsYieldsOneError)
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
