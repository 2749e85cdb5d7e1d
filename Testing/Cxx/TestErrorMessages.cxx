// SPDX-License-Identifier: GPL-3.0-or-later
// Errors about the input name the cause, and what to do.
#include "InputTesting.h"

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
  for (const std::string& part : parts)
  {
    EXPECT_NE(errors->Last.find(part), std::string::npos) << errors->Last;
  }
  expectEmpty(filter->GetOutput());
}

} // namespace

TEST(ErrorMessages, AMissingArrayIsNamedWithWhereItWasSoughtAndWhatThereIs)
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

TEST(ErrorMessages, AnArrayOfAnotherLengthIsNamedWithBothLengths)
{
  const auto image = newImage(4, 0.25, -1.0, -1.0, -1.0);
  image->GetPointData()->AddArray(newArray<vtkDoubleArray>("f", 7));
  expectError(image, vtkDataObject::FIELD_ASSOCIATION_POINTS, "f",
    { "\"f\" has 7 values for 125 points", "SetInputArrayToProcess()" });
}
