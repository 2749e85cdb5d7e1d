// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointTracedCompatibility_h
#define vtkIsopointTracedCompatibility_h

#include "vtkIdList.h"
#include "vtkPolygon.h"
#include "vtkVersionMacros.h"

#include <type_traits>
#include <utility>

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

template <class TCell, class = void>
struct vtkIsopointTriangulatesLocalIds : std::false_type
{
};
template <class TCell>
struct vtkIsopointTriangulatesLocalIds<TCell,
  std::void_t<decltype(std::declval<TCell&>().TriangulateLocalIds(0, nullptr))>> : std::true_type
{
};

/// Triangulates a polygon; corners are places in it, three for each triangle.
template <class TPolygon>
void vtkIsopointTriangulate(TPolygon* polygon, vtkIdList* corners)
{
  if constexpr (vtkIsopointTriangulatesLocalIds<TPolygon>::value) // VTK 9.4 and later
  {
    polygon->TriangulateLocalIds(0, corners);
  }
  else
  {
    polygon->Triangulate(corners);
  }
}

#endif
// VTK-HeaderTest-Exclude: vtkIsopointTracedCompatibility.h
