// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredIsopointFilter.h"

#include "Update/vtkIsopointContouring.h"
#include "Update/vtkIsopointOptions.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <vector>

vtkStandardNewMacro(vtkScatteredIsopointFilter);

vtkScatteredIsopointFilter::vtkScatteredIsopointFilter()
{
  this->SetProgressText("Scattered Isopoints"); // as in ParaView's menu
}

// Not clamped: an angle out of range is an error in the next update.
void vtkScatteredIsopointFilter::SetAngle(double degrees)
{
  if (this->Options->Core.angle != degrees)
  {
    this->Options->Core.angle = degrees;
    this->Modified();
  }
}

double vtkScatteredIsopointFilter::GetAngle()
{
  return this->Options->Core.angle;
}

vtkIsopointOptionMacro(
  vtkScatteredIsopointFilter, NumberOfNeighbors, int, isopoint::option::numberOfNeighbors);
vtkIsopointOptionMacro(
  vtkScatteredIsopointFilter, ComputeSplats, vtkTypeBool, isopoint::option::computeSplats);

vtkTypeBool vtkScatteredIsopointFilter::AreSplatsApart()
{
  const std::vector<isopoint::Message> messages =
    isopoint::describeReport(this->GetReport(), &isopoint::sameName);
  const bool areApart = std::any_of(messages.begin(), messages.end(),
    [](const isopoint::Message& message)
    { return message.code == isopoint::Message::SplatsApart; });
  return areApart ? 1 : 0;
}
