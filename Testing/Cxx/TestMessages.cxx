// SPDX-License-Identifier: GPL-3.0-or-later
// Errors, warnings and notes: one short message of each cause, with figures and a remedy.
#include "InputTesting.h"

#include "vtkCellType.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cerrno>
#include <tuple>

using namespace inputtesting;

namespace
{

using Words = std::vector<std::string>;

/// The messages of an update.
Words messagesOf(vtkScatteredContourFilter* filter, unsigned long event = vtkCommand::WarningEvent)
{
  const auto watcher = watchMessages(filter, event);
  filter->Modified();
  filter->Update();
  filter->RemoveObserver(watcher);
  return watcher->All;
}

/// Expects one message with these words, which name the cause and the remedy.
void expectOne(const Words& messages, const Words& words)
{
  ASSERT_EQ(messages.size(), 1u) << testing::PrintToString(messages);
  for (const std::string& word : words)
  {
    expectContains(messages.front(), word);
  }
}

void expectOneWarning(vtkScatteredContourFilter* filter, const Words& words)
{
  expectOne(messagesOf(filter), words);
  EXPECT_TRUE(messagesOf(filter).empty()) << "the same again";
}

struct Subject
{
  void setValues(const std::function<double(vtkIdType)>& valueAt) const
  {
    this->cloud->GetPointData()->SetScalars(arrayOf("distance", 2000, valueAt));
  }

  vtkSmartPointer<vtkPolyData> cloud = newCloud(2000);
  vtkDoubleArray* values = distancesOf(this->cloud);
  vtkSmartPointer<vtkScatteredContourFilter> filter;
};

/// A change of the subject, after which there is one warning.
struct Case
{
  const char* name;
  std::function<void(Subject&)> change;
  Words words;
};

vtkSmartPointer<vtkMultiBlockDataSet> newDistantBlocks()
{
  const auto second = newCloud(400);
  setScalars(
    second, [](const Vector& p) { return length(p) + 100.0; }, "distance");
  return blocksOf({ newCloud(400), second });
}

const std::vector<Case> cases{
  { "isovalues outside of the range",
    [](Subject& s)
    {
      s.values->SetValue(0, 0.03125);
      s.values->SetValue(1, 7.5);
      s.filter->SetValue(0, 8.25);
      s.filter->SetValue(1, 0.5);
      s.filter->SetValue(2, -1.0);
    },
    { "-1, 8.25", "\"distance\"", "0.03125", "7.5", "Choose" } },
  { "figures that differ in the eighth digit",
    [](Subject& s)
    {
      s.setValues([](vtkIdType i) { return 300.0 + 1e-5 * static_cast<double>(i % 5); });
      s.filter->SetValue(0, 300.0001);
    },
    { "300.0001", "300.00004" } },
  { "all in gaps",
    [](Subject& s)
    {
      move(s.cloud->GetPoints(),
        [](const Vector& p) {
          return Vector{ p[0] + (p[0] < 0.0 ? 0.0 : 50.0), p[1], p[2] };
        });
      setScalars(
        s.cloud, [](const Vector& p) { return p[0]; }, "distance");
      s.filter->SetValue(0, 25.0);
      s.filter->DropGapsOn();
    },
    { "25", "gaps", "DropGaps" } },
  { "a ghost does not widen the range",
    [](Subject& s)
    {
      s.cloud->GetPointData()->AddArray(
        ghostsOf(2000, [](vtkIdType i) { return i == 3 ? duplicatePoint : 0; }));
      s.values->SetValue(3, 9.0);
      s.values->SetValue(4, 7.5);
      s.filter->SetValue(0, 8.125);
    },
    { "8.125", " 7.5" } },
  { "a constant array", [](Subject& s) { s.values->Fill(0.7); },
    { "\"distance\"", "0.7", "Choose another array" } },
  { "no finite value", [](Subject& s) { s.values->Fill(notANumber); },
    { "2000 of 2000", "not finite", "Choose another array" } },
};

} // namespace

TEST(Messages, EachCauseIsOneWarning)
{
  for (const std::size_t kind : { 0, 1 })
  {
    for (const Case& warned : cases)
    {
      Subject subject;
      subject.filter = bothFilters(subject.cloud)[kind];
      SCOPED_TRACE(warned.name + std::string(subject.filter->GetClassName()));
      EXPECT_TRUE(messagesOf(subject.filter).empty());
      warned.change(subject);
      subject.cloud->Modified();
      expectOneWarning(subject.filter, warned.words);
      const bool hasSurface = &warned == &cases.front(); // at one of its isovalues
      EXPECT_EQ(subject.filter->GetOutput()->GetNumberOfPoints() > 0, hasSurface);
    }
  }
}

/// Ranges of isovalues, and animations, begin and end at the ends of the values.
TEST(Messages, EndsOfTheRangeAreNotesBesideASurface)
{
  const auto cloud = newCloud(1000);
  const auto ends = distancesOf(cloud)->GetRange();
  for (const std::size_t kind : { 0, 1 })
  {
    const auto least = bothFilters(cloud)[kind];
    SCOPED_TRACE(least->GetClassName());
    least->SetValue(0, ends[0]);
    const auto warnings = watchMessages(least, vtkCommand::WarningEvent);
    const auto notes = watchMessages(least, vtkCommand::MessageEvent);
    least->Update();
    ASSERT_EQ(warnings->count(), 1u);
    expectContains(warnings->last(), ": no isosurface at ");
    expectContains(warnings->last(), "Choose isovalues between ");
    least->SetValue(0, 0.5);
    least->Update();
    EXPECT_EQ(notes->count(), 0u);
    for (const double level : { ends[0], std::nextafter(ends[1], 9.0) })
    {
      least->SetValue(0, level); // of the frame after one with a surface
      least->Update();
    }
    EXPECT_EQ(notes->count(), 1u);
    EXPECT_EQ(warnings->count(), 2u) << "beyond the end";

    const auto other = newCloud(500);
    least->SetValue(0, distancesOf(other)->GetRange()[0]);
    least->SetInputData(other);
    least->Update();
    EXPECT_EQ(notes->count(), 1u);
    EXPECT_EQ(warnings->count(), 3u) << "an input that had no surface";
    least->SetValue(0, 0.5);
    least->Update();
    least->SetValue(0, distancesOf(other)->GetRange()[0]);
    least->Update();
    EXPECT_EQ(notes->count(), 2u);
    distancesOf(other)->SetValue(3, 0.0);
    distancesOf(other)->Modified();
    least->SetValue(0, 0.0);
    least->Update();
    EXPECT_EQ(notes->count(), 2u);
    EXPECT_EQ(warnings->count(), 4u) << "other values had a surface";

    const auto several = bothFilters(cloud)[kind];
    const auto warningsOfSeveral = watchMessages(several, vtkCommand::WarningEvent);
    const auto notesOfSeveral = watchMessages(several, vtkCommand::MessageEvent);
    several->GenerateValues(11, ends[0], ends[1]);
    several->Update();
    EXPECT_EQ(warningsOfSeveral->count(), 0u);
    ASSERT_EQ(notesOfSeveral->count(), 1u);
    several->GenerateValues(11, 20.0, 30.0);
    several->Update();
    ASSERT_EQ(warningsOfSeveral->count(), 1u);
    expectContains(warningsOfSeveral->last(), "\"distance\" is from ");
    expectContains(warningsOfSeveral->last(), ": no isosurface at 20, 21, 22 and 8 more. Choose");
  }
}

/// Those on vertical and on tilted lines, whose triangles end in gaps everywhere.
TEST(Messages, SamplesOnLinesMakeDebris)
{
  const auto cloud = newCloud(2000);
  move(cloud->GetPoints(),
    [](const Vector& p)
    {
      const double x = std::floor(3.0 * p[0] + 3.0);
      const double y = std::floor(3.0 * p[1] + 3.0);
      const double tilt = 0.1 * std::sin(7.0 * x + 3.0 * y) * p[2];
      return Vector{ x + 0.3 * std::sin(5.0 * x * y) + tilt, y + 0.3 * std::cos(3.0 * x + y),
        p[2] };
    });
  setScalars(
    cloud, [](const Vector& p) { return std::sin(2.0 * p[0]) + p[2]; }, "distance");
  const auto filter = newFilter<Isosurface>(cloud, 0.4);
  expectOneWarning(filter, { "No fit holds at ", "Samples along lines" });
}

TEST(Messages, PositionsThatFloatRoundsAreNamed)
{
  for (const std::size_t kind : { 0, 1 })
  {
    for (const bool isFar : { false, true })
    {
      const auto cloud = newCloud(2000);
      move(cloud->GetPoints(),
        [&](const Vector& p) {
          return isFar ? Vector{ 2.0 * p[0] + 5e6, 2.0 * p[1] + 5e6, 2.0 * p[2] + 5e6 } : p;
        });
      const auto filter = bothFilters(cloud)[kind];
      SCOPED_TRACE(filter->GetClassName());
      if (!isFar)
      {
        EXPECT_TRUE(messagesOf(filter).empty());
        continue;
      }
      expectOneWarning(filter, { "inaccurate: positions so far from the origin", "float32",
                                 "double", "subtract an offset" });
    }
  }
}

/// Floats of northings have steps of half a meter, those of heights tiny ones: samples do not
/// coincide, but have few distinct northings.
TEST(Messages, CoarseStepsOfOneAxisAreNamed)
{
  const std::vector<std::tuple<Vector, double, int>> cubes{
    { { 5e5, 5.4e6, 0.0 }, 1.0, VTK_FLOAT },
    { { 5e5, 5.4e6, 0.0 }, 2.0, VTK_FLOAT },
    { { 5e5, 5.4e6, 0.0 }, 0.5, VTK_FLOAT },
    { { 3.3e6, 5.5e6, 100.0 }, 0.5, VTK_FLOAT },
    { { 3.3e6, 5.5e6, 100.0 }, 0.1, VTK_FLOAT }, // in one plane
    { { 5e5, 5.4e6, 0.0 }, 1.0, VTK_DOUBLE },
    { { 5e5, 5.4e6, 0.0 }, 100.0, VTK_FLOAT },
    { { 0.0, 0.0, 0.0 }, 1e-6, VTK_FLOAT },
  };
  for (std::size_t i = 0; i < cubes.size(); ++i)
  {
    const auto& [origin, size, type] = cubes[i];
    const auto cloud = newCloud(2000, type);
    const Vector& offset = origin;
    const double half = 0.5 * size;
    move(cloud->GetPoints(),
      [&](const Vector& p) {
        return Vector{ offset[0] + half * p[0], offset[1] + half * p[1], offset[2] + half * p[2] };
      });
    for (const auto& filter : bothFilters(cloud))
    {
      SCOPED_TRACE(filter->GetClassName() + std::to_string(i));
      if (i > 4)
      {
        EXPECT_TRUE(messagesOf(filter).empty());
        continue;
      }
      expectOneWarning(filter,
        { "positions so far from the origin are rounded to float32. Give positions as double" });
    }
  }
}

/// A plane, a line and one position have no spacing along some axes.
TEST(Messages, FlatCloudsNearTheOriginAreNotRounded)
{
  for (const Vector& scale : { Vector{ 1.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 }, { 0.0, 0.0, 0.0 } })
  {
    const auto cloud = newCloud(2000);
    move(cloud->GetPoints(),
      [&](const Vector& p) {
        return Vector{ scale[0] * p[0] + 1.0, scale[1] * p[1] + 1.0, scale[2] * p[2] + 1.0 };
      });
    for (const auto& filter : bothFilters(cloud))
    {
      for (const std::string& message : messagesOf(filter))
      {
        EXPECT_EQ(message.find("float32"), std::string::npos) << message;
      }
    }
  }
}

TEST(Messages, SamplesAtOnePositionWithDifferentValuesAreCounted)
{
  for (const double difference : { 0.0, 0.1 })
  {
    const auto once = newCloud(1000);
    const auto cloud = newCloud(2000);
    for (vtkIdType i = 0; i < 2000; ++i)
    {
      cloud->GetPoints()->SetPoint(i, once->GetPoint(i % 1000));
      distancesOf(cloud)->SetComponent(
        i, 0, distancesOf(once)->GetComponent(i % 1000, 0) + (i < 1000 ? 0.0 : difference));
    }
    for (const auto& filter : bothFilters(cloud))
    {
      SCOPED_TRACE(filter->GetClassName());
      const auto warnings = watchMessages(filter, vtkCommand::WarningEvent);
      const auto notes = watchMessages(filter, vtkCommand::MessageEvent);
      filter->Update();
      EXPECT_EQ(warnings->count(), 0u);
      ASSERT_EQ(notes->count(), difference > 0.0 ? 1u : 0u);
      if (difference > 0.0)
      {
        const std::string points = std::to_string(filter->GetOutput()->GetNumberOfPoints());
        expectContains(notes->last(), "next to " + points + " of " + points + " points");
      }
    }
  }
}

TEST(Messages, APlaneIsExplained)
{
  const auto cloud = newCloud(500);
  move(cloud->GetPoints(), [](const Vector& p) { return Vector{ p[0], p[1], 0.0 }; });
  expectOneWarning(newFilter(cloud), { "No fit", "plane", "Projection" });
  const auto triangles = newFilter<Isosurface>(cloud);
  const auto warnings = watchMessages(triangles, vtkCommand::WarningEvent);
  expectOneWarning(triangles, { "plane", "Delaunay 2D" });
  for (const char* const noRemedy : { "Scattered Isopoints", "DropGaps" })
  {
    EXPECT_EQ(warnings->last().find(noRemedy), std::string::npos) << noRemedy;
  }
}

TEST(Messages, TooFewSamplesAreCounted)
{
  const auto cloud = newCloud(3);
  setScalars(
    cloud, [](const Vector& p) { return p[0]; }, "distance");
  const auto limits = distancesOf(cloud)->GetRange();
  const Words messages = messagesOf(newFilter<Isosurface>(cloud, 0.5 * (limits[0] + limits[1])));
  expectOne(messages, { "only 3 samples", "Add samples" });
  EXPECT_EQ(messages.front().find("DropGaps"), std::string::npos);
  expectOne(messagesOf(newFilter<Isosurface>(newCloud(1))), { "only 1 sample." });
}

TEST(Messages, OneBlockHasTheMessageOfItsCloud)
{
  const auto cloud = newCloud(500);
  move(cloud->GetPoints(), [](const Vector& p) { return Vector{ p[0], p[1], 0.0 }; });
  const auto filter = newFilter<Isosurface>(blocksOf({ cloud }));
  filter->ContourBlocksOn();
  expectOneWarning(filter, { "plane", "Delaunay 2D" });
}

TEST(Messages, NamesOfPropertiesCanBeThoseOfParaViewsPanel)
{
  const auto allInGaps = std::find_if(cases.begin(), cases.end(),
    [](const Case& each) { return each.name == std::string("all in gaps"); });
  Subject subject;
  subject.filter = newFilter(subject.cloud);
  allInGaps->change(subject);
  subject.filter->UsePanelNamesOn();
  expectOneWarning(subject.filter, { "25", "Turn Drop Gaps off" });

  const auto capped = vtkSmartPointer<vtkScatteredIsosurfaceFilter>::New();
  capped->SetInputData(newCloud(500));
  capped->CappingOn();
  capped->SetNormalMethod(0);
  capped->UsePanelNamesOn();
  expectOne(messagesOf(capped, vtkCommand::ErrorEvent), { "Set Normal Method to planes" });
}

TEST(Messages, IsovaluesBetweenBlocksAreNotInGaps)
{
  const auto filter = newFilter(newDistantBlocks(), 50.0);
  filter->ContourBlocksOn();
  filter->DropGapsOff();
  expectOneWarning(filter, { "50", "ContourBlocks" });
}

TEST(Messages, SkippedSamplesAreNotedByTheirReason)
{
  const auto cloud = newCloud(500);
  distancesOf(cloud)->SetValue(5, notANumber);
  cloud->GetPoints()->SetPoint(6, infinity, 0.0, 0.0);
  const auto filter = newFilter(cloud);
  EXPECT_TRUE(messagesOf(filter).empty()) << "a note is no warning";
  expectOne(messagesOf(newFilter(cloud), vtkCommand::MessageEvent), { "2 of 500", "not finite" });
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(), 2);
  EXPECT_EQ(filter->GetNumberOfSamples(), 500);

  const auto other = newCloud(30);
  other->GetPointData()->Initialize();
  for (const int byBlock : { 0, 1 })
  {
    const auto ofBlocks = newFilter(blocksOf({ cloud, other, newCloud(400) }));
    ofBlocks->SetContourBlocks(byBlock);
    expectOne(messagesOf(ofBlocks, vtkCommand::MessageEvent),
      { "32 of 930", "2 not finite", "30 in blocks", "\"distance\"" });
  }
}

TEST(Messages, GhostsAreNotedBesideOtherReasonsAlone)
{
  const auto cloud = newCloud(500);
  cloud->GetPointData()->AddArray(
    ghostsOf(500, [](vtkIdType i) { return i == 3 ? duplicatePoint : 0; }));
  const auto filter = newFilter(cloud);
  EXPECT_TRUE(messagesOf(filter, vtkCommand::MessageEvent).empty());
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(), 1);
  distancesOf(cloud)->SetValue(5, notANumber);
  distancesOf(cloud)->Modified();
  expectOne(
    messagesOf(filter, vtkCommand::MessageEvent), { "2 of 500", "1 not finite", "1 excluded" });
}

TEST(Messages, PointsThatNoFitMovesAreCountedWhereTheyAreMost)
{
  const auto cloud = newCloud(4000);
  const auto filter = newFilter(cloud);
  EXPECT_TRUE(messagesOf(filter).empty());
  std::mt19937 random(2);
  setScalars(
    cloud, [&](const Vector&) { return static_cast<double>(random()) * 0x1p-32; }, "distance");
  const Words warnings = messagesOf(filter);
  const std::string points = std::to_string(filter->GetOutput()->GetNumberOfPoints());
  expectOne(
    warnings, { "No fit", std::to_string(filter->GetNumberOfUnprojectedPoints()) + " of " + points,
                "set Projection to none" });
  EXPECT_EQ(filter->GetNumberOfExtractedPoints(), filter->GetOutput()->GetNumberOfPoints());
  filter->SetProjection(Isopoints::NO_PROJECTION);
  filter->ComputeSplatsOff();
  EXPECT_TRUE(messagesOf(filter).empty());
}

TEST(Messages, TrianglesAreTheRemedyWhereSplatsDoNotMeet)
{
  const auto cloud = newCloud(30000);
  const auto filter = newFilter(cloud);
  EXPECT_TRUE(messagesOf(filter).empty());
  move(cloud->GetPoints(), // strongly clustered along each axis
    [](const Vector& p) {
      return Vector{ std::pow(p[0], 6), std::pow(p[1], 6), std::pow(p[2], 6) };
    });
  cloud->GetPoints()->Modified();
  expectOne(
    messagesOf(filter), { "Splats", "Extract triangles instead, as Scattered Isosurface does." });
  filter->SetComputeSplats(false);
  EXPECT_TRUE(messagesOf(filter).empty());
}

TEST(Messages, AWarningIsRepeatedWhenItsCauseChanges)
{
  const auto cloud = newCloud(500);
  for (const char* const name : { "one", "two" })
  {
    cloud->GetPointData()->AddArray(arrayOf(name, 500, [](vtkIdType) { return 2.0; }));
  }
  const auto filter = newFilter(cloud);
  for (const double isovalue : { 9.125, 0.7, 9.125, 8.125 })
  {
    filter->SetValue(0, isovalue);
    if (isovalue > 1.0)
    {
      expectOneWarning(filter, { isovalue > 8.5 ? "9.125" : "8.125" });
    }
    EXPECT_TRUE(messagesOf(filter).empty());
  }
  filter->SetInputData(newCloud(400));
  expectOneWarning(filter, { "8.125" });
  filter->SetInputData(cloud);
  for (const char* const name : { "one", "two" })
  {
    filter->SetInputArrayToProcess(0, 0, 0, ofPoints, name);
    expectOneWarning(filter, { "\"" + std::string(name) + "\"", "2" });
  }
}

// ParaView's list of messages shows about 70 characters.
TEST(Messages, CauseAndFiguresComeFirst)
{
  const Words warnings = messagesOf(newFilter(newCloud(500), 9.0));
  ASSERT_EQ(warnings.size(), 1u);
  const std::size_t begin = warnings.front().find("\"distance\" is from");
  ASSERT_NE(begin, std::string::npos);
  EXPECT_LE(warnings.front().find("Choose") - begin, 72u);
}

TEST(Messages, EachInvalidUseIsOneError)
{
  const auto cloud = newCloud(500);
  cloud->GetPointData()->AddArray(textsOf("names", 500, [](vtkIdType) { return ""; }));
  cloud->GetPointData()->AddArray(newArray("short", 7));
  const auto choose = [](const char* name, int association = ofPoints) {
    return [=](Isopoints* filter) { filter->SetInputArrayToProcess(0, 0, 0, association, name); };
  };
  const auto input = [](vtkDataObject* data)
  { return [=](Isopoints* filter) { filter->SetInputDataObject(data); }; };
  const auto angle = [](double value)
  { return [=](Isopoints* filter) { filter->SetAngle(value); }; };
  const auto unloaded = newImage({ 4, 4, 4 }, 0.25);
  unloaded->GetPointData()->AddArray(ghostsOf(125, [](vtkIdType) { return 0; }));
  vtkNew<vtkPolyData> nothing;
  const auto emptyBlocks = blocksOf({ nothing.Get(), vtkSmartPointer<vtkTable>::New() });
  vtkNew<vtkUnstructuredGrid> withoutPoints;
  withoutPoints->InsertNextCell(VTK_EMPTY_CELL, 0, static_cast<const vtkIdType*>(nullptr));
  withoutPoints->GetCellData()->AddArray(newArray("x", 1));
  constexpr int ofAny = vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS;
  const std::string remedy = "SetInputArrayToProcess()";
  const std::string offer = "distance, x, position, names, short";
  const std::vector<std::pair<std::function<void(Isopoints*)>, Words>> uses{
    { choose("g"), { "point array", "\"g\"", remedy, offer } },
    { choose("g", ofCells), { "cell array", "\"g\"", remedy, offer } },
    { choose("g", ofAny), { "point or cell array", "\"g\"", remedy, offer } },
    { choose("", ofCells), { "active cell scalars", remedy, offer } },
    { choose("short"), { "\"short\"", "7 values for 500 points", remedy } },
    { choose("position"), { "\"position\"", "3 components", "Calculator" } },
    { choose("names"), { "\"names\"", "no numbers", remedy } },
    { angle(-1.0), { "Angle", "-1", "0 to 180" } },
    { angle(180.5), { "Angle", "180.5", "0 to 180" } },
    { angle(notANumber), { "Angle", "nan", "0 to 180" } },
    { [](Isopoints* filter) { filter->SetValue(1, notANumber); }, { "not a number", "Choose" } },
    { input(unloaded), { "load", "reader" } },
    { input(nothing), { "no points", "Connect" } },
    { input(emptyBlocks), { "no points", "Connect" } },
    { [&](Isopoints* filter)
      {
        input(withoutPoints)(filter);
        choose("x", ofCells)(filter);
      },
      { "cells, but no points", "Connect" } },
    { [&](Isopoints* filter)
      {
        cloud->GetPointData()->SetActiveScalars(nullptr);
        choose("", ofAny)(filter);
      },
      { "active point or cell scalars", remedy, offer } },
  };
  for (const auto& [use, words] : uses)
  {
    SCOPED_TRACE(testing::PrintToString(words));
    const auto filter = newFilter(cloud);
    const auto errors = watchErrors(filter);
    distancesOf(cloud)->SetValue(0, notANumber);
    filter->Update();
    EXPECT_EQ(filter->GetNumberOfSkippedSamples(), 1);
    use(filter);
    filter->Update();
    expectOne(errors->All, words);
    EXPECT_EQ(filter->GetErrorCode(), EINVAL);
    expectEmpty(filter->GetOutput());
    EXPECT_EQ(filter->GetNumberOfSkippedSamples(), 0);
    EXPECT_EQ(filter->GetNumberOfSamples(), 0);
    EXPECT_EQ(filter->GetNumberOfExtractedPoints(), 0);
  }
}

TEST(Messages, AFailedUpdateIsTriedAgainAfterModified)
{
  const auto cloud = newCloud(500);
  const auto filter = newFilter<Isosurface>(cloud);
  filter->SetInputArrayToProcess(0, 0, 0, ofPoints, "later");
  const auto errors = watchErrors(filter);
  filter->Update();
  filter->Update();
  EXPECT_EQ(errors->count(), 1u);
  filter->Modified();
  filter->Update();
  EXPECT_EQ(errors->count(), 2u);
  EXPECT_EQ(filter->GetErrorCode(), EINVAL);
  setScalars(
    cloud, [](const Vector& p) { return length(p); }, "later");
  cloud->Modified();
  EXPECT_GT(outputOf(filter)->GetNumberOfPoints(), 0);
  EXPECT_EQ(errors->count(), 2u);
  EXPECT_EQ(filter->GetErrorCode(), 0u);
}
