// SPDX-License-Identifier: GPL-3.0-or-later
/// All differences between the supported versions of VTK (9.1 and later).
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

#include <type_traits>
#include <utility>

/// Calls the first of two functions that compiles for an object's class. Version numbers do not
/// suffice: ParaView ships development versions of VTK.
/// @param newer a generic lambda on the pointer; its return type is that of the call
template <class TObject, class TNewer, class TOlder>
decltype(auto) vtkCallNewer(TObject* object, const TNewer& newer, const TOlder& older)
{
  if constexpr (std::is_invocable_v<TNewer, TObject*>)
  {
    return newer(object);
  }
  else
  {
    return older(object);
  }
}

/// Whether an abort was requested for a filter or, if VTK propagates aborts, downstream of it.
inline bool vtkIsAborted(vtkAlgorithm* filter)
{
  return vtkCallNewer(
    filter, [](auto* any) -> decltype(any->CheckAbort()) { return any->CheckAbort(); },
    [](auto* any) { return any->GetAbortExecute() != 0; });
}

/// The number of threads passed to vtkSMPTools::Initialize(), 0 if it was not called.
inline int vtkGetRequestedSMPThreads()
{
  return vtk::detail::smp::vtkSMPToolsAPI::GetInstance().GetInternalDesiredNumberOfThread();
}

/// The number of grids in a level of an AMR, and one of them or null.
inline unsigned int vtkCountGridsOfLevel(vtkUniformGridAMR* amr, unsigned int level)
{
  return vtkCallNewer(
    amr,
    [&](auto* any) -> decltype(any->GetNumberOfBlocks(level))
    { return any->GetNumberOfBlocks(level); },
    [&](auto* any) { return any->GetNumberOfDataSets(level); });
}
inline vtkDataSet* vtkGetGridOfLevel(vtkUniformGridAMR* amr, unsigned int level, unsigned int grid)
{
  return vtkCallNewer(
    amr,
    [&](auto* any) -> decltype(any->GetDataSetAsCartesianGrid(level, grid))
    { return any->GetDataSetAsCartesianGrid(level, grid); },
    [&](auto* any) { return any->GetDataSet(level, grid); });
}

/// The type of each cell.
inline vtkDataArray* vtkGetTypesOfCells(vtkUnstructuredGrid* grid)
{
  return vtkCallNewer(
    grid, [](auto* any) -> decltype(any->GetCellTypes()) { return any->GetCellTypes(); },
    [](auto* any) { return any->GetCellTypesArray(); });
}

/// The faces of the polyhedra of an unstructured grid, and their locations for each cell: two
/// vtkCellArray or, before VTK 9.4, two vtkIdTypeArray. Null if there are none.
inline auto vtkGetFacesOfPolyhedra(vtkUnstructuredGrid* grid)
{
  return vtkCallNewer(
    grid,
    [](auto* any) -> decltype(std::make_pair(
                    any->GetPolyhedronFaces(), any->GetPolyhedronFaceLocations()))
    { return std::make_pair(any->GetPolyhedronFaces(), any->GetPolyhedronFaceLocations()); },
    [](auto* any) { return std::make_pair(any->GetFaces(), any->GetFaceLocations()); });
}

#endif
