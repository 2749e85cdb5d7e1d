// SPDX-License-Identifier: GPL-3.0-or-later
// Composite data: all blocks as one cloud, or each separately.
#include "InputTesting.h"

#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"

using namespace inputtesting;

namespace
{

using Blocks = std::vector<vtkSmartPointer<vtkDataSet>>;

/// Adjacent blocks of several kinds. Two of them have the points of a shared face.
Blocks abuttingBlocks()
{
  const std::array<int, 3> cells{ 4, 4, 4 };
  const Blocks blocks{ newImage(cells, 0.25),
    rectilinearOf(newImage(cells, 0.25, { 0.0, -1.0, -1.0 })),
    unstructuredOf(newImage(cells, 0.25, { -1.0, 0.0, -1.0 })) };
  for (vtkDataSet* const block : blocks)
  {
    addField(block, ofPoints);
    addField(block, ofCells);
  }
  return blocks;
}

Samples samplesOfAll(const Blocks& blocks, int association = ofPoints)
{
  Samples samples;
  for (vtkDataSet* const block : blocks)
  {
    append(samples, samplesOf(block, association));
  }
  return samples;
}

/// The same blocks in every composite that is a tree.
std::vector<vtkSmartPointer<vtkCompositeDataSet>> everyTree(const Blocks& blocks)
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
  const Blocks blocks = abuttingBlocks();
  for (vtkCompositeDataSet* const composite : everyTree(blocks))
  {
    SCOPED_TRACE(composite->GetClassName());
    expectSame(composite, ofPoints, samplesOfAll(blocks));
    expectSame(composite, ofCells, samplesOfAll(blocks, ofCells));
  }
}

namespace
{

template <class TFilter>
void expectStructureKept()
{
  const Blocks blocks = abuttingBlocks();
  for (vtkCompositeDataSet* const composite : everyTree(blocks))
  {
    SCOPED_TRACE(composite->GetClassName());
    const auto filter = filterOf<TFilter>(composite);
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
      EXPECT_GT(surface->GetNumberOfPoints(), 0);
      EXPECT_EQ(everythingOf(surface), everythingOf(outputOf(filterOf<TFilter>(blocks[block++]))));
    }
    EXPECT_EQ(block, blocks.size());

    filter->ContourBlocksOff();
    EXPECT_EQ(everythingOf(outputOf(filter)),
      everythingOf(outputOf(filterOf<TFilter>(cloudOf(samplesOfAll(blocks))))));
  }
}

} // namespace

TEST(Blocks, ContouringEachBlockKeepsTheStructure)
{
  expectStructureKept<Isopoints>();
  expectStructureKept<Isosurface>();
}

TEST(Blocks, OnlyArraysOfAllBlocksAreInTheOutput)
{
  const Blocks blocks = abuttingBlocks();
  for (std::size_t i = 0; i < 3; ++i)
  {
    vtkDataSet* const block = blocks[i];
    const vtkIdType count = block->GetNumberOfPoints();
    vtkPointData* const data = block->GetPointData();
    data->AddArray(textsOf("names", count, [](vtkIdType) { return ""; }));
    data->AddArray(arrayOf(
      "everywhere", count, [&](vtkIdType point) { return 2.0 * block->GetPoint(point)[0]; }));
    data->AddArray(newArray("short", 2));
    if (i == 1)
    {
      data->AddArray(newArray("somewhere", count));
    }
    i < 2 ? data->AddArray(newArray<vtkIntArray>("of several types", count))
          : data->AddArray(newArray("of several types", count));
  }
  const auto filter = filterOf(everyTree(blocks)[0]);
  // Arrays are interpolated along edges; projected points do not lie on these.
  filter->SetProjection(Isopoints::NO_PROJECTION);
  const auto errors = watchErrors(filter);
  vtkPolyData* const output = outputOf(filter);
  EXPECT_EQ(errors->count(), 0u);
  ASSERT_GT(output->GetNumberOfPoints(), 20);
  for (const char* const name : { "somewhere", "of several types", "short" })
  {
    EXPECT_FALSE(output->GetPointData()->HasArray(name)) << name;
  }
  EXPECT_TRUE(output->GetPointData()->GetAbstractArray("names"));
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    ASSERT_NEAR(
      findArray(output, "everywhere")->GetComponent(i, 0), 2.0 * output->GetPoint(i)[0], 1e-14);
  }
}

TEST(Blocks, BlocksWithoutTheArrayTakeNoPartAndAreCounted)
{
  Blocks blocks = abuttingBlocks();
  const vtkIdType count = blocks[1]->GetNumberOfPoints();
  blocks[1]->GetPointData()->RemoveArray("f");
  const auto composite = everyTree(blocks)[1];
  const auto filter = filterOf(composite);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(), count);
  blocks.erase(blocks.begin() + 1);
  expectSame(composite, ofPoints, samplesOfAll(blocks));

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
    vtkDataObject* const empty = filter->GetOutputDataObject(0);
    EXPECT_EQ(vtkCompositeDataSet::SafeDownCast(empty) != nullptr, byBlock);
    expectEmpty(empty);
  }
  EXPECT_EQ(errors->count(), 2u);
}

TEST(Blocks, EachStepOfATimeSeriesIsAsIfComputedAlone)
{
  Blocks blocks = abuttingBlocks();
  const auto kept = filterOf(everyTree(blocks)[0]);
  const std::vector<std::function<void()>> steps{
    []() {},
    [&]() { kept->SetValue(0, 0.1); },
    [&]()
    {
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
    },
    [&]()
    {
      vtkPoints* const points = vtkPointSet::SafeDownCast(blocks[2])->GetPoints();
      move(points, [](const Vector& p) { return Vector{ p[0] + 0.1 * p[2], 1.25 * p[1], p[2] }; });
      points->Modified();
    },
    [&]()
    {
      blocks[0]->GetPointData()->AddArray(ghostsOf(
        blocks[0]->GetNumberOfPoints(), [](vtkIdType i) { return i < 30 ? duplicatePoint : 0; }));
    },
    [&]() { std::swap(blocks[0], blocks[2]); },
    [&]() { blocks.pop_back(); },
  };
  for (std::size_t step = 0; step < steps.size(); ++step)
  {
    steps[step]();
    for (const int run : { 0, 1, 2, 3, 4, 5 })
    {
      SCOPED_TRACE(testing::Message() << "step " << step << ", run " << run);
      const int association = run < 3 ? ofPoints : ofCells;
      const auto update = [&](Isopoints* filter)
      {
        filter->SetInputArrayToProcess(0, 0, 0, association, "f");
        filter->SetInputData(everyTree(blocks)[0]);
        filter->SetContourBlocks(run % 3 == 1);
        filter->Update();
        return everythingOf(filter->GetOutputDataObject(0));
      };
      const auto fresh = filterOf(nullptr);
      fresh->SetValue(0, kept->GetValue(0));
      const std::vector<double> expected = update(fresh);
      EXPECT_FALSE(expected.empty());
      EXPECT_EQ(update(kept), expected);
    }
  }
}

TEST(Blocks, MixedTypesOfPointsAndScalarsLoseNoPrecision)
{
  const auto cloud = newCloud(4000);
  vtkNew<vtkPolyData> upper;
  vtkNew<vtkPoints> floats;
  vtkNew<vtkIntArray> whole;
  whole->SetName("f");
  Samples lower;
  Samples all;
  for (vtkIdType i = 0; i < 4000; ++i)
  {
    const Vector p = placeOf(cloud, i);
    const double value = distancesOf(cloud)->GetValue(i);
    if (i < 2000)
    {
      lower.push_back({ p[0] + 1e-12, p[1], p[2], value });
      continue;
    }
    const int rounded = value > 0.7 ? 1 : 0;
    floats->InsertNextPoint(p.data());
    whole->InsertNextValue(rounded);
    all.push_back({ p[0], p[1], p[2], static_cast<double>(rounded) });
  }
  upper->SetPoints(floats);
  upper->GetPointData()->SetScalars(whole);
  all.insert(all.begin(), lower.begin(), lower.end());
  expectSame(blocksOf({ cloudOf(lower), upper.Get() }), ofPoints, all);
}
