// SPDX-License-Identifier: GPL-3.0-or-later
// Errors name the cause and, for arrays, the remedy; there is one for each update, and the output
// is empty.
#include "InputTesting.h"

#include "vtkScatteredIsosurfaceFilter.h"

#include "vtkStringArray.h"

#include <cerrno>
#include <limits>
#include <string>
#include <vector>

using namespace inputtesting;

namespace
{

void expectError(
  vtkDataObject* input, int association, const char* name, const std::vector<std::string>& parts)
{
  SCOPED_TRACE(parts.front());
  const auto filter = newFilter(input, association);
  filter->SetInputArrayToProcess(0, 0, 0, association, name);
  const auto errors = watchErrors(filter);
  filter->Update();
  EXPECT_EQ(errors->Count, 1);
  EXPECT_EQ(filter->GetErrorCode(), EINVAL);
  for (const std::string& part : parts)
  {
    EXPECT_NE(errors->Last.find(part), std::string::npos) << errors->Last;
  }
  expectEmpty(filter->GetOutput());
}

} // namespace

TEST(ErrorMessages, AMissingArrayIsNamedWithItsAssociationAndTheArraysPresent)
{
  const auto image = newImage(4, 0.25, -1.0, -1.0, -1.0);
  addPointField(image);
  const std::string remedy = "SetInputArrayToProcess()";
  const std::string offer = "the point arrays are: f; the cell arrays are: none";
  expectError(image, vtkDataObject::FIELD_ASSOCIATION_POINTS, "g",
    { "no point array named \"g\"", remedy, offer });
  expectError(image, vtkDataObject::FIELD_ASSOCIATION_CELLS, "g",
    { "no cell array named \"g\"", remedy, offer });
  expectError(image, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, "g",
    { "no point or cell array named \"g\"", remedy, offer });
  expectError(image, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, "",
    { "no active point or cell scalars", remedy, offer });
}

TEST(ErrorMessages, WhereAReaderHasLoadedNoArrayItIsSaidToLoadOne)
{
  const auto image = newImage(4, 0.25, -1.0, -1.0, -1.0);
  const auto ghosts = newArray<vtkUnsignedCharArray>(vtkDataSetAttributes::GhostArrayName(), 125);
  ghosts->FillValue(0);
  image->GetPointData()->AddArray(ghosts);
  expectError(image, vtkDataObject::FIELD_ASSOCIATION_POINTS, "f",
    { "no point array named \"f\"", "load point or cell arrays in the reader" });
}

TEST(ErrorMessages, AnArrayOfAnotherLengthIsNamedWithBothLengths)
{
  const auto image = newImage(4, 0.25, -1.0, -1.0, -1.0);
  image->GetPointData()->AddArray(newArray<vtkDoubleArray>("f", 7));
  expectError(image, vtkDataObject::FIELD_ASSOCIATION_POINTS, "f",
    { "\"f\" has 7 values for 125 points", "SetInputArrayToProcess()" });
}

TEST(ErrorMessages, InvalidUseYieldsOneErrorThatNamesTheCauseAndAnEmptyOutput)
{
  const auto cloud = newCloud(500);
  vtkNew<vtkStringArray> names;
  names->SetName("names");
  names->SetNumberOfValues(500);
  cloud->GetPointData()->AddArray(names);
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetValue(0, 0.7);
  const auto errors = watchErrors(filter);
  const auto expectError = [&](const char* words)
  {
    errors->Count = 0;
    filter->Update();
    EXPECT_EQ(errors->Count, 1) << words;
    EXPECT_EQ(filter->GetErrorCode(), EINVAL) << words;
    EXPECT_NE(errors->Last.find(words), std::string::npos) << errors->Last;
    expectEmpty(filter->GetOutput());
  };
  const auto choose = [&](const char* name)
  { filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name); };

  filter->SetInputData(cloud);
  choose("missing");
  expectError("no point array named \"missing\"");
  choose("position");
  expectError("has 3 components");
  choose("names");
  expectError("holds no numbers");
  choose("distance");
  for (const double angle : { -1.0, 180.5, std::numeric_limits<double>::quiet_NaN() })
  {
    filter->SetAngle(angle);
    expectError("out of range. Set it to a value from 0 to 180.");
  }
  filter->SetAngle(54.7);
  filter->SetMinimumSpacing(std::numeric_limits<double>::quiet_NaN());
  expectError("MinimumSpacing is nan, which is out of range. Set it to a value from 0 to 1.");
  filter->SetMinimumSpacing(0.0);
  filter->SetNumberOfContours(2);
  filter->SetValue(0, std::numeric_limits<double>::quiet_NaN());
  filter->SetValue(1, 0.7);
  expectError("not a number");
  filter->SetNumberOfContours(1);
  filter->SetValue(0, 0.7);
  vtkNew<vtkPolyData> nothing;
  filter->SetInputData(nothing);
  expectError("no points");

  filter->SetInputData(cloud);
  filter->Update();
  EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(filter->GetErrorCode(), 0u);
}

TEST(ErrorMessages, AFailedUpdateIsTriedAgainAfterModified)
{
  const auto cloud = newCloud(500);
  vtkNew<vtkScatteredIsosurfaceFilter> filter;
  filter->SetInputData(cloud);
  filter->SetValue(0, 0.7);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "later");
  const auto errors = watchErrors(filter);
  filter->Update();
  filter->Update();
  EXPECT_EQ(errors->Count, 1);
  EXPECT_EQ(filter->GetErrorCode(), EINVAL);
  filter->Modified();
  filter->Update();
  EXPECT_EQ(errors->Count, 2);
  const auto later = newArray<vtkDoubleArray>("later", 500);
  later->DeepCopy(cloud->GetPointData()->GetArray("distance"));
  later->SetName("later");
  cloud->GetPointData()->AddArray(later);
  cloud->Modified();
  filter->Update();
  EXPECT_EQ(errors->Count, 2);
  EXPECT_EQ(filter->GetErrorCode(), 0u);
  EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 0);
}
