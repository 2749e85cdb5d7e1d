// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointPlacement_h
#define vtkIsopointPlacement_h

#include "Isopoint/SplatGeometry.h"
#include "vtkIsopointArrays.h"

#include <vector>

class vtkDataSet;

/**
 * The isopoints of one isovalue in space: positions, and for each the vector along its edge to the
 * end that is below the isovalue, of the edge's length.
 */
struct vtkPlacedIsopoints
{
  std::vector<isopoint::Vector> positions;
  std::vector<isopoint::Vector> fallingEdges;
};

/**
 * Places isopoints on the edges between the data set's points.
 */
vtkPlacedIsopoints vtkPlaceIsopoints(const isopoint::Execution& execution, vtkDataSet* input,
  vtkDataArray* scalars, const vtkContouredIsosurface& contoured);

#endif
