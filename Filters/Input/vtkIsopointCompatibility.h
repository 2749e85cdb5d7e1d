// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * All differences between the supported versions of VTK (9.1 and later).
 */
#ifndef vtkIsopointCompatibility_h
#define vtkIsopointCompatibility_h

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkSMPTools.h"
#include "vtkUniformGrid.h"
#include "vtkUniformGridAMR.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVersionMacros.h"

#include <type_traits>
#include <utility>
#include <vector>

/**
 * Whether an abort was requested of a filter or, if this version of VTK propagates that, of an
 * algorithm downstream.
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
 * The number of threads that was passed to vtkSMPTools::Initialize(), 0 if it was not called.
 */
inline int vtkGetRequestedSMPThreads()
{
  return vtk::detail::smp::vtkSMPToolsAPI::GetInstance().GetInternalDesiredNumberOfThread();
}

/**
 * Gives an AMR this many grids in each level.
 */
inline void vtkInitializeLevels(vtkUniformGridAMR* amr, const std::vector<unsigned int>& grids)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
  amr->Initialize(grids);
#else
  amr->Initialize(
    static_cast<int>(grids.size()), std::vector<int>(grids.begin(), grids.end()).data());
#endif
}

/**
 * The number of grids of a level of an AMR, and one of them, null or not.
 */
inline unsigned int vtkCountGridsOfLevel(vtkUniformGridAMR* amr, unsigned int level)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
  return amr->GetNumberOfBlocks(level);
#else
  return amr->GetNumberOfDataSets(level);
#endif
}
inline vtkDataSet* vtkGetGridOfLevel(vtkUniformGridAMR* amr, unsigned int level, unsigned int grid)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
  return amr->GetDataSetAsCartesianGrid(level, grid);
#else
  return amr->GetDataSet(level, grid);
#endif
}

/**
 * The type of each cell.
 */
inline vtkDataArray* vtkGetTypesOfCells(vtkUnstructuredGrid* grid)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
  return grid->GetCellTypes();
#else
  return grid->GetCellTypesArray();
#endif
}

/// Whether a grid stores the faces of its polyhedra in cell arrays, as from VTK 9.4 on. Derived
/// from the class, since development versions of 9.3 differ.
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
 * The faces of the polyhedra of an unstructured grid, and their locations for each cell: two
 * vtkCellArray or, before VTK 9.4, two vtkIdTypeArray; null if it has none.
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
