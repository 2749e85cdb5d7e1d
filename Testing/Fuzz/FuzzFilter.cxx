// SPDX-License-Identifier: GPL-3.0-or-later
// Data objects made of a fuzzer's bytes: the filter must give the points of brute force on the
// samples that they stand for, or one error and an empty output.
#include "ByteSource.h"

#include "../Cxx/BruteForce.h"
#include "../Cxx/Clouds.h"

#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkCompositeDataIterator.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkObject.h"
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
#include <cstdio>
#include <cstdlib>

namespace
{

using clouds::Cloud;

[[noreturn]] void fail(const char* what)
{
  std::fprintf(stderr, "the filter is wrong: %s\n", what);
  std::abort();
}

class ErrorCounter : public vtkCommand
{
public:
  static ErrorCounter* New() { return new ErrorCounter; }
  void Execute(vtkObject*, unsigned long, void*) override { ++this->Count; }
  int Count = 0;
};

/// A number that an array of this type holds exactly.
double fitting(double number, int type)
{
  if (type == VTK_DOUBLE)
  {
    return number;
  }
  if (type == VTK_FLOAT)
  {
    return std::abs(number) > static_cast<double>(std::numeric_limits<float>::max())
             ? std::copysign(std::numeric_limits<double>::infinity(), number)
             : static_cast<double>(static_cast<float>(number));
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
    array->SetComponent(i, 0, fitting(bytes.number(kind), type));
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
      points->GetData()->SetComponent(i, axis, fitting(bytes.number(kind), type));
    }
  }
  return points;
}

vtkSmartPointer<vtkDataSet> newDataSet(ByteSource& bytes)
{
  vtkSmartPointer<vtkDataSet> result;
  switch (bytes.below(4))
  {
    case 0:
    {
      vtkNew<vtkPolyData> cloud;
      cloud->SetPoints(newPoints(bytes, bytes.below(40)));
      result = cloud;
      break;
    }
    case 1:
    {
      vtkNew<vtkImageData> image;
      const int x = bytes.below(4);
      const int y = bytes.below(4);
      const int z = bytes.below(4);
      image->SetDimensions(x, y, z);
      image->SetOrigin(bytes.below(4), bytes.below(4), bytes.below(4));
      image->SetSpacing(1.0 + bytes.below(2), 1.0, 0.5);
      result = image;
      break;
    }
    case 2:
    {
      vtkNew<vtkRectilinearGrid> grid;
      int dimensions[3];
      vtkNew<vtkDoubleArray> coordinates[3];
      for (int axis = 0; axis < 3; ++axis)
      {
        dimensions[axis] = 1 + bytes.below(4);
        double coordinate = bytes.below(8);
        for (int i = 0; i < dimensions[axis]; ++i)
        {
          coordinates[axis]->InsertNextValue(coordinate);
          coordinate += 0.25 * bytes.below(16);
        }
      }
      grid->SetDimensions(dimensions);
      grid->SetXCoordinates(coordinates[0]);
      grid->SetYCoordinates(coordinates[1]);
      grid->SetZCoordinates(coordinates[2]);
      result = grid;
      break;
    }
    default:
    {
      vtkNew<vtkUnstructuredGrid> grid;
      const int count = 1 + bytes.below(30);
      grid->SetPoints(newPoints(bytes, count));
      const int cells = bytes.below(20);
      for (int cell = 0; cell < cells; ++cell)
      {
        // Vertices alone: how the centres of others are rounded is not defined.
        const vtkIdType corner = bytes.below(count);
        grid->InsertNextCell(VTK_VERTEX, 1, &corner);
      }
      result = grid;
    }
  }
  addArrays(bytes, result->GetPointData(), result->GetNumberOfPoints());
  addArrays(bytes, result->GetCellData(), result->GetNumberOfCells());
  return result;
}

int ghostAt(vtkDataSetAttributes* attributes, vtkIdType i)
{
  vtkDataArray* const ghosts = attributes->GetArray(vtkDataSetAttributes::GhostArrayName());
  return ghosts ? static_cast<int>(ghosts->GetComponent(i, 0)) : 0;
}

constexpr int invisibleCell = vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL;

/// By the filter's documentation, a point at a time.
bool isPointLeftOut(vtkDataSet* input, vtkIdType point)
{
  if ((ghostAt(input->GetPointData(), point) &
        (vtkDataSetAttributes::DUPLICATEPOINT | vtkDataSetAttributes::HIDDENPOINT)) != 0)
  {
    return true;
  }
  bool inInvisible = false;
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    input->GetCellPoints(cell, corners);
    if (corners->IsId(point) >= 0)
    {
      if ((ghostAt(input->GetCellData(), cell) & invisibleCell) == 0)
      {
        return false;
      }
      inInvisible = true;
    }
  }
  return inInvisible;
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

/// What a data set's samples are, and how many of its points or cells are none.
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

vtkSmartPointer<vtkDataObject> newInput(
  ByteSource& bytes, std::vector<vtkSmartPointer<vtkDataSet>>& leaves)
{
  const int kind = bytes.below(4);
  if (kind <= 1)
  {
    leaves.push_back(newDataSet(bytes));
    return leaves.back();
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
    leaves.push_back(newDataSet(bytes));
    multi->SetBlock(static_cast<unsigned int>(block), leaves.back());
    collection->SetPartition(static_cast<unsigned int>(block), 0, leaves.back());
  }
  return kind == 2 ? vtkSmartPointer<vtkDataObject>(multi)
                   : vtkSmartPointer<vtkDataObject>(collection);
}

void checkPoints(
  vtkScatteredIsopointFilter* filter, vtkPolyData* output, const Cloud& samples, double isovalue)
{
  const double angle = filter->GetAngle();
  const bool isProjected = filter->GetProjection() != vtkScatteredIsopointFilter::NO_PROJECTION;
  const std::vector<bruteforce::Point> expected = bruteforce::extract(samples, isovalue, angle);
  if (output->GetNumberOfPoints() != static_cast<vtkIdType>(expected.size()) ||
      output->GetNumberOfCells() != output->GetNumberOfPoints())
  {
    fail("number of points");
  }
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
      if (isProjected ? !std::isfinite(found[axis]) : found[axis] != wanted)
      {
        fail("a position");
      }
    }
  }
}

/// The thinned points are some of all, in their order.
void checkThinned(vtkPolyData* all, vtkPolyData* thinned)
{
  vtkIdType next = 0;
  for (vtkIdType i = 0; i < thinned->GetNumberOfPoints(); ++i)
  {
    double wanted[3];
    thinned->GetPoint(i, wanted);
    for (double found[3] = {}; next < all->GetNumberOfPoints(); ++next)
    {
      all->GetPoint(next, found);
      if (std::equal(found, found + 3, wanted))
      {
        break;
      }
    }
    if (next++ >= all->GetNumberOfPoints())
    {
      fail("a thinned point");
    }
  }
}

/// Updates the filter again, with thinning.
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

/// Compares the filter's output with what brute force finds in the input's leaves.
void check(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves, vtkDataObject* input,
  bool ofCells, int errorCount, vtkScatteredIsopointFilter* filter)
{
  const double isovalue = filter->GetValue(0);
  Expectation expected;
  for (vtkDataSet* const leaf : leaves)
  {
    expected.add(leaf, ofCells);
  }
  const bool isUsable = expected.hasArray && !std::isnan(isovalue);
  if (errorCount != (isUsable ? 0 : 1))
  {
    fail("number of errors");
  }
  if (auto* const output = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0)))
  {
    checkPoints(filter, output, isUsable ? expected.samples : Cloud(), isovalue);
    if (isUsable && filter->GetNumberOfSkippedSamples() != expected.skipped)
    {
      fail("skipped samples");
    }
    return;
  }
  auto* const blocks = vtkCompositeDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  auto* const composite = vtkCompositeDataSet::SafeDownCast(input);
  if (!blocks || !composite)
  {
    fail("type of the output");
  }
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
    if ((output != nullptr) != alone.hasArray)
    {
      fail("structure of the blocks");
    }
    if (output)
    {
      checkPoints(filter, output, alone.samples, isovalue);
    }
  }
}

void update(ByteSource& bytes, vtkScatteredIsopointFilter* filter, ErrorCounter* errors)
{
  std::vector<vtkSmartPointer<vtkDataSet>> leaves;
  const vtkSmartPointer<vtkDataObject> input = newInput(bytes, leaves);
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
  filter->SetComputeRadii(bytes.below(4) != 0);
  filter->SetComputeScalars(bytes.below(4) != 0);
  filter->SetKeepTree(bytes.below(4) != 0);
  filter->SetUseAllCores(bytes.below(8) == 0);
  filter->SetContourBlocks(bytes.below(4) == 0);
  filter->SetNumberOfNeighbors(3 + bytes.below(20));
  filter->SetProjection(bytes.below(5));
  filter->SetNormalMethod(bytes.below(2));
  filter->SetComputeGradients(bytes.below(2) != 0);
  filter->SetComputeProjectionOrders(bytes.below(2) != 0);
  filter->SetComputeSplatAxes(bytes.below(2) != 0);
  filter->SetComputeSplatClips(bytes.below(2) != 0);
  errors->Count = 0;
  filter->Update();
  check(leaves, input, ofCells, errors->Count, filter);
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
  const auto errors = vtkSmartPointer<ErrorCounter>::Take(ErrorCounter::New());
  filter->AddObserver(vtkCommand::ErrorEvent, errors);
  for (int round = 0; round < 3; ++round)
  {
    update(bytes, filter, errors);
  }
  return 0;
}
