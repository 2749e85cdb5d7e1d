// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_ExtentQuery_h
#define isopoint_ExtentQuery_h

#include "Isopoint/Base/Vector.h"

#include <functional>

namespace isopoint
{

/// How far samples are looked for ahead of a place on a surface.
struct ExtentQuery
{
  Vector place;
  Vector normal;    // of the surface there
  Vector direction; // across it, of length 1
  double enough;    // the largest result that is of interest, positive
  double reach;     // of the samples that count from the place, above `enough`, finite
};

/// What answers such a query of one cloud; from any thread.
using SampleExtents = std::function<double(const ExtentQuery&)>;

} // namespace isopoint

#endif
