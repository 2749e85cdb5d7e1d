// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointPlaces_h
#define vtkIsopointPlaces_h

#include "Core/Base/Vector.h"

#include "vtkType.h"

#include <string>
#include <vector>

class vtkAbstractArray;
class vtkDataObject;
class vtkDataSet;
class vtkDataSetAttributes;
class vtkImageData;
class vtkPolyData;

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

/// The positions of the points of a data set, after those in the list.
void vtkAppendIsopointPlaces(vtkDataSet* data, std::vector<isopoint::Vector>& places);

/// The array of lines with the distance from their begin.
constexpr const char* vtkIsopointLineLength = "arc_length";

/// Makes a polyline of `count` points, none or at least two, at equal distances, with the array
/// vtkIsopointLineLength.
/// @throws isopoint::UsageError unless its ends are finite; std::bad_alloc
void vtkMakeIsopointLine(
  const double begin[3], const double end[3], vtkIdType count, vtkPolyData* output);

/// The points of an image.
struct vtkIsopointGrid
{
  double Origin[3];
  double Spacing[3];
  int Extent[6]; // from 0
};

/// Finds an image that fills bounds.
/// @param bounds least and greatest x, y and z
/// @param dimensions numbers of points along the axes; 0: as many as the spacing needs, so that the
/// image may end beyond the bounds. Axes without length get one.
/// @param spacing distances of points; 0: the longest side divided by 99
/// @throws isopoint::UsageError unless bounds ascend and numbers are not negative
vtkIsopointGrid vtkFindIsopointGrid(
  const double bounds[6], const int dimensions[3], const double spacing[3]);

/// Makes a part of an image, without arrays.
/// @throws isopoint::UsageError if no memory could hold the points
void vtkMakeIsopointGrid(const vtkIsopointGrid& grid, const int extent[6], vtkImageData* output);

/// Adds `count` tuples of an array, or the array itself if it has no more.
/// @param attribute a vtkDataSetAttributes::AttributeTypes that the array becomes, or -1
/// @throws std::bad_alloc
void vtkAddIsopointTuples(vtkAbstractArray* all, vtkIdType first, vtkIdType count, int attribute,
  vtkDataSetAttributes* output);

/// Adds an array of char: 0 at null points, 1 at others.
/// @param areNull by point
/// @throws std::bad_alloc
void vtkAddIsopointMask(const unsigned char* areNull, const std::string& name, vtkDataSet* output);

#endif
