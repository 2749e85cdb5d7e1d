// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef MarchingTetrahedra_h
#define MarchingTetrahedra_h

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

namespace accuracy
{

/// The isosurface of the linear interpolation on CGAL's Delaunay tetrahedrization of a cloud: its
/// vertices, with the area-weighted means of the normals of their triangles, which point to
/// decreasing values. Runs on one thread.
vtkSmartPointer<vtkPolyData> marchingTetrahedra(vtkPolyData* cloud, double isovalue);

} // namespace accuracy

#endif
