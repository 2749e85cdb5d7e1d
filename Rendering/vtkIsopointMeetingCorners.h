// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointMeetingCorners_h
#define vtkIsopointMeetingCorners_h

#include "vtkType.h"
#include "vtkVector.h"

#include <vector>

/// A corner of a splat.
struct vtkIsopointCorner
{
  vtkVector3d Place;
  vtkVector3f Normal;
  float Tolerance = 0.0f; // how far others that are the same may be; 0: there are none
};

/**
 * Which corners are one, up to rounding: those whose places are no farther apart than both of their
 * tolerances, along each axis, and whose normals differ by less than 0.06 degrees.
 * O(n log n), unless tolerances are large against the distances between corners.
 * @returns for each corner the one that stands for all that it is one with, perhaps itself
 * @throws std::bad_alloc
 */
std::vector<vtkIdType> vtkIsopointMeetingCorners(const std::vector<vtkIsopointCorner>& corners);

#endif
// VTK-HeaderTest-Exclude: vtkIsopointMeetingCorners.h
