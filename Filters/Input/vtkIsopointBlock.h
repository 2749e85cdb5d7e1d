// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointBlock_h
#define vtkIsopointBlock_h

#include "vtkDataSetAttributes.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>

class vtkDataArray;
class vtkDataSet;
class vtkUnsignedCharArray;

/**
 * The samples of a data set or hyper tree grid: its points or the centers of its cells. Sample ids
 * are those of the points or cells. Nothing of the input is copied except cell centers, where they
 * have to be computed.
 */
struct vtkIsopointBlock
{
  vtkSmartPointer<vtkDataSet> Positions; // one point for each sample; its attributes are ignored
  vtkDataSetAttributes* Attributes = nullptr;
  vtkDataArray* Scalars = nullptr;

  /// Null, or one value for each sample, which takes no part if it has one of these bits.
  vtkSmartPointer<vtkUnsignedCharArray> Ghosts;
  static constexpr unsigned char Excluding =
    vtkDataSetAttributes::DUPLICATEPOINT | vtkDataSetAttributes::HIDDENPOINT;

  /// The number of samples that `Ghosts` excludes.
  vtkIdType NumberOfExcluded = 0;

  /// Of a hyper tree grid: how many of the excluded ids are those of coarse nodes, or of none.
  vtkIdType NumberOfUnusedIds = 0;

  /// The number of its leaf in the traversal of a composite input; 0 if the input is no composite.
  std::size_t Leaf = 0;

  vtkIdType GetNumberOfSamples() const;
};

#endif
