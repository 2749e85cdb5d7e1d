// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointArrayBytes_h
#define vtkIsopointArrayBytes_h

#include "Core/Ranks/ByteBuffer.h"

#include "vtkSmartPointer.h"

class vtkDataSetAttributes;
class vtkPointData;

/// Serializes arrays for other ranks: named arrays of numbers or strings, and the last array in any
/// case. Omits global ids and ghost arrays.
isopoint::ByteBuffer vtkWriteIsopointArrays(vtkDataSetAttributes* attributes);

/// Deserializes arrays, with their names, component names and attribute types.
/// @throws std::bad_alloc
vtkSmartPointer<vtkPointData> vtkReadIsopointArrays(const isopoint::ByteBuffer& bytes);

#endif
