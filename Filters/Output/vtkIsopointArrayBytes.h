// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointArrayBytes_h
#define vtkIsopointArrayBytes_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <string>
#include <vector>

class vtkAbstractArray;
class vtkDataSetAttributes;

/**
 * An array of attributes without its values, as ranks describe it to each other.
 */
struct vtkIsopointArrayHeader
{
  std::string Name;
  int Type = 0; // as GetDataType() returns it
  int Components = 1;
  std::vector<std::string> ComponentNames; // as many, or none
  int Attribute = -1;                      // of which it is the active array, if any

  /// Whether two may be arrays of one name: all but the attribute is equal.
  bool HasSameKind(const vtkIsopointArrayHeader& other) const;
};

/**
 * The named arrays with one tuple for each of `count` samples whose values can be sent: numbers and
 * strings.
 */
std::vector<vtkIsopointArrayHeader> vtkListIsopointArrays(
  vtkDataSetAttributes* attributes, vtkIdType count);

/**
 * The headers that all lists have, in the order of the first one; the active array of an attribute
 * if it is that in all of them.
 */
std::vector<vtkIsopointArrayHeader> vtkIntersectIsopointArrays(
  const std::vector<std::vector<vtkIsopointArrayHeader>>& lists);

std::vector<char> vtkWriteIsopointArrayHeaders(const std::vector<vtkIsopointArrayHeader>& headers);
std::vector<vtkIsopointArrayHeader> vtkReadIsopointArrayHeaders(const std::vector<char>& bytes);

/**
 * A new array of this many tuples. @throws std::bad_alloc
 */
vtkSmartPointer<vtkAbstractArray> vtkNewIsopointArray(
  const vtkIsopointArrayHeader& header, vtkIdType tuples);

/**
 * Appends the values of a tuple to bytes.
 */
void vtkWriteIsopointTuple(vtkAbstractArray* array, vtkIdType tuple, std::vector<char>& bytes);

/**
 * Sets a tuple to values that vtkWriteIsopointTuple() wrote for an array of the same type.
 * @returns the place behind them
 */
const char* vtkReadIsopointTuple(const char* bytes, vtkAbstractArray* array, vtkIdType tuple);

#endif
