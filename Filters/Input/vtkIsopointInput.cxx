// SPDX-License-Identifier: GPL-3.0-or-later
#include "Input/vtkIsopointInput.h"

#include "Common/vtkIsopointArrays.h"
#include "Core/Contour.h"
#include "Input/vtkIsopointBlocks.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkType.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace
{

/// The values of an array if it stores them contiguously as T, otherwise null.
template <class T>
const T* packedArray(vtkDataArray* array)
{
  auto* const packed = vtkAOSDataArrayTemplate<T>::FastDownCast(array);
  return packed ? packed->GetPointer(0) : nullptr;
}

vtkDataArray* coordinatesOf(vtkDataSet* input)
{
  auto* const pointSet = vtkPointSet::SafeDownCast(input);
  return pointSet && pointSet->GetPoints() ? pointSet->GetPoints()->GetData() : nullptr;
}

const unsigned char* ghostsOf(const vtkIsopointBlock& block)
{
  return block.Ghosts ? block.Ghosts->GetPointer(0) : nullptr;
}

/// Positions of any array type, dispatched at run time.
class AnyPositions
{
public:
  explicit AnyPositions(vtkDataSet* input)
    : Input(input)
    , Floats(packedArray<float>(coordinatesOf(input)))
    , Doubles(packedArray<double>(coordinatesOf(input)))
  {
  }

  void operator()(std::size_t point, double position[3]) const
  {
    if (this->Floats)
    {
      std::copy_n(this->Floats + 3 * point, 3, position);
    }
    else if (this->Doubles)
    {
      std::copy_n(this->Doubles + 3 * point, 3, position);
    }
    else // implicit positions, structures of arrays, integers
    {
      this->Input->GetPoint(static_cast<vtkIdType>(point), position);
    }
  }

private:
  vtkDataSet* Input;
  const float* Floats;
  const double* Doubles;
};

/// Values of any array type, dispatched at run time. Exact except for 64-bit integers beyond 2^53.
class AnyValues
{
public:
  explicit AnyValues(vtkDataArray* scalars)
    : Array(scalars)
    , Floats(packedArray<float>(scalars))
    , Doubles(packedArray<double>(scalars))
  {
  }

  double operator()(std::size_t point) const
  {
    return this->Floats    ? static_cast<double>(this->Floats[point])
           : this->Doubles ? this->Doubles[point]
                           : this->Array->GetComponent(static_cast<vtkIdType>(point), 0);
  }

private:
  vtkDataArray* Array;
  const float* Floats;
  const double* Doubles;
};

/// Reads the samples of several blocks for IsosurfaceExtractor::load().
class BlockReader
{
public:
  explicit BlockReader(const std::vector<vtkIsopointBlock>& blocks)
  {
    for (const vtkIsopointBlock& block : blocks)
    {
      this->Firsts.push_back(this->Count);
      this->Count += static_cast<std::size_t>(block.GetNumberOfSamples());
      this->Parts.push_back(
        { AnyPositions(block.Positions), AnyValues(block.Scalars), ghostsOf(block) });
    }
  }

  std::size_t count() const { return this->Count; }

  template <class TCoordinate, class TValue>
  bool operator()(std::size_t id, TCoordinate* position, TValue& value) const
  {
    const auto next = std::upper_bound(this->Firsts.begin(), this->Firsts.end(), id);
    const auto index = static_cast<std::size_t>(next - this->Firsts.begin()) - 1;
    const Part& part = this->Parts[index];
    const std::size_t point = id - this->Firsts[index];
    if (part.Ghosts && (part.Ghosts[point] & vtkIsopointBlock::Excluding) != 0)
    {
      return false;
    }
    double coordinates[3];
    part.Positions(point, coordinates);
    std::transform(coordinates, coordinates + 3, position,
      [](double coordinate) { return static_cast<TCoordinate>(coordinate); });
    value = static_cast<TValue>(part.Values(point));
    return true;
  }

private:
  struct Part
  {
    AnyPositions Positions;
    AnyValues Values;
    const unsigned char* Ghosts;
  };

  std::vector<std::size_t> Firsts; // ids, ascending
  std::vector<Part> Parts;
  std::size_t Count = 0;
};

} // namespace

isopoint::SampleTypes vtkGetIsopointSampleTypes(const std::vector<vtkIsopointBlock>& blocks)
{
  isopoint::SampleTypes types{ true, true, true };
  for (const vtkIsopointBlock& block : blocks)
  {
    const int type = block.Scalars->GetDataType();
    types.areFloatPositions &= vtkGetTypeOfPoints(block.Positions) == VTK_FLOAT;
    types.areFloatValues &= type == VTK_FLOAT || block.Scalars->GetDataTypeSize() <= 2;
    types.areIntegers &= type != VTK_FLOAT && type != VTK_DOUBLE;
  }
  return types;
}

isopoint::CloudCounts vtkCountIsopointSamples(const std::vector<vtkIsopointBlock>& blocks)
{
  isopoint::CloudCounts counts;
  for (const vtkIsopointBlock& block : blocks)
  {
    const auto unused = static_cast<std::uint64_t>(block.NumberOfUnusedIds);
    counts.items += static_cast<std::uint64_t>(block.GetNumberOfSamples());
    counts.excluded += static_cast<std::uint64_t>(block.NumberOfExcluded) - unused;
    counts.unused += unused;
  }
  return counts;
}

void vtkLoadIsopointInput(const isopoint::Execution& execution, isopoint::ProcessGroup& processes,
  const isopoint::SampleTypes& types, const std::vector<vtkIsopointBlock>& blocks,
  isopoint::IsosurfaceExtractor& extractor)
{
  const BlockReader read(blocks);
  isopoint::loadOrReplace(execution, &processes, extractor, types, read.count(), read);
}
