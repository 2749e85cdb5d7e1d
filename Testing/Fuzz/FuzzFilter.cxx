// SPDX-License-Identifier: GPL-3.0-or-later
// Data objects made of a fuzzer's bytes: the filter must yield the isopoints that brute force finds
// among the samples that they represent, or one error and an empty output.
#include "ByteSource.h"

#include "../Cxx/BruteForce.h"
#include "../Cxx/InputTesting.h"

#include "vtkPartitionedDataSetCollection.h"

using namespace inputtesting;

namespace
{

using clouds::Cloud;

/// A number near the given one that an array of this type represents exactly.
double representable(double number, int type)
{
  if (type == VTK_DOUBLE || type == VTK_FLOAT)
  {
    return type == VTK_DOUBLE ? number : asHeld<float>(number);
  }
  // An integer of any type, signed or not.
  return std::isfinite(number) ? std::fmod(std::floor(std::abs(number)), 120.0) : 7.0;
}

/// An array of one of several types.
vtkSmartPointer<vtkDataArray> newNumbers(ByteSource& bytes, const char* name, vtkIdType tuples)
{
  const int types[8] = { VTK_DOUBLE, VTK_FLOAT, VTK_UNSIGNED_CHAR, VTK_SHORT, VTK_INT,
    VTK_UNSIGNED_INT, VTK_LONG_LONG, VTK_UNSIGNED_LONG_LONG };
  const int type = types[bytes.below(8)];
  const auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  array->SetName(name);
  array->SetNumberOfTuples(tuples);
  const int kind = bytes.below(4);
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    array->SetComponent(i, 0, representable(bytes.number(kind), type));
  }
  return array;
}

void addArrays(ByteSource& bytes, vtkDataSetAttributes* attributes, vtkIdType count)
{
  for (const auto& [name, tuples, isAdded] :
    { std::tuple("f", count, bytes.below(8) != 0), std::tuple("other", count, bytes.below(4) == 0),
      std::tuple("short", count / 2, bytes.below(8) == 0) })
  {
    if (isAdded)
    {
      attributes->AddArray(newNumbers(bytes, name, tuples));
    }
  }
  if (bytes.below(8) == 0)
  {
    attributes->AddArray(textsOf("names", count, [](vtkIdType) { return ""; }));
  }
  if (bytes.below(3) == 0)
  {
    attributes->AddArray(
      ghostsOf(count, [&](vtkIdType) { return bytes.below(3) == 0 ? bytes.byte() : 0; }));
  }
}

vtkSmartPointer<vtkPoints> newPoints(ByteSource& bytes, vtkIdType count)
{
  const int type = bytes.flag() ? VTK_FLOAT : VTK_DOUBLE;
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(type);
  points->SetNumberOfPoints(count);
  const int kind = bytes.below(4);
  for (vtkIdType i = 0; i < count; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      points->GetData()->SetComponent(i, axis, representable(bytes.number(kind), type));
    }
  }
  return points;
}

vtkSmartPointer<vtkDoubleArray> newCoordinates(ByteSource& bytes, int count)
{
  double coordinate = bytes.below(8);
  return arrayOf("", count, [&](vtkIdType) { return coordinate += 0.25 * bytes.below(16); });
}

vtkSmartPointer<vtkDataSet> newDataSet(ByteSource& bytes)
{
  vtkSmartPointer<vtkDataSet> result;
  const int kind = bytes.below(4);
  if (kind == 0)
  {
    vtkNew<vtkPolyData> cloud;
    cloud->SetPoints(newPoints(bytes, bytes.below(40)));
    result = cloud;
  }
  else if (kind == 1)
  {
    vtkNew<vtkImageData> image;
    const int size[3] = { bytes.below(4), bytes.below(4), bytes.below(4) };
    image->SetDimensions(size);
    image->SetOrigin(bytes.below(4), bytes.below(4), bytes.below(4));
    image->SetSpacing(1.0 + bytes.below(2), 1.0, 0.5);
    result = image;
  }
  else if (kind == 2)
  {
    vtkNew<vtkRectilinearGrid> grid;
    const int size[3] = { 1 + bytes.below(4), 1 + bytes.below(4), 1 + bytes.below(4) };
    grid->SetDimensions(size);
    grid->SetXCoordinates(newCoordinates(bytes, size[0]));
    grid->SetYCoordinates(newCoordinates(bytes, size[1]));
    grid->SetZCoordinates(newCoordinates(bytes, size[2]));
    result = grid;
  }
  else
  {
    vtkNew<vtkUnstructuredGrid> grid;
    const int count = 1 + bytes.below(30);
    grid->SetPoints(newPoints(bytes, count));
    // Only vertices: the rounding of other cells' centers is not defined.
    for (int cells = bytes.below(20); cells > 0; --cells)
    {
      const vtkIdType corner = bytes.below(count);
      grid->InsertNextCell(VTK_VERTEX, 1, &corner);
    }
    result = grid;
  }
  addArrays(bytes, result->GetPointData(), result->GetNumberOfPoints());
  addArrays(bytes, result->GetCellData(), result->GetNumberOfCells());
  return result;
}

/// A data set or blocks of them, with arrays that may be named "f", be missing, too short or no
/// numbers, and with ghosts.
/// @param dataSets receives the data sets, in the order of the blocks
vtkSmartPointer<vtkDataObject> newInput(
  ByteSource& bytes, std::vector<vtkSmartPointer<vtkDataSet>>& dataSets)
{
  const int kind = bytes.below(4);
  if (kind <= 1)
  {
    dataSets.push_back(newDataSet(bytes));
    return dataSets.back();
  }
  vtkNew<vtkMultiBlockDataSet> multi;
  vtkNew<vtkPartitionedDataSetCollection> collection;
  const auto blocks = static_cast<unsigned int>(bytes.below(4));
  multi->SetNumberOfBlocks(blocks);
  for (unsigned int block = 0; block < blocks; ++block)
  {
    if (bytes.below(6) != 0)
    {
      dataSets.push_back(newDataSet(bytes));
      multi->SetBlock(block, dataSets.back());
      collection->SetPartition(block, 0, dataSets.back());
    }
  }
  return kind == 2 ? vtkSmartPointer<vtkDataObject>(multi) : collection.Get();
}

int ghostAt(vtkDataSetAttributes* attributes, vtkIdType i)
{
  vtkDataArray* const ghosts = attributes->GetArray(vtkDataSetAttributes::GhostArrayName());
  return ghosts ? static_cast<int>(ghosts->GetComponent(i, 0)) : 0;
}

/// As the filter's documentation defines it, for one point.
bool isPointLeftOut(vtkDataSet* input, vtkIdType point)
{
  if ((ghostAt(input->GetPointData(), point) & (duplicatePoint | hiddenPoint)) != 0)
  {
    return true;
  }
  // A ghost array of the points marks the duplicates among them; without one the cells' does.
  const bool hasGhosts = input->GetPointGhostArray() != nullptr;
  const int excluding = hidden | refined | (hasGhosts ? 0 : duplicate);
  bool isInExcludedCell = false;
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    input->GetCellPoints(cell, corners);
    if (corners->IsId(point) >= 0)
    {
      if ((ghostAt(input->GetCellData(), cell) & excluding) == 0)
      {
        return false;
      }
      isInExcludedCell = true;
    }
  }
  return isInExcludedCell;
}

bool isCellLeftOut(vtkDataSet* input, vtkIdType cell)
{
  vtkNew<vtkIdList> corners;
  input->GetCellPoints(cell, corners);
  return (ghostAt(input->GetCellData(), cell) & (hidden | refined | duplicate)) != 0 ||
         std::any_of(corners->begin(), corners->end(),
           [&](vtkIdType corner)
           { return (ghostAt(input->GetPointData(), corner) & hiddenPoint) != 0; });
}

/// The center of the bounds of a box or a vertex.
Vector centerOf(vtkDataSet* input, vtkIdType cell)
{
  double bounds[6];
  input->GetCellBounds(cell, bounds);
  Vector center;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double least = bounds[2 * axis];
    const double most = bounds[2 * axis + 1];
    center[axis] = least == most ? least : 0.5 * (least + most);
  }
  return center;
}

/// The samples of data sets, and the number of points or cells that are none.
struct Expectation
{
  Cloud samples;
  vtkIdType skipped = 0;
  bool hasArray = false;

  void add(vtkDataSet* input, int association)
  {
    vtkDataArray* const f = input->GetAttributes(association)->GetArray("f");
    if (!f)
    {
      this->skipped += std::max(input->GetNumberOfPoints(), input->GetNumberOfCells());
      return;
    }
    const vtkIdType count = f->GetNumberOfTuples();
    this->hasArray = this->hasArray || count > 0;
    for (vtkIdType i = 0; i < count; ++i)
    {
      Vector p = association == ofPoints ? placeOf(input, i) : centerOf(input, i);
      const double value = f->GetComponent(i, 0);
      if ((association == ofPoints ? isPointLeftOut(input, i) : isCellLeftOut(input, i)) ||
          !std::all_of(p.begin(), p.end(), [](double c) { return std::isfinite(c); }) ||
          !std::isfinite(value))
      {
        ++this->skipped;
        continue;
      }
      this->samples.add(p, value);
    }
  }
};

void checkPoints(
  vtkScatteredIsopointFilter* filter, vtkPolyData* output, const Cloud& samples, double isovalue)
{
  const double angle = filter->GetAngle();
  const bool isProjected = filter->GetProjection() != vtkScatteredIsopointFilter::NO_PROJECTION;
  const std::vector<bruteforce::Isopoint> expected = bruteforce::extract(samples, isovalue, angle);
  require(output->GetNumberOfPoints() == static_cast<vtkIdType>(expected.size()) &&
            output->GetNumberOfCells() == output->GetNumberOfPoints(),
    "the number of isopoints");
  const int exponent = bruteforce::scaleExponentOf(samples);
  const Cloud divided = bruteforce::inScale(samples);
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    double found[3];
    output->GetPoint(static_cast<vtkIdType>(i), found);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double first = divided.positions[3 * expected[i].first + axis];
      const double second = divided.positions[3 * expected[i].second + axis];
      const double t = expected[i].parameter;
      const double wanted = std::isfinite(second - first) ? first + t * (second - first)
                                                          : (1.0 - t) * first + t * second;
      require(
        isProjected ? std::isfinite(found[axis]) : found[axis] == std::ldexp(wanted, exponent),
        "a position");
    }
  }
}

/// Compares the filter's output with the isopoints that brute force finds in the input's data sets.
void check(const std::vector<vtkSmartPointer<vtkDataSet>>& dataSets, vtkDataObject* input,
  int association, std::size_t errorCount, vtkScatteredIsopointFilter* filter)
{
  const double isovalue = filter->GetValue(0);
  Expectation expected;
  for (vtkDataSet* const dataSet : dataSets)
  {
    expected.add(dataSet, association);
  }
  const bool isUsable = expected.hasArray && !std::isnan(isovalue);
  require(errorCount == (isUsable ? 0u : 1u), "the number of errors");
  if (auto* const output = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0)))
  {
    checkPoints(filter, output, isUsable ? expected.samples : Cloud(), isovalue);
    require(!isUsable || filter->GetNumberOfSkippedSamples() == expected.skipped,
      "the number of skipped samples");
    return;
  }
  auto* const blocks = vtkCompositeDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  auto* const composite = vtkCompositeDataSet::SafeDownCast(input);
  require(blocks && composite, "the type of the output");
  if (!isUsable)
  {
    return;
  }
  const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    Expectation alone;
    alone.add(vtkDataSet::SafeDownCast(iterator->GetCurrentDataObject()), association);
    auto* const output = vtkPolyData::SafeDownCast(blocks->GetDataSet(iterator));
    require((output != nullptr) == alone.hasArray, "the structure of the blocks");
    if (output)
    {
      checkPoints(filter, output, alone.samples, isovalue);
    }
  }
}

void update(ByteSource& bytes, vtkScatteredIsopointFilter* filter, MessageWatcher* errors)
{
  std::vector<vtkSmartPointer<vtkDataSet>> dataSets;
  const vtkSmartPointer<vtkDataObject> input = newInput(bytes, dataSets);
  const int association = bytes.flag() ? ofCells : ofPoints;
  const double angle = bytes.flag() ? 54.7 : static_cast<double>(bytes.below(181));
  filter->SetInputData(input);
  filter->SetInputArrayToProcess(0, 0, 0, association, "f");
  filter->SetAngle(angle);
  filter->SetValue(0, bytes.number(bytes.below(4)));
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->SetComputeNormals(bytes.below(4) != 0);
  filter->SetComputeSplats(bytes.below(4) != 0);
  filter->SetComputeScalars(bytes.below(4) != 0);
  filter->SetKeepTree(bytes.below(4) != 0);
  filter->SetUseAllCores(bytes.below(8) == 0);
  filter->SetContourBlocks(bytes.below(4) == 0);
  filter->SetNumberOfNeighbors(3 + bytes.below(20));
  filter->SetProjection(bytes.below(5));
  filter->SetNormalMethod(bytes.below(2));
  filter->SetComputeGradients(bytes.below(2) != 0);
  filter->SetComputeProjectionOrders(bytes.below(2) != 0);
  errors->All.clear();
  filter->Update();
  check(dataSets, input, association, errors->count(), filter);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  ByteSource bytes(data, size);
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->DropGapsOff(); // brute force finds what lies in gaps too
  const auto errors = watchErrors(filter);
  for (int round = 0; round < 3; ++round)
  {
    update(bytes, filter, errors);
  }
  return 0;
}
