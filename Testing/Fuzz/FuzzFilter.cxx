// SPDX-License-Identifier: GPL-3.0-or-later
// Data objects made of a fuzzer's bytes: the filter must yield the isopoints that brute force finds
// among the samples that they represent, or one error and an empty output.
#include "ByteSource.h"

#include "../Cxx/BruteForce.h"
#include "../Cxx/Clouds.h"

#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkCompositeDataIterator.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkScatteredIsopointFilter.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <vector>

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

vtkSmartPointer<vtkDataArray> newArray(
  ByteSource& bytes, const char* name, vtkIdType tuples, int type)
{
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

int scalarType(ByteSource& bytes)
{
  const int types[8] = { VTK_DOUBLE, VTK_FLOAT, VTK_UNSIGNED_CHAR, VTK_SHORT, VTK_INT,
    VTK_UNSIGNED_INT, VTK_LONG_LONG, VTK_UNSIGNED_LONG_LONG };
  return types[bytes.below(8)];
}

void addArrays(ByteSource& bytes, vtkDataSetAttributes* attributes, vtkIdType count)
{
  if (bytes.below(8) != 0)
  {
    attributes->AddArray(newArray(bytes, "f", count, scalarType(bytes)));
  }
  if (bytes.below(4) == 0)
  {
    attributes->AddArray(newArray(bytes, "other", count, scalarType(bytes)));
  }
  if (bytes.below(8) == 0)
  {
    attributes->AddArray(newArray(bytes, "short", count / 2, VTK_DOUBLE));
  }
  if (bytes.below(8) == 0)
  {
    vtkNew<vtkStringArray> names;
    names->SetName("names");
    names->SetNumberOfValues(count);
    attributes->AddArray(names);
  }
  if (bytes.below(3) == 0)
  {
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    ghosts->SetNumberOfValues(count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      ghosts->SetValue(i, bytes.below(3) == 0 ? bytes.byte() : 0);
    }
    attributes->AddArray(ghosts);
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
  auto coordinates = vtkSmartPointer<vtkDoubleArray>::New();
  double coordinate = bytes.below(8);
  for (int i = 0; i < count; ++i)
  {
    coordinates->InsertNextValue(coordinate);
    coordinate += 0.25 * bytes.below(16);
  }
  return coordinates;
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
  const int blocks = bytes.below(4);
  vtkNew<vtkMultiBlockDataSet> multi;
  vtkNew<vtkPartitionedDataSetCollection> collection;
  for (int block = 0; block < blocks; ++block)
  {
    if (bytes.below(6) == 0)
    {
      multi->SetNumberOfBlocks(static_cast<unsigned int>(block) + 1);
      continue;
    }
    dataSets.push_back(newDataSet(bytes));
    multi->SetBlock(static_cast<unsigned int>(block), dataSets.back());
    collection->SetPartition(static_cast<unsigned int>(block), 0, dataSets.back());
  }
  return kind == 2 ? vtkSmartPointer<vtkDataObject>(multi)
                   : vtkSmartPointer<vtkDataObject>(collection);
}

class ErrorCounter : public vtkCommand
{
public:
  static ErrorCounter* New() { return new ErrorCounter; }
  void Execute(vtkObject*, unsigned long, void*) override { ++this->Count; }
  int Count = 0;
};

int ghostAt(vtkDataSetAttributes* attributes, vtkIdType i)
{
  vtkDataArray* const ghosts = attributes->GetArray(vtkDataSetAttributes::GhostArrayName());
  return ghosts ? static_cast<int>(ghosts->GetComponent(i, 0)) : 0;
}

constexpr int invisibleCell = vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL;

/// As the filter's documentation defines it, for one point.
bool isPointLeftOut(vtkDataSet* input, vtkIdType point)
{
  if ((ghostAt(input->GetPointData(), point) &
        (vtkDataSetAttributes::DUPLICATEPOINT | vtkDataSetAttributes::HIDDENPOINT)) != 0)
  {
    return true;
  }
  // A ghost array of the points marks the duplicates among them; without one the cells' does.
  const bool hasGhosts =
    input->GetPointData()->GetArray(vtkDataSetAttributes::GhostArrayName()) != nullptr;
  const int excluding =
    hasGhosts ? invisibleCell : invisibleCell | vtkDataSetAttributes::DUPLICATECELL;
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
  if ((ghostAt(input->GetCellData(), cell) &
        (invisibleCell | vtkDataSetAttributes::DUPLICATECELL)) != 0)
  {
    return true;
  }
  vtkNew<vtkIdList> corners;
  input->GetCellPoints(cell, corners);
  for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i)
  {
    if ((ghostAt(input->GetPointData(), corners->GetId(i)) & vtkDataSetAttributes::HIDDENPOINT) !=
        0)
    {
      return true;
    }
  }
  return false;
}

/// The samples of data sets, and the number of points or cells that are none.
struct Expectation
{
  Cloud samples;
  vtkIdType skipped = 0;
  bool hasArray = false;

  void add(const double p[3], double value, bool isLeftOut)
  {
    if (isLeftOut || !std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]) ||
        !std::isfinite(value))
    {
      ++this->skipped;
      return;
    }
    this->samples.add(p[0], p[1], p[2], value);
  }

  void add(vtkDataSet* input, bool ofCells)
  {
    vtkDataArray* const f =
      ofCells ? input->GetCellData()->GetArray("f") : input->GetPointData()->GetArray("f");
    if (!f)
    {
      this->skipped += std::max(input->GetNumberOfPoints(), input->GetNumberOfCells());
      return;
    }
    const vtkIdType count = f->GetNumberOfTuples();
    this->hasArray = this->hasArray || count > 0;
    for (vtkIdType i = 0; i < count; ++i)
    {
      double p[3];
      if (ofCells)
      {
        double bounds[6];
        input->GetCellBounds(i, bounds);
        for (int axis = 0; axis < 3; ++axis)
        {
          p[axis] = bounds[2 * axis] == bounds[2 * axis + 1]
                      ? bounds[2 * axis]
                      : 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]);
        }
      }
      else
      {
        input->GetPoint(i, p);
      }
      this->add(
        p, f->GetComponent(i, 0), ofCells ? isCellLeftOut(input, i) : isPointLeftOut(input, i));
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
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    double found[3];
    output->GetPoint(static_cast<vtkIdType>(i), found);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double first = samples.positions[3 * expected[i].first + axis];
      const double second = samples.positions[3 * expected[i].second + axis];
      const double t = expected[i].parameter;
      const double wanted = std::isfinite(second - first) ? first + t * (second - first)
                                                          : (1.0 - t) * first + t * second;
      require(isProjected ? std::isfinite(found[axis]) : found[axis] == wanted, "a position");
    }
  }
}

/// Thinned points are a subset of all, in the same order.
void checkThinned(vtkPolyData* all, vtkPolyData* thinned)
{
  vtkIdType next = 0;
  for (vtkIdType i = 0; i < thinned->GetNumberOfPoints(); ++i)
  {
    double wanted[3];
    thinned->GetPoint(i, wanted);
    while (next < all->GetNumberOfPoints() &&
           !std::equal(wanted, wanted + 3, all->GetPoints()->GetPoint(next)))
    {
      ++next;
    }
    require(next++ < all->GetNumberOfPoints(), "a thinned point");
  }
}

/// Updates the filter again, with thinning, and compares with its former output.
void checkThinning(double minimumSpacing, vtkScatteredIsopointFilter* filter)
{
  vtkDataObject* const output = filter->GetOutputDataObject(0);
  const auto former = vtkSmartPointer<vtkDataObject>::Take(output->NewInstance());
  former->DeepCopy(output);
  filter->SetMinimumSpacing(minimumSpacing);
  filter->Update();
  filter->SetMinimumSpacing(0.0);
  if (auto* const all = vtkPolyData::SafeDownCast(former))
  {
    checkThinned(all, filter->GetOutput());
    return;
  }
  auto* const all = vtkCompositeDataSet::SafeDownCast(former);
  auto* const thinned = vtkCompositeDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(all->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    checkThinned(vtkPolyData::SafeDownCast(all->GetDataSet(iterator)),
      vtkPolyData::SafeDownCast(thinned->GetDataSet(iterator)));
  }
}

/// Compares the filter's output with the isopoints that brute force finds in the input's data sets.
void check(const std::vector<vtkSmartPointer<vtkDataSet>>& dataSets, vtkDataObject* input,
  bool ofCells, int errorCount, vtkScatteredIsopointFilter* filter)
{
  const double isovalue = filter->GetValue(0);
  Expectation expected;
  for (vtkDataSet* const dataSet : dataSets)
  {
    expected.add(dataSet, ofCells);
  }
  const bool isUsable = expected.hasArray && !std::isnan(isovalue);
  require(errorCount == (isUsable ? 0 : 1), "the number of errors");
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
    alone.add(vtkDataSet::SafeDownCast(iterator->GetCurrentDataObject()), ofCells);
    auto* const output = vtkPolyData::SafeDownCast(blocks->GetDataSet(iterator));
    require((output != nullptr) == alone.hasArray, "the structure of the blocks");
    if (output)
    {
      checkPoints(filter, output, alone.samples, isovalue);
    }
  }
}

void update(ByteSource& bytes, vtkScatteredIsopointFilter* filter, ErrorCounter* errors)
{
  std::vector<vtkSmartPointer<vtkDataSet>> dataSets;
  const vtkSmartPointer<vtkDataObject> input = newInput(bytes, dataSets);
  const bool ofCells = bytes.flag();
  const double angle = bytes.flag() ? 54.7 : static_cast<double>(bytes.below(181));
  double isovalue = bytes.number(bytes.below(4));
  filter->SetInputData(input);
  filter->SetInputArrayToProcess(0, 0, 0,
    ofCells ? vtkDataObject::FIELD_ASSOCIATION_CELLS : vtkDataObject::FIELD_ASSOCIATION_POINTS,
    "f");
  filter->SetAngle(angle);
  filter->SetValue(0, isovalue);
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
  errors->Count = 0;
  filter->Update();
  check(dataSets, input, ofCells, errors->Count, filter);
  const int percent = bytes.below(101);
  if (errors->Count == 0)
  {
    checkThinning(0.01 * percent, filter);
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  ByteSource bytes(data, size);
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->DropGapsOff(); // brute force finds what lies in gaps too
  const auto errors = vtkSmartPointer<ErrorCounter>::Take(ErrorCounter::New());
  filter->AddObserver(vtkCommand::ErrorEvent, errors);
  for (int round = 0; round < 3; ++round)
  {
    update(bytes, filter, errors);
  }
  return 0;
}
