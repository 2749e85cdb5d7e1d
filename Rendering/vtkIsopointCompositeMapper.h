// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointCompositeMapper_h
#define vtkIsopointCompositeMapper_h

#include "vtkVersionMacros.h"

// The mapper for composite data with block attributes; since VTK 9.3 vtkCompositePolyDataMapper.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
#include "vtkCompositePolyDataMapper.h"
#define vtkIsopointCompositeMapper vtkCompositePolyDataMapper
#else
#include "vtkCompositePolyDataMapper2.h"
#define vtkIsopointCompositeMapper vtkCompositePolyDataMapper2
#endif

#endif
// VTK-HeaderTest-Exclude: vtkIsopointCompositeMapper.h
