// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointInput.h"

#include "Isopoint/Base/Communicator.h"
#include "Isopoint/Base/Execution.h"
#include "Isopoint/Base/Team.h"
#include "Isopoint/IsosurfaceExtractor.h"
#include "vtkIsopointBlock.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkType.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace
{

/// Coordinates stored as x y z, x y z, ...
template <class T>
struct PackedPositions
{
  using Coordinate = T;
  const T* Coordinates;

  template <class TOut>
  void operator()(std::size_t point, TOut position[3]) const
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      position[axis] = static_cast<TOut>(this->Coordinates[3 * point + axis]);
    }
  }
};

/// All other positions: implicit ones, structures of arrays, integers.
struct ComputedPositions
{
  using Coordinate = double;
  vtkDataSet* Input;

  void operator()(std::size_t point, double position[3]) const
  {
    this->Input->GetPoint(static_cast<vtkIdType>(point), position);
  }
};

template <class T>
struct PackedValues
{
  using Value = T;
  const T* Values;

  T operator()(std::size_t point) const { return this->Values[point]; }
};

/// Values of any type, converted to T: exactly, except 64-bit integers beyond 2^53.
template <class T>
struct ConvertedValues
{
  using Value = T;
  vtkDataArray* Array;

  T operator()(std::size_t point) const
  {
    return static_cast<T>(this->Array->GetComponent(static_cast<vtkIdType>(point), 0));
  }
};

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

template <class Action>
void withPositions(vtkDataSet* input, const Action& action)
{
  vtkDataArray* const points = coordinatesOf(input);
  if (const float* const floats = points ? packedArray<float>(points) : nullptr)
  {
    action(PackedPositions<float>{ floats });
  }
  else if (const double* const doubles = points ? packedArray<double>(points) : nullptr)
  {
    action(PackedPositions<double>{ doubles });
  }
  else
  {
    action(ComputedPositions{ input });
  }
}

/// Whether float holds all values of the array's type exactly.
bool isExactInFloat(vtkDataArray* scalars)
{
  return scalars->GetDataType() == VTK_FLOAT || scalars->GetDataTypeSize() <= 2;
}

template <class Action>
void withValues(vtkDataArray* scalars, const Action& action)
{
  if (const float* const floats = packedArray<float>(scalars))
  {
    action(PackedValues<float>{ floats });
  }
  else if (const double* const doubles = packedArray<double>(scalars))
  {
    action(PackedValues<double>{ doubles });
  }
  else if (isExactInFloat(scalars))
  {
    action(ConvertedValues<float>{ scalars });
  }
  else
  {
    action(ConvertedValues<double>{ scalars });
  }
}

/// Ghost bits of items that take no part.
constexpr unsigned char excluding =
  vtkDataSetAttributes::DUPLICATEPOINT | vtkDataSetAttributes::HIDDENPOINT;

const unsigned char* ghostsOf(const vtkIsopointBlock& block)
{
  return block.Ghosts ? block.Ghosts->GetPointer(0) : nullptr;
}

template <class Coordinate, class Value, class Reader>
void loadOrReplace(const isopoint::Execution& execution, std::size_t count, const Reader& read,
  isopoint::IsosurfaceExtractor& extractor)
{
  if (!extractor.replaceValues<Coordinate, Value>(execution, count, read))
  {
    extractor.load<Coordinate, Value>(execution, count, read);
  }
}

/// Loads a single block, with the types of its arrays known to the compiler.
void loadBlock(const isopoint::Execution& execution, const vtkIsopointBlock& block,
  isopoint::IsosurfaceExtractor& extractor)
{
  const unsigned char* const ghosts = ghostsOf(block);
  withPositions(block.Positions,
    [&](const auto& positions)
    {
      using Coordinate = typename std::decay_t<decltype(positions)>::Coordinate;
      withValues(block.Scalars,
        [&](const auto& values)
        {
          using Value = typename std::decay_t<decltype(values)>::Value;
          const auto read = [&](std::size_t point, auto* position, auto& value)
          {
            if (ghosts && (ghosts[point] & excluding) != 0)
            {
              return false;
            }
            positions(point, position);
            value = values(point);
            return true;
          };
          loadOrReplace<Coordinate, Value>(
            execution, static_cast<std::size_t>(block.GetNumberOfSamples()), read, extractor);
        });
    });
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
      PackedPositions<float>{ this->Floats }(point, position);
    }
    else if (this->Doubles)
    {
      PackedPositions<double>{ this->Doubles }(point, position);
    }
    else
    {
      ComputedPositions{ this->Input }(point, position);
    }
  }

private:
  vtkDataSet* Input;
  const float* Floats;
  const double* Doubles;
};

/// Values of any type, determined at run time.
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
    if (part.Ghosts && (part.Ghosts[point] & excluding) != 0)
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

void loadBlocks(const isopoint::Execution& execution, const std::vector<vtkIsopointBlock>& blocks,
  isopoint::IsosurfaceExtractor& extractor)
{
  const BlockReader read(blocks);
  const bool floatPositions = vtkHaveFloatPositions(blocks);
  const bool floatValues = haveFloatValues(blocks);
  const auto load = [&](auto coordinate, auto value) {
    loadOrReplace<decltype(coordinate), decltype(value)>(execution, read.count(), read, extractor);
  };
  floatPositions ? (floatValues ? load(0.0f, 0.0f) : load(0.0f, 0.0))
                 : (floatValues ? load(0.0, 0.0f) : load(0.0, 0.0));
}

/// Null unless positions are stored as x y z, x y z, ... of float.
const float* packedPositions(const vtkIsopointBlock& block)
{
  vtkDataArray* const points = coordinatesOf(block.Positions);
  return points ? packedArray<float>(points) : nullptr;
}

} // namespace

void vtkLoadIsopointInput(const isopoint::Execution& execution,
  const std::vector<vtkIsopointBlock>& blocks, isopoint::IsosurfaceExtractor& extractor)
{
  blocks.size() == 1 ? loadBlock(execution, blocks.front(), extractor)
                     : loadBlocks(execution, blocks, extractor);
  extractor.setValueError(errorOfValues(haveIntegers(blocks)));
}

void vtkLoadIsopointInputOnRanks(const isopoint::Execution& execution,
  const std::vector<vtkIsopointBlock>& blocks, isopoint::Team& team,
  isopoint::Communicator& communicator, isopoint::IsosurfaceExtractor& extractor)
{
  const bool floatPositions = !team.isAny(!vtkHaveFloatPositions(blocks));
  const bool floatValues = !team.isAny(!haveFloatValues(blocks));
  const double valueError = errorOfValues(!team.isAny(!haveIntegers(blocks)));
  // A rank alone may have dropped its samples, as for lack of memory.
  const bool areHeld = !team.isAny(!extractor.isOnRanks());
  const auto loadWith = [&](std::size_t count, const auto& read)
  {
    const auto load = [&](auto coordinate, auto value)
    {
      if (!areHeld || !extractor.replaceValuesOnRanks<decltype(coordinate), decltype(value)>(
                        execution, count, read))
      {
        extractor.loadOnRanks<decltype(coordinate), decltype(value)>(
          execution, communicator, count, read);
      }
    };
    floatPositions ? (floatValues ? load(0.0f, 0.0f) : load(0.0f, 0.0))
                   : (floatValues ? load(0.0, 0.0f) : load(0.0, 0.0));
    extractor.setValueError(valueError);
  };
  const vtkIsopointBlock* const single = blocks.size() == 1 ? &blocks.front() : nullptr;
  const float* const positions = single ? packedPositions(*single) : nullptr;
  const float* const values = single ? packedArray<float>(single->Scalars) : nullptr;
  if (!positions || !values)
  {
    const BlockReader read(blocks);
    loadWith(read.count(), read);
    return;
  }
  // The commonest types are known to the compiler.
  const unsigned char* const ghosts = ghostsOf(*single);
  loadWith(static_cast<std::size_t>(single->GetNumberOfSamples()),
    [=](std::size_t point, auto* position, auto& value)
    {
      if (ghosts && (ghosts[point] & excluding) != 0)
      {
        return false;
      }
      PackedPositions<float>{ positions }(point, position);
      value = static_cast<std::decay_t<decltype(value)>>(values[point]);
      return true;
    });
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
