// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkSMIsopointSourceProxy.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkSMIsopointSourceProxy);

//------------------------------------------------------------------------------
void vtkSMIsopointSourceProxy::PostUpdateData(bool usesCache)
{
  this->Superclass::PostUpdateData(usesCache);
  this->UpdatePropertyInformation();
}
