// SPDX-License-Identifier: GPL-3.0-or-later
// The filters that interpolate samples at places: probe, line, grid and gradient. Kinds of samples
// and places, null points, arrays, messages. Values are those of one plain cloud, which
// Testing/Library/TestAgainstFilters.py compares with the C library.
#include "InputTesting.h"

#include "vtkScatteredGradientFilter.h"
#include "vtkScatteredGridFilter.h"
#include "vtkScatteredLineFilter.h"
#include "vtkScatteredProbeFilter.h"

#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <cerrno>
#include <cstring>

using namespace inputtesting;

namespace
{

using Probe = vtkScatteredProbeFilter;
using Grid = vtkScatteredGridFilter;
using Line = vtkScatteredLineFilter;
using Gradient = vtkScatteredGradientFilter;

/// Numbers to compare to the last bit, with NaN equal to itself.
std::vector<std::uint64_t> bitsOf(vtkDataArray* array)
{
  const std::vector<double> numbers = numbersOf(array);
  std::vector<std::uint64_t> bits(numbers.size());
  std::memcpy(bits.data(), numbers.data(), numbers.size() * sizeof(double));
  return bits;
}

vtkSmartPointer<Probe> probeOf(vtkDataObject* samples, vtkDataObject* places)
{
  auto filter = vtkSmartPointer<Probe>::New();
  filter->SetInputData(places);
  filter->SetSourceData(samples);
  return filter;
}

template <class TFilter>
vtkSmartPointer<TFilter> filterOn(vtkDataObject* samples)
{
  auto filter = vtkSmartPointer<TFilter>::New();
  filter->SetInputData(samples);
  return filter;
}

/// Updates without an error.
template <class TFilter>
vtkDataSet* updated(const vtkSmartPointer<TFilter>& filter)
{
  const auto errors = watchErrors(filter);
  filter->Modified();
  filter->Update();
  EXPECT_EQ(errors->count(), 0u) << errors->last();
  EXPECT_EQ(filter->GetErrorCode(), 0u);
  return vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0));
}

/// One error that contains a text, and an empty output.
void expectError(vtkScatteredAlgorithm* filter, const std::string& text)
{
  const auto errors = watchErrors(filter);
  filter->Update();
  EXPECT_EQ(errors->count(), 1u);
  expectContains(errors->last(), text);
  EXPECT_EQ(filter->GetErrorCode(), static_cast<unsigned long>(EINVAL));
  EXPECT_EQ(filter->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::POINT), 0);
}

std::vector<std::uint64_t> probed(
  vtkDataObject* samples, vtkDataObject* places, const char* name = "f")
{
  return bitsOf(updated(probeOf(samples, places))->GetPointData()->GetArray(name));
}

vtkSmartPointer<vtkPolyData> newPlaces()
{
  return newCloud(200);
}

/// Samples of a field on a grid, "f", and vectors whose derivatives are known: "v".
vtkSmartPointer<vtkPolyData> newVectors(vtkIdType count)
{
  const auto cloud = newCloud(count, VTK_DOUBLE);
  const auto v = newArray<vtkDoubleArray>("v", count, 3);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const Vector p = placeOf(cloud, i);
    v->SetTuple3(i, 2.0 * p[0] - 3.0 * p[1] + 5.0 * p[2], 7.0 * p[0] + 11.0 * p[1] - 13.0 * p[2],
      -17.0 * p[0] + 19.0 * p[1] + 23.0 * p[2]);
  }
  cloud->GetPointData()->AddArray(v);
  return cloud;
}

std::vector<std::string> namesOf(vtkDataSetAttributes* attributes)
{
  std::vector<std::string> names;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    names.emplace_back(attributes->GetArrayName(i));
  }
  return names;
}

} // namespace

TEST(ProbeFilters, SamplesOfEveryKindAreOneCloud)
{
  const auto places = newPlaces();
  forEachGridAndCloud([&](vtkDataSet* samples, vtkPolyData* cloud)
    { EXPECT_EQ(probed(samples, places), probed(cloud, places)); });
  // Blocks, one null and one no data set; ghosts; positions that are not finite.
  const auto cloud = newCloud(1000, VTK_DOUBLE);
  const auto expected = probed(cloud, places, "distance");
  const auto all = blocksOf(
    { everyNth(cloud, 0, 2), nullptr, vtkSmartPointer<vtkTable>::New(), everyNth(cloud, 1, 2) });
  const auto inOrder = newCloud(1000, VTK_DOUBLE);
  for (vtkIdType i = 0; i < 1000; ++i)
  {
    const vtkIdType from = i < 500 ? 2 * i : 2 * i - 999;
    inOrder->GetPoints()->SetPoint(i, cloud->GetPoint(from));
    inOrder->GetPointData()->SetTuple(i, from, cloud->GetPointData());
  }
  EXPECT_EQ(probed(all, places, "distance"), probed(inOrder, places, "distance"));
  const auto more = newCloudWithGhosts(1003, 1000, VTK_DOUBLE);
  more->GetPoints()->SetPoint(1002, infinity, 0.0, 0.0);
  EXPECT_EQ(probed(more, places, "distance"), expected);
}

TEST(ProbeFilters, PlacesOfEveryKindGetTheSameValues)
{
  const auto cloud = newCloud(1000);
  for (const vtkSmartPointer<vtkDataSet>& grid : everyGrid())
  {
    SCOPED_TRACE(grid->GetClassName());
    addField(grid, ofCells);
    addField(grid, ofPoints);
    grid->GetPointData()->AddArray(
      ghostsOf(grid->GetNumberOfPoints(), [](vtkIdType i) { return i == 0 ? 1 : 0; }));
    const auto plain = cloudOf(samplesOf(grid, ofPoints));
    const auto filter = probeOf(cloud, grid);
    vtkDataSet* const output = updated(filter);
    EXPECT_STREQ(output->GetClassName(), grid->GetClassName());
    EXPECT_EQ(output->GetNumberOfCells(), grid->GetNumberOfCells());
    EXPECT_EQ(
      bitsOf(output->GetPointData()->GetArray("distance")), probed(cloud, plain, "distance"));
    EXPECT_EQ(
      namesOf(output->GetPointData()), (std::vector<std::string>{ "vtkGhostType", "distance", "x",
                                         "position", "vtkValidPointMask" }));
    EXPECT_STREQ(output->GetPointData()->GetScalars()->GetName(), "distance");
    EXPECT_EQ(output->GetCellData()->GetNumberOfArrays(), 0);
    filter->PassPointArraysOn();
    filter->PassCellArraysOn();
    EXPECT_TRUE(updated(filter)->GetPointData()->HasArray("f"));
    EXPECT_TRUE(updated(filter)->GetCellData()->HasArray("f"));
  }
  const auto filter = probeOf(
    cloud, blocksOf({ newPlaces(), nullptr, vtkSmartPointer<vtkTable>::New(), newCloud(7) }));
  filter->Update();
  auto* const blocks = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutput());
  ASSERT_TRUE(blocks);
  ASSERT_EQ(blocks->GetNumberOfBlocks(), 4u);
  EXPECT_FALSE(blocks->GetBlock(1));
  EXPECT_FALSE(blocks->GetBlock(2));
  for (const unsigned int i : { 0u, 3u })
  {
    auto* const block = vtkDataSet::SafeDownCast(blocks->GetBlock(i));
    EXPECT_EQ(bitsOf(block->GetPointData()->GetArray("distance")),
      probed(cloud, i == 0 ? newPlaces() : newCloud(7), "distance"));
  }
  // Hyper tree grids have no points: none is a place, and as leaves they are left out.
  const auto trees = probeOf(cloud, newHyperTreeGrid());
  const auto errors = watchErrors(trees->GetExecutive());
  trees->Update();
  ASSERT_EQ(errors->count(), 1u);
  expectContains(errors->last(), "vtkHyperTreeGrid");
  const auto among = probeOf(cloud, blocksOf({ newHyperTreeGrid(), newPlaces() }));
  among->Update();
  EXPECT_EQ(among->GetErrorCode(), 0u);
  EXPECT_FALSE(vtkMultiBlockDataSet::SafeDownCast(among->GetOutput())->GetBlock(0));
}

TEST(ProbeFilters, NullPointsFollowTheStrategy)
{
  const auto cloud = newCloud(1000);
  const vtkIdType count = cloud->GetNumberOfPoints();
  cloud->GetPointData()->AddArray(
    arrayOf<vtkIntArray>("int", count, [](vtkIdType i) { return static_cast<double>(i % 50); }));
  cloud->GetPointData()->AddArray(
    arrayOf<vtkIdTypeArray>("wide", count, [](vtkIdType i) { return static_cast<double>(i); }));
  cloud->GetPointData()->GetArray("wide")->SetVariantValue(0, (vtkTypeInt64{ 1 } << 60) + 1);
  const auto bits = newArray<vtkBitArray>("bit", count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    bits->SetValue(i, static_cast<int>(i % 2));
  }
  cloud->GetPointData()->AddArray(bits);
  const auto places = newCloud(3);
  places->GetPoints()->SetPoint(0, 9.0, 9.0, 9.0);
  places->GetPoints()->SetPoint(1, cloud->GetPoint(0));
  places->GetPoints()->SetPoint(2, notANumber, 0.0, 0.0);
  const auto filter = probeOf(cloud, places);
  vtkPointData* points = updated(filter)->GetPointData();
  EXPECT_EQ(
    numbersOf(points->GetArray("vtkValidPointMask")), (std::vector<double>{ 0.0, 1.0, 0.0 }));
  EXPECT_STREQ(points->GetArray("vtkValidPointMask")->GetClassName(), "vtkCharArray");
  EXPECT_EQ(points->GetArray("int")->GetDataType(), VTK_DOUBLE);
  EXPECT_TRUE(std::isnan(points->GetArray("distance")->GetTuple1(0)));
  EXPECT_TRUE(std::isnan(points->GetArray("position")->GetComponent(2, 2)));

  filter->SetInterpolation(Probe::NEAREST);
  filter->SetNullPointsStrategy(Probe::NULL_VALUE);
  filter->SetNullValue(-1e12);
  points = updated(filter)->GetPointData();
  EXPECT_FALSE(points->HasArray("vtkValidPointMask"));
  for (const auto& [name, type, outside] : std::vector<std::tuple<std::string, int, double>>{
         { "distance", VTK_DOUBLE, -1e12 }, { "x", VTK_FLOAT, static_cast<float>(-1e12) },
         { "int", VTK_INT, 0.0 }, { "wide", VTK_ID_TYPE, -1e12 }, { "bit", VTK_BIT, 0.0 } })
  {
    SCOPED_TRACE(name);
    vtkDataArray* const array = points->GetArray(name.c_str());
    EXPECT_EQ(array->GetDataType(), type);
    EXPECT_EQ(array->GetTuple1(0), outside);
    EXPECT_EQ(
      array->GetVariantValue(1), cloud->GetPointData()->GetArray(name.c_str())->GetVariantValue(0));
  }

  filter->SetNullPointsStrategy(Probe::CLOSEST_POINT);
  filter->SetInterpolation(Probe::BLEND);
  filter->MarkBlankPointsAndCellsOn();
  points = updated(filter)->GetPointData();
  EXPECT_GT(points->GetArray("distance")->GetTuple1(0), 1.0);
  EXPECT_EQ(points->GetArray("vtkGhostType")->GetTuple1(0), hiddenPoint);
  EXPECT_EQ(points->GetArray("vtkGhostType")->GetTuple1(1), 0);
  filter->SetNullPointsStrategy(7);
  filter->SetInterpolation(-3);
  EXPECT_EQ(filter->GetNullPointsStrategy(), Probe::CLOSEST_POINT);
  EXPECT_EQ(filter->GetInterpolation(), Probe::BLEND);
}

TEST(ProbeFilters, MessagesNameTheCause)
{
  const auto places = newPlaces();
  const auto cloud = newCloud(1000);
  cloud->GetPointData()->AddArray(
    textsOf("names", 1000, [](vtkIdType) { return std::string("a"); }));
  const auto other = newCloud(10);
  other->GetPointData()->RemoveArray("x");
  const auto filter = probeOf(blocksOf({ cloud, other }), places);
  const auto notes = watchMessages(filter, vtkCommand::MessageEvent);
  const auto warnings = watchMessages(filter, vtkCommand::WarningEvent);
  EXPECT_FALSE(updated(filter)->GetPointData()->HasArray("names"));
  EXPECT_FALSE(updated(filter)->GetPointData()->HasArray("x"));
  ASSERT_EQ(notes->count(), 1u) << "not repeated while it lasts";
  expectContains(notes->last(), "\"names\", \"x\"");

  cloud->GetPoints()->SetPoint(3, notANumber, 0.0, 0.0);
  cloud->GetPoints()->Modified();
  filter->SetSourceData(cloud);
  updated(filter);
  expectContains(notes->All[1], "Skipped 1 of 1000 samples: not finite");
  EXPECT_EQ(filter->GetNumberOfSamples(), 1000);
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(), 1);
  EXPECT_EQ(warnings->count(), 0u);

  filter->SetSourceData(newCloud(10));
  const auto away = newCloud(2);
  move(away->GetPoints(), [](const Vector& p) { return Vector{ p[0] + 9.0, p[1], p[2] }; });
  filter->SetInputData(away);
  updated(filter);
  ASSERT_EQ(warnings->count(), 1u);
  expectContains(warnings->last(), "All 2 points are outside of the samples");

  const auto bare = newCloud(100);
  bare->GetPointData()->Initialize();
  filter->SetInputData(newPlaces());
  filter->SetSourceData(bare);
  EXPECT_EQ(
    namesOf(updated(filter)->GetPointData()), std::vector<std::string>{ "vtkValidPointMask" });
  expectContains(warnings->last(), "have no arrays");

  expectError(probeOf(vtkSmartPointer<vtkPolyData>::New(), places), "no points");
  expectError(probeOf(blocksOf({ vtkSmartPointer<vtkTable>::New() }), places), "no points");
  expectError(filterOn<Gradient>(bare), "active point scalars");
}

TEST(ProbeFilters, KeptTreesFollowTheSamples)
{
  const auto places = newPlaces();
  const auto cloud = newCloud(1000);
  const auto filter = probeOf(cloud, places);
  const auto values = [&]()
  { return bitsOf(updated(filter)->GetPointData()->GetArray("distance")); };
  const auto before = values();
  EXPECT_EQ(values(), before);
  distancesOf(cloud)->SetValue(3, 20.0);
  distancesOf(cloud)->Modified();
  const auto changed = values();
  EXPECT_NE(changed, before);
  EXPECT_EQ(changed, bitsOf(updated(probeOf(cloud, places))->GetPointData()->GetArray("distance")));
  move(cloud->GetPoints(), [](const Vector& p) { return Vector{ 0.5 * p[0], p[1], p[2] }; });
  cloud->GetPoints()->Modified();
  const auto moved = values();
  EXPECT_NE(moved, changed);
  filter->KeepTreeOff();
  EXPECT_EQ(values(), moved);
  for (const double at : { 0.0, 0.1, 0.5 })
  {
    const auto watcher =
      filter->AddObserver(vtkCommand::ProgressEvent, filter.Get(), &vtkAlgorithm::AbortExecuteOn);
    filter->Modified();
    filter->Update();
    EXPECT_EQ(filter->GetErrorCode(), 0u);
    expectEmpty(filter->GetOutput());
    filter->RemoveObserver(watcher);
    filter->SetAbortExecute(0);
    EXPECT_EQ(values(), moved) << at;
  }
}

TEST(ProbeFilters, GridFillsTheBoundsOfTheSamples)
{
  const auto cloud = newCloud(1000, VTK_DOUBLE);
  cloud->GetPoints()->SetPoint(0, infinity, 0.0, 0.0);
  cloud->GetPoints()->SetPoint(1, 50.0, 0.0, 0.0);
  cloud->GetPointData()->AddArray(
    ghostsOf(1000, [](vtkIdType i) { return i == 1 ? hiddenPoint : 0; }));
  const auto filter = filterOn<Grid>(cloud);
  filter->SetSamplingDimensions(6, 5, 4);
  vtkNew<vtkImageData> whole;
  whole->ShallowCopy(updated(filter));
  int dimensions[3];
  whole->GetDimensions(dimensions);
  EXPECT_EQ((std::vector<int>{ dimensions, dimensions + 3 }), (std::vector<int>{ 6, 5, 4 }));
  double most = -2.0;
  for (vtkIdType i = 2; i < 1000; ++i)
  {
    most = std::max(most, cloud->GetPoint(i)[0]);
  }
  EXPECT_DOUBLE_EQ(whole->GetBounds()[1], most);
  const auto at = cloudOf(samplesOf(whole, ofPoints));
  const auto probe = probeOf(cloud, at);
  probe->SetNullPointsStrategy(Probe::CLOSEST_POINT);
  EXPECT_EQ(bitsOf(whole->GetPointData()->GetArray("x")),
    bitsOf(updated(probe)->GetPointData()->GetArray("x")));
  probe->SetNullPointsStrategy(Probe::MASK_POINTS);
  vtkDataArray* const mask = updated(probe)->GetPointData()->GetArray("vtkValidPointMask");
  vtkDataArray* const ghosts = whole->GetPointData()->GetArray("vtkGhostType");
  ASSERT_TRUE(ghosts);
  for (vtkIdType i = 0; i < whole->GetNumberOfPoints(); ++i)
  {
    EXPECT_EQ(ghosts->GetTuple1(i), mask->GetTuple1(i) == 0.0 ? hiddenPoint : 0.0);
  }
  for (vtkIdType cell = 0; cell < whole->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> corners;
    whole->GetCellPoints(cell, corners);
    const bool isHidden = std::any_of(corners->begin(), corners->end(),
      [&](vtkIdType corner) { return mask->GetTuple1(corner) == 0.0; });
    EXPECT_EQ(
      whole->GetCellData()->GetArray("vtkGhostType")->GetTuple1(cell), isHidden ? hidden : 0);
  }

  // Pieces are boxes with the same values.
  vtkIdType cells = 0;
  for (int piece = 0; piece < 3; ++piece)
  {
    filter->UpdatePiece(piece, 3, 0);
    vtkImageData* const box = filter->GetOutput();
    cells += box->GetNumberOfCells();
    for (vtkIdType i = 0; i < box->GetNumberOfPoints(); ++i)
    {
      const vtkIdType same = whole->FindPoint(box->GetPoint(i));
      EXPECT_EQ(box->GetPointData()->GetArray("x")->GetTuple1(i),
        whole->GetPointData()->GetArray("x")->GetTuple1(same));
    }
  }
  EXPECT_EQ(cells, whole->GetNumberOfCells());
}

TEST(ProbeFilters, GridOfFlatSamplesHasOneLayerAlsoForTheNextUpdate)
{
  const auto cloud = newCloud(1000, VTK_DOUBLE);
  const auto filter = filterOn<Grid>(cloud);
  filter->SetSamplingDimensions(6, 5, 4);
  filter->Update();
  move(cloud->GetPoints(), [](const Vector& p) { return Vector{ p[0], p[1], 3.0 }; });
  cloud->GetPoints()->Modified();
  filter->Update();
  int dimensions[3];
  filter->GetOutput()->GetDimensions(dimensions);
  EXPECT_EQ(dimensions[2], 1);
  EXPECT_EQ(filter->GetOutput()->GetBounds()[4], 3.0);
  const vtkMTimeType time = filter->GetOutput()->GetMTime();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetMTime(), time) << "nothing is missing";
  filter->SetSamplingDimensions(6, 5, 40); // pieces divide the longest axis
  const auto pipelineErrors = watchErrors(filter->GetExecutive());
  for (const bool isNew : { true, false }) // a grid whose layer is not known yet
  {
    vtkIdType inPieces = 0;
    for (int piece = 0; piece < 3; ++piece)
    {
      if (isNew)
      {
        filter->Modified();
      }
      filter->UpdatePiece(piece, 3, 0);
      EXPECT_EQ(filter->GetErrorCode(), 0u);
      inPieces += filter->GetOutput()->GetNumberOfCells();
    }
    EXPECT_EQ(inPieces, 5 * 4);
  }
  EXPECT_EQ(pipelineErrors->count(), 0u);
  const auto deep = newCloud(1000); // a layer does not outlast flat samples
  filter->SetInputData(deep);
  filter->UpdatePiece(0, 1, 0);
  filter->GetOutput()->GetDimensions(dimensions);
  EXPECT_EQ(dimensions[2], 40);
}

TEST(ProbeFilters, GridMayHaveBoundsOfItsOwn)
{
  const auto filter = filterOn<Grid>(newCloud(1000));
  filter->UseInputBoundsOff();
  filter->SetSamplingBounds(0.0, 1.0, 1.0, 0.0, 0.0, 1.0);
  expectError(filter, "ascending");
  filter->SetSamplingBounds(0.0, 1.0, 0.0, 1.0, 3.0, 3.0);
  filter->SetSamplingDimensions(3, -1, 1);
  expectError(filter, "dimension is negative");
  filter->SetSamplingDimensions(3, 2, 1);
  EXPECT_EQ(updated(filter)->GetNumberOfPoints(), 6);
}

TEST(ProbeFilters, LineHasItsLengthAsArray)
{
  const auto cloud = newCloud(1000);
  const auto filter = filterOn<Line>(cloud);
  filter->SetPoint1(-1.5, 0.0, 0.25);
  filter->SetPoint2(1.5, 0.0, 0.25);
  filter->SetResolution(12);
  vtkDataSet* const line = updated(filter);
  ASSERT_EQ(line->GetNumberOfPoints(), 13);
  EXPECT_EQ(line->GetCell(0)->GetNumberOfPoints(), 13);
  for (vtkIdType i = 0; i < 13; ++i)
  {
    EXPECT_DOUBLE_EQ(
      line->GetPointData()->GetArray("arc_length")->GetTuple1(i), 0.25 * static_cast<double>(i));
    EXPECT_DOUBLE_EQ(line->GetPoint(i)[0], -1.5 + 0.25 * static_cast<double>(i));
  }
  EXPECT_EQ(bitsOf(line->GetPointData()->GetArray("x")), probed(cloud, line, "x"));
  EXPECT_EQ(line->GetPointData()->GetArray("vtkValidPointMask")->GetTuple1(0), 0.0);
  EXPECT_EQ(line->GetPointData()->GetArray("vtkValidPointMask")->GetTuple1(6), 1.0);
  filter->UpdatePiece(1, 2, 0);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_TRUE(filter->GetOutput()->GetPointData()->HasArray("arc_length")) << "as other pieces";
}

TEST(ProbeFilters, GradientsOfAffineVectorsAreExact)
{
  const auto cloud = newVectors(500);
  cloud->GetPoints()->SetPoint(7, notANumber, 0.0, 0.0);
  const auto filter = filterOn<Gradient>(cloud);
  filter->SetInputArrayToProcess(0, 0, 0, ofPoints, "v");
  filter->SetInterpolation(Gradient::AFFINE);
  filter->ComputeDivergenceOn();
  filter->ComputeVorticityOn();
  filter->ComputeQCriterionOn();
  vtkPointData* points = updated(filter)->GetPointData();
  const std::vector<std::pair<const char*, std::vector<double>>> expected{
    { "Gradients", { 2.0, -3.0, 5.0, 7.0, 11.0, -13.0, -17.0, 19.0, 23.0 } },
    { "Divergence", { 36.0 } }, { "Vorticity", { 32.0, 22.0, 10.0 } },
    { "Q-criterion", { -0.5 * (4.0 + 121.0 + 529.0) + 21.0 + 85.0 + 247.0 } }
  };
  for (const auto& [name, numbers] : expected)
  {
    SCOPED_TRACE(name);
    vtkDataArray* const array = points->GetArray(name);
    ASSERT_TRUE(array);
    ASSERT_EQ(array->GetNumberOfComponents(), static_cast<int>(numbers.size()));
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      EXPECT_NEAR(array->GetComponent(3, static_cast<int>(i)), numbers[i], 1e-9);
      EXPECT_TRUE(std::isnan(array->GetComponent(7, static_cast<int>(i))));
    }
  }
  EXPECT_FALSE(cloud->GetPointData()->HasArray("Gradients"));
  filter->SetResultArrayName("grad");
  filter->SetInputArrayToProcess(0, 0, 0, ofPoints, "x");
  expectError(filter, "need vectors, but the array has 1 component.");
  filter->ComputeDivergenceOff();
  filter->ComputeVorticityOff();
  filter->ComputeQCriterionOff();
  points = updated(filter)->GetPointData();
  EXPECT_NEAR(points->GetArray("grad")->GetComponent(3, 0), 1.0, 1e-5);
  filter->SetInputArrayToProcess(0, 0, 0, ofPoints, "none");
  expectError(filter, "Scalar Array in ParaView");
}

TEST(ProbeFilters, GradientsBelongToTheSamples)
{
  for (const vtkSmartPointer<vtkDataSet>& grid : everyGrid())
  {
    SCOPED_TRACE(grid->GetClassName());
    for (const int association : { ofPoints, ofCells })
    {
      addField(grid, association);
      const auto expected = filterOn<Gradient>(cloudOf(samplesOf(grid, association)));
      const auto filter = filterOn<Gradient>(grid);
      filter->SetInputArrayToProcess(0, 0, 0, association, "f");
      vtkDataSet* const output = updated(filter);
      EXPECT_STREQ(output->GetClassName(), grid->GetClassName());
      EXPECT_EQ(bitsOf(output->GetAttributes(association)->GetArray("Gradients")),
        bitsOf(updated(expected)->GetPointData()->GetArray("Gradients")));
    }
  }
  // All blocks with the array are one cloud; the others stay as they are.
  const auto cloud = newVectors(1000);
  const auto table = vtkSmartPointer<vtkTable>::New();
  const auto bare = vtkSmartPointer<vtkPolyData>::New();
  bare->SetPoints(cloud->GetPoints());
  const auto filter = filterOn<Gradient>(
    blocksOf({ everyNth(cloud, 0, 2), nullptr, table, bare, everyNth(cloud, 1, 2) }));
  filter->SetInputArrayToProcess(0, 0, 0, ofPoints, "distance");
  filter->Update();
  auto* const blocks = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutput());
  ASSERT_TRUE(blocks);
  EXPECT_TRUE(vtkTable::SafeDownCast(blocks->GetBlock(2)));
  EXPECT_FALSE(blocks->GetBlock(1));
  EXPECT_EQ(vtkDataSet::SafeDownCast(blocks->GetBlock(3))->GetPointData()->GetNumberOfArrays(), 0);
  const auto whole = filterOn<Gradient>(cloud);
  vtkDataArray* const all = updated(whole)->GetPointData()->GetArray("Gradients");
  for (const int parity : { 0, 1 })
  {
    vtkDataArray* const part = vtkDataSet::SafeDownCast(blocks->GetBlock(parity == 0 ? 0 : 4))
                                 ->GetPointData()
                                 ->GetArray("Gradients");
    ASSERT_EQ(part->GetNumberOfTuples(), 500);
    for (vtkIdType i = 0; i < 500; ++i)
    {
      EXPECT_NEAR(part->GetComponent(i, 2), all->GetComponent(2 * i + parity, 2), 1e-9);
    }
  }
  // Leaves of hyper trees; coarse nodes have no gradient.
  const auto trees = newHyperTreeGrid();
  vtkHyperTreeGrid::vtkHyperTreeGridIterator iterator;
  vtkNew<vtkHyperTreeGridNonOrientedCursor> cursor;
  vtkIdType ids = 0;
  for (vtkIdType tree = 0; tree < 64; ++tree)
  {
    trees->InitializeNonOrientedCursor(cursor, tree, true);
    cursor->SetGlobalIndexStart(ids);
    if (tree == 5)
    {
      cursor->SubdivideLeaf();
    }
    ids += tree == 5 ? 9 : 1;
  }
  addScatteredField(trees, ofCells, ids);
  const auto ofTrees = filterOn<Gradient>(trees);
  ofTrees->SetInputArrayToProcess(0, 0, 0, ofCells, "f");
  ofTrees->Update();
  auto* const output = vtkHyperTreeGrid::SafeDownCast(ofTrees->GetOutput());
  ASSERT_TRUE(output);
  for (vtkIdType i = 0; i < ids; ++i)
  {
    EXPECT_EQ(std::isnan(output->GetCellData()->GetArray("Gradients")->GetTuple(i)[0]), i == 5)
      << i;
  }
}

namespace
{

/// Samples whose values are the time.
class TimeSource : public vtkPolyDataAlgorithm
{
public:
  static TimeSource* New();
  vtkTypeMacro(TimeSource, vtkPolyDataAlgorithm);

protected:
  TimeSource() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* out) override
  {
    using Pipeline = vtkStreamingDemandDrivenPipeline;
    const double steps[] = { 1.0, 2.0, 4.0 };
    const double range[] = { 1.0, 4.0 };
    out->GetInformationObject(0)->Set(Pipeline::TIME_STEPS(), steps, 3);
    out->GetInformationObject(0)->Set(Pipeline::TIME_RANGE(), range, 2);
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* out) override
  {
    using Pipeline = vtkStreamingDemandDrivenPipeline;
    const double time = out->GetInformationObject(0)->Get(Pipeline::UPDATE_TIME_STEP());
    const auto cloud = newCloud(100);
    setScalars(
      cloud, [&](const Vector&) { return time; }, "time");
    vtkPolyData::GetData(out)->ShallowCopy(cloud);
    return 1;
  }
};

vtkStandardNewMacro(TimeSource);

} // namespace

TEST(ProbeFilters, TimeStepsAreThoseOfTheSource)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkNew<TimeSource> source;
  const auto places = newCloud(1);
  places->GetPoints()->SetPoint(0, 0.0, 0.0, 0.0);
  vtkNew<Probe> filter;
  filter->SetInputData(places);
  filter->SetSourceConnection(source->GetOutputPort());
  filter->UpdateInformation();
  EXPECT_EQ(filter->GetOutputInformation(0)->Length(Pipeline::TIME_STEPS()), 3);
  for (const double time : { 2.0, 4.0 })
  {
    filter->UpdateTimeStep(time);
    auto* const output = vtkDataSet::SafeDownCast(filter->GetOutput());
    EXPECT_NEAR(output->GetPointData()->GetArray("time")->GetTuple1(0), time, 1e-12);
  }
}
