// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointPlacement_h
#define vtkIsopointPlacement_h

#include "Isopoint/Splat/SplatGeometry.h"
#include "vtkIsopointArrays.h"

class vtkDataSet;

/**
 * The isopoints of one isovalue in space: where their fits put them, or else on the edges between
 * the data set's points. Takes the fits over.
 */
isopoint::SurfacePoints vtkPlaceIsopoints(const isopoint::Execution& execution, vtkDataSet* input,
  vtkDataArray* scalars, vtkContouredIsosurface& contoured);

#endif
