// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointTracedCompatibility_h
#define vtkIsopointTracedCompatibility_h

#include "vtkVersionMacros.h"

// The mapper of composite data with attributes of blocks: vtkCompositePolyDataMapper from VTK 9.3
// on.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
#include "vtkCompositePolyDataMapper.h"
using vtkIsopointTracedCompositeMapper = vtkCompositePolyDataMapper;
#else
#include "vtkCompositePolyDataMapper2.h"
using vtkIsopointTracedCompositeMapper = vtkCompositePolyDataMapper2;
#endif

/// The attributes of a mapper's blocks; null where it has none.
inline vtkCompositeDataDisplayAttributes* vtkIsopointTracedBlockAttributes(vtkMapper* mapper)
{
  const auto composite = vtkIsopointTracedCompositeMapper::SafeDownCast(mapper);
  return composite ? composite->GetCompositeDataDisplayAttributes() : nullptr;
}

#endif
// VTK-HeaderTest-Exclude: vtkIsopointTracedCompatibility.h
