// SPDX-License-Identifier: GPL-3.0-or-later
#include "Input/vtkIsopointInput.h"

#include "Core/Base/Execution.h"
#include "Core/Base/Team.h"
#include "Core/IsosurfaceExtractor.h"
#include "Input/vtkIsopointBlock.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkType.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace
{

/// The values of an array that stores them one after the other as T, or null.
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

/// Whether float holds all values of the array's type exactly.
bool isExactInFloat(vtkDataArray* scalars)
{
  return scalars->GetDataType() == VTK_FLOAT || scalars->GetDataTypeSize() <= 2;
}

const unsigned char* ghostsOf(const vtkIsopointBlock& block)
{
  return block.Ghosts ? block.Ghosts->GetPointer(0) : nullptr;
}

/// Positions of any kind, determined at run time.
class AnyPositions
{
public:
  explicit AnyPositions(vtkDataSet* input)
    : Input(input)
  {
    vtkDataArray* const points = coordinatesOf(input);
    this->Floats = points ? packedArray<float>(points) : nullptr;
    this->Doubles = points ? packedArray<double>(points) : nullptr;
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

/// Values of any type, determined at run time: exactly, except 64-bit integers beyond 2^53.
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

/// Reads the samples of several blocks, as IsosurfaceExtractor::load() calls for.
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

bool haveFloatValues(const std::vector<vtkIsopointBlock>& blocks)
{
  return std::all_of(blocks.begin(), blocks.end(),
    [](const vtkIsopointBlock& block) { return isExactInFloat(block.Scalars); });
}

bool haveIntegers(const std::vector<vtkIsopointBlock>& blocks)
{
  return std::all_of(blocks.begin(), blocks.end(),
    [](const vtkIsopointBlock& block)
    {
      const int type = block.Scalars->GetDataType();
      return type != VTK_FLOAT && type != VTK_DOUBLE;
    });
}

/// The standard error that values have at least: that of rounding, if all were rounded to integers.
double errorOfValues(bool areIntegers)
{
  return areIntegers ? 1.0 / std::sqrt(12.0) : 0.0;
}

} // namespace

void vtkLoadIsopointInput(const isopoint::Execution& execution, isopoint::Team& team,
  const std::vector<vtkIsopointBlock>& blocks, isopoint::IsosurfaceExtractor& extractor)
{
  const bool floatPositions = !team.isAny(!vtkHaveFloatPositions(blocks));
  const bool floatValues = !team.isAny(!haveFloatValues(blocks));
  const double valueError = errorOfValues(!team.isAny(!haveIntegers(blocks)));
  // A rank alone may have dropped its samples, as for lack of memory.
  const bool areHeld = !team.isAny(extractor.isOnRanks() != (team.size() > 1));
  const BlockReader read(blocks);
  const auto load = [&](auto coordinate, auto value)
  {
    using Coordinate = decltype(coordinate);
    using Value = decltype(value);
    if (!areHeld || !extractor.replaceValues<Coordinate, Value>(execution, read.count(), read))
    {
      extractor.load<Coordinate, Value>(execution, team, read.count(), read);
    }
  };
  floatPositions ? (floatValues ? load(0.0f, 0.0f) : load(0.0f, 0.0))
                 : (floatValues ? load(0.0, 0.0f) : load(0.0, 0.0));
  extractor.setValueError(valueError);
}

bool vtkHaveFloatPositions(const std::vector<vtkIsopointBlock>& blocks)
{
  return std::all_of(blocks.begin(), blocks.end(),
    [](const vtkIsopointBlock& block)
    {
      vtkDataArray* const points = coordinatesOf(block.Positions);
      return points && points->GetDataType() == VTK_FLOAT;
    });
}
