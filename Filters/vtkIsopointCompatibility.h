// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * The one place that knows what differs between the VTK versions supported (9.1 and later).
 */
#ifndef vtkIsopointCompatibility_h
#define vtkIsopointCompatibility_h

#include "vtkAlgorithm.h"
#include "vtkSMPTools.h"
#include "vtkVersionMacros.h"

#include <type_traits>
#include <utility>

/**
 * Whether a filter is to stop: itself, or (where VTK passes that on) an algorithm downstream of it.
 */
inline bool vtkIsAborted(vtkAlgorithm* filter)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220823)
  return filter->CheckAbort();
#else
  return filter->GetAbortExecute() != 0;
#endif
}

/**
 * How many threads vtkSMPTools::Initialize() was called with, 0 if it was not.
 */
inline int vtkGetRequestedSMPThreads()
{
  return vtk::detail::smp::vtkSMPToolsAPI::GetInstance().GetInternalDesiredNumberOfThread();
}

/// Whether a grid keeps the faces of its polyhedra in cell arrays, as from 9.4 on: found from the
/// class itself, since development versions of 9.3 differ.
template <class TGrid, class = void>
struct vtkHasFacesInCellArrays : std::false_type
{
};
template <class TGrid>
struct vtkHasFacesInCellArrays<TGrid,
  std::void_t<decltype(std::declval<TGrid&>().GetPolyhedronFaces())>> : std::true_type
{
};

/**
 * The faces of an unstructured grid's polyhedra and where those of each cell are found: two
 * vtkCellArray or, before 9.4, two vtkIdTypeArray; null where it has none.
 */
template <class TGrid>
auto vtkGetFacesOfPolyhedra(TGrid* grid)
{
  if constexpr (vtkHasFacesInCellArrays<TGrid>::value)
  {
    return std::make_pair(grid->GetPolyhedronFaces(), grid->GetPolyhedronFaceLocations());
  }
  else
  {
    return std::make_pair(grid->GetFaces(), grid->GetFaceLocations());
  }
}

#endif
