// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointNumbers_h
#define vtkIsopointNumbers_h

#include "Input/vtkIsopointBlocks.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkStructuredData.h"
#include "vtkType.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

/// The values of an array if it stores them contiguously as T, otherwise null.
template <class T>
const T* vtkGetPackedValues(vtkDataArray* array)
{
  auto* const packed = vtkAOSDataArrayTemplate<T>::FastDownCast(array);
  return packed ? packed->GetPointer(0) : nullptr;
}

/// Reads the positions of a data set's points from any thread. Those of an image are where its
/// matrix puts the indices: in VTK 9.6 vtkImageData::GetPoint() takes the spacing of oriented
/// images from the difference of two coordinates, and loses bits that way.
class vtkIsopointPositions
{
public:
  explicit vtkIsopointPositions(vtkDataSet* input)
    : Input(input)
    , Image(vtkImageData::SafeDownCast(input))
  {
    auto* const pointSet = vtkPointSet::SafeDownCast(input);
    vtkPoints* const points = pointSet ? pointSet->GetPoints() : nullptr;
    this->Floats = vtkGetPackedValues<float>(points ? points->GetData() : nullptr);
    this->Doubles = vtkGetPackedValues<double>(points ? points->GetData() : nullptr);
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
    else if (this->Image)
    {
      int index[3];
      vtkStructuredData::ComputePointStructuredCoordsForExtent(
        static_cast<vtkIdType>(point), this->Image->GetExtent(), index);
      this->Image->TransformIndexToPhysicalPoint(index, position);
    }
    else // coordinates along axes, structures of arrays, integers
    {
      this->Input->GetPoint(static_cast<vtkIdType>(point), position);
    }
  }

private:
  vtkDataSet* Input;
  vtkImageData* Image;
  const float* Floats;
  const double* Doubles;
};

/// Reads numbers of an array of any type from any thread; 0 without an array. Exact except for
/// 64-bit integers beyond 2^53.
class vtkIsopointNumbers
{
public:
  explicit vtkIsopointNumbers(vtkDataArray* array)
    : Array(array)
    , Floats(vtkGetPackedValues<float>(array))
    , Doubles(vtkGetPackedValues<double>(array))
    , Components(array ? static_cast<std::size_t>(array->GetNumberOfComponents()) : 1)
  {
  }

  double operator()(std::size_t tuple, std::size_t component = 0) const
  {
    const std::size_t index = this->Components * tuple + component;
    return this->Floats    ? static_cast<double>(this->Floats[index])
           : this->Doubles ? this->Doubles[index]
           : this->Array
             ? this->Array->GetComponent(static_cast<vtkIdType>(tuple), static_cast<int>(component))
             : 0.0;
  }

private:
  vtkDataArray* Array;
  const float* Floats;
  const double* Doubles;
  std::size_t Components;
};

/// The ids of samples, which number those of one block after the other.
class vtkIsopointSampleIds
{
public:
  explicit vtkIsopointSampleIds(const std::vector<vtkIsopointBlock>& blocks)
  {
    for (const vtkIsopointBlock& block : blocks)
    {
      this->Firsts.push_back(this->Count);
      this->Count += static_cast<std::size_t>(block.GetNumberOfSamples());
    }
  }

  std::size_t GetCount() const { return this->Count; }

  /// The block of a sample, and its number there.
  std::pair<std::size_t, std::size_t> Find(std::size_t id) const
  {
    const auto next = std::upper_bound(this->Firsts.begin(), this->Firsts.end(), id);
    const auto block = static_cast<std::size_t>(next - this->Firsts.begin()) - 1;
    return { block, id - this->Firsts[block] };
  }

private:
  std::vector<std::size_t> Firsts; // ids, ascending
  std::size_t Count = 0;
};

#endif
