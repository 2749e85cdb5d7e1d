// SPDX-License-Identifier: GPL-3.0-or-later
#include "Update/vtkIsopointReport.h"

std::vector<isopoint::Message> vtkIsopointReport::Describe() const
{
  std::vector<isopoint::Message> messages = isopoint::describeReport(this->Counts);
  if (this->IsPieceOfProcess)
  {
    messages.push_back({ "pieces of processes",
      "Each process yields a piece of the surface of its own samples. If the processes have"
      " different samples, call SetController() with the global controller." });
  }
  for (const std::string& name : this->ReplacedArrays)
  {
    messages.push_back({ "replaced array " + name,
      "The computed array \"" + name +
        "\" replaces the input array of this name. To keep that, rename it or switch the computed"
        " array off." });
  }
  return messages;
}
