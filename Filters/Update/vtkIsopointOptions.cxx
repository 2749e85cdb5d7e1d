// SPDX-License-Identifier: GPL-3.0-or-later
#include "Update/vtkIsopointOptions.h"

#include "Core/Base/Team.h"
#include "Core/Base/UsageError.h"
#include "Input/vtkIsopointBlocks.h"

#include <cstdint>
#include <functional>
#include <ios>
#include <sstream>
#include <string>

void vtkCheckIsopointOptionsOnRanks(isopoint::Team& team, const vtkIsopointOptions& options,
  const std::vector<double>& sortedIsovalues, const vtkIsopointArrayChoice& array)
{
  std::ostringstream text;
  text << std::hexfloat << options.Core.triangles << " " << array.Describe() << " "
       << options.ComputeScalars << " " << options.ContourBlocks;
  for (const double isovalue : sortedIsovalues)
  {
    text << " " << isovalue + 0.0; // 0 and -0 are the same
  }
  isopoint::forEachOption(
    options.Core, [&](const auto& option) { text << " " << options.Core.*option.value + 0.0; });
  const std::uint64_t hash = std::hash<std::string>()(text.str());
  const bool differ = team.maximum(hash) != ~team.maximum(~hash);
  if (differ && team.rank() == 0)
  {
    throw isopoint::UsageError(
      "The filters of the ranks have different options. Set the same on all of them, or contour"
      " each rank's samples separately by setting Controller to null.");
  }
}
