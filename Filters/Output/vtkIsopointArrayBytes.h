// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointArrayBytes_h
#define vtkIsopointArrayBytes_h

#include "Core/Ranks/ByteBuffer.h"

#include "vtkSmartPointer.h"

class vtkDataSetAttributes;
class vtkPointData;

/**
 * Arrays as ranks send them to each other: the named ones of numbers or strings, and the last one
 * in any case. Global ids and ghost arrays are left out.
 */
isopoint::ByteBuffer vtkWriteIsopointArrays(vtkDataSetAttributes* attributes);

/**
 * What vtkWriteIsopointArrays() wrote: arrays with their names, those of their components, and what
 * attributes they are.
 * @throws std::bad_alloc
 */
vtkSmartPointer<vtkPointData> vtkReadIsopointArrays(const isopoint::ByteBuffer& bytes);

#endif
