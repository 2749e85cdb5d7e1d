// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointInput.h"

#include "Isopoint/IsosurfaceExtractor.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"

namespace
{

/// Coordinates that lie in memory as x y z, x y z, ...
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

/// Any others: implicit ones, structures of arrays, integers.
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

/// Values of any type, held as one that loses nothing (or, of 64-bit integers, as little as any).
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

vtkDataArray* pointsOf(vtkDataSet* input)
{
  auto* const pointSet = vtkPointSet::SafeDownCast(input);
  return pointSet && pointSet->GetPoints() ? pointSet->GetPoints()->GetData() : nullptr;
}

template <class Action>
void withPositions(vtkDataSet* input, const Action& action)
{
  vtkDataArray* const points = pointsOf(input);
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

template <class Action>
void withValues(vtkDataArray* scalars, const Action& action)
{
  const bool fitsFloat = scalars->GetDataType() == VTK_FLOAT || scalars->GetDataTypeSize() <= 2;
  if (const float* const floats = packedArray<float>(scalars))
  {
    action(PackedValues<float>{ floats });
  }
  else if (const double* const doubles = packedArray<double>(scalars))
  {
    action(PackedValues<double>{ doubles });
  }
  else if (fitsFloat)
  {
    action(ConvertedValues<float>{ scalars });
  }
  else
  {
    action(ConvertedValues<double>{ scalars });
  }
}

/// For each point whether it is one that another rank, block or level owns, or that is blanked.
const unsigned char* ghostsOf(vtkDataSet* input)
{
  auto* const ghosts = vtkUnsignedCharArray::SafeDownCast(
    input->GetPointData()->GetArray(vtkDataSetAttributes::GhostArrayName()));
  return ghosts && ghosts->GetNumberOfValues() == input->GetNumberOfPoints() ? ghosts->GetPointer(0)
                                                                             : nullptr;
}

} // namespace

void vtkLoadIsopointInput(const isopoint::Execution& execution, vtkDataSet* input,
  vtkDataArray* scalars, isopoint::IsosurfaceExtractor& extractor)
{
  const auto count = static_cast<std::size_t>(input->GetNumberOfPoints());
  const unsigned char* const ghosts = ghostsOf(input);
  const unsigned char leftOut =
    vtkDataSetAttributes::DUPLICATEPOINT | vtkDataSetAttributes::HIDDENPOINT;
  withPositions(input,
    [&](const auto& positions)
    {
      using Coordinate = typename std::decay_t<decltype(positions)>::Coordinate;
      withValues(scalars,
        [&](const auto& values)
        {
          using Value = typename std::decay_t<decltype(values)>::Value;
          const auto read = [&](std::size_t point, auto* position, auto& value)
          {
            if (ghosts && (ghosts[point] & leftOut) != 0)
            {
              return false;
            }
            positions(point, position);
            value = values(point);
            return true;
          };
          if (!extractor.replaceValues<Coordinate, Value>(execution, count, read))
          {
            extractor.load<Coordinate, Value>(execution, count, read);
          }
        });
    });
}

vtkIsopointPositions::vtkIsopointPositions(vtkDataSet* input)
  : Input(input)
{
  vtkDataArray* const points = pointsOf(input);
  this->Floats = points ? packedArray<float>(points) : nullptr;
  this->Doubles = points ? packedArray<double>(points) : nullptr;
}

void vtkIsopointPositions::Get(vtkIdType point, double position[3]) const
{
  const auto index = static_cast<std::size_t>(point);
  if (this->Floats)
  {
    PackedPositions<float>{ this->Floats }(index, position);
  }
  else if (this->Doubles)
  {
    PackedPositions<double>{ this->Doubles }(index, position);
  }
  else
  {
    ComputedPositions{ this->Input }(index, position);
  }
}
