// SPDX-License-Identifier: GPL-3.0-or-later
// What an update warns of, or notes: isovalues without points, samples left out, fits that do not
// hold. One short message of each cause, with figures, as long as the cause lasts.
#include "InputTesting.h"

#include "vtkDataSetAttributes.h"
#include "vtkScatteredIsosurfaceFilter.h"

#include <limits>
#include <random>
#include <string>
#include <vector>

using namespace inputtesting;

namespace
{

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

/// Keeps all warnings.
class WarningWatcher : public vtkCommand
{
public:
  static WarningWatcher* New() { return new WarningWatcher; }

  void Execute(vtkObject*, unsigned long, void* message) override
  {
    this->All.emplace_back(static_cast<const char*>(message));
  }

  std::vector<std::string> All;
};

std::vector<std::string> messagesOf(vtkScatteredContourFilter* filter, unsigned long kind)
{
  const auto watcher = vtkSmartPointer<WarningWatcher>::Take(WarningWatcher::New());
  const unsigned long tag = filter->AddObserver(kind, watcher);
  filter->Modified();
  filter->Update();
  filter->RemoveObserver(tag);
  return watcher->All;
}

std::vector<std::string> warningsOf(vtkScatteredContourFilter* filter)
{
  return messagesOf(filter, vtkCommand::WarningEvent);
}

std::vector<std::string> notesOf(vtkScatteredContourFilter* filter)
{
  return messagesOf(filter, vtkCommand::MessageEvent);
}

void expectOne(const std::vector<std::string>& messages, const std::vector<std::string>& parts)
{
  ASSERT_EQ(messages.size(), 1u);
  for (const std::string& part : parts)
  {
    EXPECT_NE(messages.front().find(part), std::string::npos) << messages.front();
  }
}

void expectWarning(vtkScatteredContourFilter* filter, const std::vector<std::string>& parts)
{
  expectOne(warningsOf(filter), parts);
  EXPECT_TRUE(warningsOf(filter).empty()) << "the same again";
}

void expectNote(vtkScatteredContourFilter* filter, const std::vector<std::string>& parts)
{
  expectOne(notesOf(filter), parts);
}

template <class TFilter = vtkScatteredIsopointFilter>
vtkSmartPointer<TFilter> newFilterOf(vtkDataObject* input)
{
  auto filter = vtkSmartPointer<TFilter>::New();
  filter->SetInputData(input);
  filter->SetValue(0, 0.7);
  return filter;
}

} // namespace

TEST(Warnings, AnIsovalueOutsideTheRangeIsNamedWithTheRange)
{
  const auto cloud = newCloud(500);
  auto* const values = vtkDoubleArray::SafeDownCast(cloud->GetPointData()->GetScalars());
  values->SetValue(0, 0.0625);
  values->SetValue(1, 7.5);
  const auto filter = newFilterOf(cloud);
  EXPECT_TRUE(warningsOf(filter).empty());
  const auto surface = newFilterOf<vtkScatteredIsosurfaceFilter>(cloud);
  for (vtkScatteredContourFilter* const any :
    std::initializer_list<vtkScatteredContourFilter*>{ filter, surface })
  {
    any->SetNumberOfContours(1);
    any->SetValue(0, 8.25);
    expectWarning(any, { "No isosurface at 8.25: \"distance\" is from 0.0625 to 7.5." });
    any->SetValue(1, 0.5);
    any->SetValue(2, -1.0);
    expectWarning(any, { "No isosurface at -1, 8.25: ", "from 0.0625 to 7.5" });
    EXPECT_GT(any->GetOutput()->GetNumberOfPoints(), 0);
  }
}

TEST(Warnings, FiguresThatDifferLookDifferent)
{
  const auto cloud = newCloud(500);
  auto* const values = vtkDoubleArray::SafeDownCast(cloud->GetPointData()->GetScalars());
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    values->SetValue(i, 300.0 + 1e-5 * static_cast<double>(i % 5));
  }
  const auto filter = newFilterOf(cloud);
  filter->SetValue(0, 300.0001);
  expectWarning(filter, { "at 300.0001: ", "from 300 to 300.00004" });
  filter->SetValue(0, 300.0); // no sample is below
  expectWarning(filter, { "greater than 300, up to 300.00004" });
}

TEST(Warnings, AVoidThatIsLeftWithoutPointsIsExplained)
{
  const auto cloud = newCloud(2000);
  auto* const values = vtkDoubleArray::SafeDownCast(cloud->GetPointData()->GetScalars());
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); i += 2)
  {
    double position[3];
    cloud->GetPoint(i, position);
    cloud->GetPoints()->SetPoint(i, position[0] + 50.0, position[1], position[2]);
    values->SetValue(i, values->GetValue(i) + 100.0);
  }
  const auto filter = newFilterOf(cloud);
  filter->SetValue(0, 50.0);
  filter->DropGapsOn();
  expectWarning(filter, { "at 50: all of it is in gaps", "DropGaps" });
}

TEST(Warnings, APlaneWithoutTrianglesIsExplained)
{
  const auto cloud = newCloud(500);
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    double position[3];
    cloud->GetPoint(i, position);
    cloud->GetPoints()->SetPoint(i, position[0], position[1], 0.0);
  }
  // No filter recommends the other.
  expectWarning(newFilterOf<vtkScatteredIsosurfaceFilter>(cloud),
    { "in one plane", "apply Delaunay 2D and Contour instead." });
  expectWarning(newFilterOf(cloud), { "such as a plane or a shell, set Projection to None" });
}

TEST(Warnings, SamplesThatTakeNoPartDoNotWidenTheRange)
{
  const auto cloud = newCloud(500);
  auto* const values = vtkDoubleArray::SafeDownCast(cloud->GetPointData()->GetScalars());
  const auto ghosts = newArray<vtkUnsignedCharArray>(vtkDataSetAttributes::GhostArrayName(), 500);
  ghosts->FillValue(0);
  ghosts->SetValue(3, vtkDataSetAttributes::DUPLICATEPOINT);
  cloud->GetPointData()->AddArray(ghosts);
  values->SetValue(3, 9.0);
  values->SetValue(4, 7.5);
  const auto filter = newFilterOf(cloud);
  filter->SetValue(0, 8.0);
  expectWarning(filter, { "at 8: ", " to 7.5" });
}

TEST(Warnings, AConstantArrayHasNoIsosurface)
{
  const auto cloud = newCloud(500);
  vtkDoubleArray::SafeDownCast(cloud->GetPointData()->GetScalars())->FillValue(0.7);
  expectWarning(newFilterOf(cloud), { "all values of \"distance\" are 0.7" });
}

TEST(Warnings, SkippedSamplesAreCountedByTheirReason)
{
  const auto cloud = newCloud(500);
  auto* const values = vtkDoubleArray::SafeDownCast(cloud->GetPointData()->GetScalars());
  values->SetValue(5, notANumber);
  cloud->GetPoints()->SetPoint(6, std::numeric_limits<double>::infinity(), 0.0, 0.0);
  const auto filter = newFilterOf(cloud);
  EXPECT_TRUE(warningsOf(newFilterOf(cloud)).empty()) << "what is left out is no problem";
  expectNote(filter, { "Skipped 2 of 500 samples: not finite." });
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(), 2);
  EXPECT_EQ(filter->GetNumberOfSamples(), 500);

  const auto other = newCloud(30);
  other->GetPointData()->Initialize();
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, cloud);
  blocks->SetBlock(1, other);
  blocks->SetBlock(2, newCloud(400));
  for (const int byBlock : { 0, 1 })
  {
    const auto filterOfBlocks = newFilterOf(blocks.Get());
    filterOfBlocks->SetContourBlocks(byBlock);
    expectNote(filterOfBlocks,
      { "Skipped 32 of 930 samples: 2 not finite, 30 in blocks without \"distance\"." });
  }
}

TEST(Warnings, GhostsAloneAreMeantToBeLeftOut)
{
  const auto cloud = newCloud(500);
  const auto ghosts = newArray<vtkUnsignedCharArray>(vtkDataSetAttributes::GhostArrayName(), 500);
  ghosts->FillValue(0);
  ghosts->SetValue(3, vtkDataSetAttributes::DUPLICATEPOINT);
  cloud->GetPointData()->AddArray(ghosts);
  const auto filter = newFilterOf(cloud);
  EXPECT_TRUE(warningsOf(filter).empty());
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(), 1);
  auto* const values = vtkDoubleArray::SafeDownCast(cloud->GetPointData()->GetScalars());
  values->SetValue(5, notANumber);
  values->Modified();
  expectNote(filter, { "2 of 500", "1 not finite", "1 ghost or hidden" });
}

TEST(Warnings, PointsThatNoFitMovesAreCountedWhereTheyAreMost)
{
  const auto cloud = newCloud(4000);
  const auto filter = newFilterOf(cloud);
  EXPECT_TRUE(warningsOf(filter).empty());
  std::mt19937 random(2);
  auto* const values = vtkDoubleArray::SafeDownCast(cloud->GetPointData()->GetScalars());
  for (vtkIdType i = 0; i < values->GetNumberOfValues(); ++i)
  {
    values->SetValue(i, random() * 0x1p-32);
  }
  cloud->Modified();
  values->Modified();
  const std::vector<std::string> warnings = warningsOf(filter);
  ASSERT_EQ(warnings.size(), 1u);
  const std::string figures = std::to_string(filter->GetNumberOfUnprojectedPoints()) + " of " +
                              std::to_string(filter->GetOutput()->GetNumberOfPoints()) + " points";
  EXPECT_NE(warnings.front().find("No fit holds at " + figures), std::string::npos)
    << warnings.front();
  EXPECT_NE(warnings.front().find("Projection"), std::string::npos) << warnings.front();
  EXPECT_EQ(filter->GetNumberOfExtractedPoints(), filter->GetOutput()->GetNumberOfPoints());
  filter->SetProjection(vtkScatteredIsopointFilter::NO_PROJECTION);
  filter->ComputeSplatsOff();
  EXPECT_TRUE(warningsOf(filter).empty());
}

TEST(Warnings, TrianglesAreNamedWhereSplatsDoNotMeet)
{
  const auto cloud = newCloud(30000);
  const auto filter = newFilterOf(cloud);
  EXPECT_TRUE(warningsOf(filter).empty());
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    std::array<double, 3> p{};
    cloud->GetPoint(i, p.data());
    // Strongly clustered along each axis.
    for (double& coordinate : p)
    {
      coordinate = std::pow(coordinate, 6.0);
    }
    cloud->GetPoints()->SetPoint(i, p.data());
  }
  cloud->GetPoints()->Modified();
  const std::vector<std::string> warnings = warningsOf(filter);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings.front().find("Scattered Isosurface"), std::string::npos) << warnings.front();
  filter->SetComputeSplats(false);
  EXPECT_TRUE(warningsOf(filter).empty());
}

TEST(Warnings, ACauseIsNamedWhenItComesUp)
{
  const auto cloud = newCloud(500);
  const auto filter = newFilterOf(cloud);
  filter->SetValue(0, 9.0);
  expectWarning(filter, { "at 9: " });
  filter->SetValue(0, 0.7);
  EXPECT_TRUE(warningsOf(filter).empty());
  filter->SetValue(0, 9.0);
  expectWarning(filter, { "at 9: " });
  filter->SetValue(0, 8.0);
  expectWarning(filter, { "at 8: " });
  filter->SetInputData(newCloud(400));
  expectWarning(filter, { "at 8: " });
}

TEST(Warnings, AnotherArrayIsAnotherCause)
{
  const auto cloud = newCloud(500);
  for (const char* const name : { "one", "two" })
  {
    const auto constant = newArray<vtkDoubleArray>(name, 500);
    constant->FillValue(2.0);
    cloud->GetPointData()->AddArray(constant);
  }
  const auto filter = newFilterOf(cloud);
  for (const char* const name : { "one", "two" })
  {
    filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name);
    expectWarning(filter, { std::string("\"") + name + "\" are 2" });
  }
}

TEST(Warnings, ThatNothingIsLeftIsAProblem)
{
  const auto cloud = newCloud(500);
  vtkDoubleArray::SafeDownCast(cloud->GetPointData()->GetScalars())->FillValue(notANumber);
  expectWarning(
    newFilterOf(cloud), { "Skipped 500 of 500 samples: not finite. There is no isosurface." });
}

TEST(Warnings, IsovaluesBetweenBlocksAreNotInGaps)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (const unsigned int block : { 0u, 1u })
  {
    const auto cloud = newCloud(400);
    auto* const values = vtkDoubleArray::SafeDownCast(cloud->GetPointData()->GetScalars());
    for (vtkIdType i = 0; i < 400; ++i)
    {
      values->SetValue(i, values->GetValue(i) + 100.0 * block);
    }
    blocks->SetBlock(block, cloud);
  }
  const auto filter = newFilterOf(blocks.Get());
  filter->SetValue(0, 50.0);
  filter->ContourBlocksOn();
  filter->DropGapsOff();
  expectWarning(filter, { "at 50: no block has samples on both sides", "ContourBlocks" });
}

TEST(Warnings, NothingIsCountedAfterAnError)
{
  const auto cloud = newCloud(500);
  vtkDoubleArray::SafeDownCast(cloud->GetPointData()->GetScalars())->SetValue(0, notANumber);
  const auto filter = newFilterOf(cloud);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(), 1);
  filter->SetAngle(-1.0);
  const auto errors = watchErrors(filter);
  filter->Update();
  EXPECT_EQ(errors->Count, 1);
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(), 0);
  EXPECT_EQ(filter->GetNumberOfSamples(), 0);
  EXPECT_EQ(filter->GetNumberOfExtractedPoints(), 0);
}

TEST(Warnings, WhatCountsComesFirst)
{
  // ParaView's list of messages shows about this many characters.
  constexpr std::size_t shown = 70;
  const auto cloud = newCloud(500);
  const auto filter = newFilterOf(cloud);
  filter->SetValue(0, 9.0);
  const std::vector<std::string> warnings = warningsOf(filter);
  ASSERT_EQ(warnings.size(), 1u);
  const std::size_t begin = warnings.front().find("No isosurface at 9: \"distance\" is from ");
  ASSERT_NE(begin, std::string::npos);
  EXPECT_LE(warnings.front().find(". Choose") - begin, shown);
}
