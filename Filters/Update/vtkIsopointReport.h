// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointReport_h
#define vtkIsopointReport_h

#include "Core/Report.h"

#include <set>
#include <string>
#include <vector>

/**
 * What an update found out that its user may have to know: what the core counts, and what concerns
 * VTK alone.
 */
struct vtkIsopointReport
{
  isopoint::Report Counts;
  std::set<std::string> ReplacedArrays; // input arrays with the name of a computed one
  bool IsPieceOfProcess = false;        // whether processes without a controller yield pieces

  /// A message for each cause. @throws std::bad_alloc
  std::vector<isopoint::Message> Describe() const;
};

#endif
