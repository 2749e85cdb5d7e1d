// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef MarchingTetrahedra_h
#define MarchingTetrahedra_h

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

namespace accuracy
{

/// The peer: CGAL's Delaunay tetrahedrisation of a cloud and the isosurface of its linear
/// interpolation, as points with normals, each the mean of its triangles' by area, to falling
/// values. Runs in one thread.
vtkSmartPointer<vtkPolyData> marchingTetrahedra(vtkPolyData* cloud, double isovalue);

} // namespace accuracy

#endif
