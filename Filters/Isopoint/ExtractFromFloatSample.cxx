// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/ExtractFromCloud.h"

namespace isopoint
{

template ExtractedIsosurface extractFromCloud<FloatSample>(const Execution& execution,
  SampleCloud<FloatSample>& cloud, std::size_t itemCount, Team* team,
  const ExtractionRequest& request, ExtractedIsosurface* ghosts);

} // namespace isopoint
