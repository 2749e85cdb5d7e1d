// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointPlaces_h
#define vtkIsopointPlaces_h

#include "vtkType.h"

#include <string>

class vtkDataArray;
class vtkDataObject;
class vtkDataSet;
class vtkDataSetAttributes;

/// The arrays that a copy has.
struct vtkIsopointPassing
{
  bool PointArrays = true; // ghost marks are passed in any case
  bool CellArrays = true;
  bool FieldArrays = true;
};

/// Makes an empty output of the input's type a shallow copy of it. In composites, leaves that are
/// no data sets become null.
void vtkCopyIsopointPlaces(
  vtkDataObject* input, const vtkIsopointPassing& passing, vtkDataObject* output);

/// Makes an empty output of the input's type a shallow copy of it, leaf by leaf.
void vtkCopyIsopointInput(vtkDataObject* input, vtkDataObject* output);

/// Adds `count` tuples of an array, or the array itself if it has no more.
/// @param attribute a vtkDataSetAttributes::AttributeTypes that the array becomes, or -1
/// @throws std::bad_alloc
void vtkAddIsopointTuples(
  vtkDataArray* all, vtkIdType first, vtkIdType count, int attribute, vtkDataSetAttributes* output);

/// Adds an array of char: 0 at null points, 1 at others.
/// @param areNull by point
/// @throws std::bad_alloc
void vtkAddIsopointMask(const unsigned char* areNull, const std::string& name, vtkDataSet* output);

#endif
