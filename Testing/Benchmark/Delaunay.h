// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef Delaunay_h
#define Delaunay_h

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <vector>

/// CGAL's Delaunay triangulation of a cloud, and the points on those of its edges that cross the
/// isovalue, found in one pass over the cells. The triangulation runs on TBB's threads if
/// `parallel`; the pass runs on one.
vtkSmartPointer<vtkPolyData> contourDelaunay(vtkPolyData* cloud, double isovalue, bool parallel);

/// The ids of its four corners.
using Tetrahedron = std::array<vtkIdType, 4>;

/// The finite cells of CGAL's Delaunay triangulation of a cloud, computed on one thread.
std::vector<Tetrahedron> tetrahedra(vtkPolyData* cloud);

#endif
