// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef Delaunay_h
#define Delaunay_h

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <vector>

/// The peer: CGAL's Delaunay triangulation of the cloud and the points on its edges that cross the
/// isovalue, found in one pass over the cells. The triangulation runs on TBB's threads if
/// `parallel`; the pass runs in one.
vtkSmartPointer<vtkPolyData> contourDelaunay(vtkPolyData* cloud, double isovalue, bool parallel);

/// Four ids of points.
using Tetrahedron = std::array<vtkIdType, 4>;

/// The finite cells of CGAL's Delaunay triangulation of the cloud, in one thread.
std::vector<Tetrahedron> tetrahedra(vtkPolyData* cloud);

#endif
