// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointBlock_h
#define vtkIsopointBlock_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <vector>

class vtkDataArray;
class vtkDataSet;
class vtkDataSetAttributes;
class vtkUnsignedCharArray;

/**
 * A part of the input, seen as samples: its points or the centres of its cells. Samples have the
 * ids of these; nothing of the input is copied but what positions of centres need.
 */
struct vtkIsopointBlock
{
  vtkSmartPointer<vtkDataSet> Positions; // one point for each sample; its attributes mean nothing
  vtkDataSetAttributes* Attributes = nullptr;
  vtkDataArray* Scalars = nullptr;

  /// Null, or for each sample whether to leave it out: bits vtkDataSetAttributes::DUPLICATEPOINT
  /// and HIDDENPOINT.
  vtkSmartPointer<vtkUnsignedCharArray> Ghosts;

  /// Samples that `Ghosts` leaves out because they only fill the gaps between the ids of others.
  vtkIdType Fillers = 0;

  /// The number of its leaf in the composite input's traversal, 0 where the input is no composite.
  std::size_t Leaf = 0;

  vtkIdType GetNumberOfSamples() const;
};

/**
 * What the samples of blocks were read from, in order: the modification times of the objects that
 * positions, scalars and ghosts belong to. Each is unique among all objects, so equal ones mean the
 * same objects, unchanged; a maximum over several would not. Where an object changes without a new
 * modification time, numbers that describe it follow: counts, or a hash of what it holds.
 */
using vtkIsopointState = std::vector<vtkMTimeType>;

#endif
