// SPDX-License-Identifier: GPL-3.0-or-later
#include "pqIsopointSelections.h"

#include "pqApplicationCore.h"
#include "pqOutputPort.h"
#include "pqPipelineFilter.h"
#include "pqProxy.h"
#include "pqServerManagerModel.h"

#include "vtkPVDataInformation.h"
#include "vtkSMIsopointRepresentationDomain.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSelectionNode.h"
#include "vtkSmartPointer.h"

#include <QObject>

#include <cstring>
#include <string>

void pqIsopointSelections::startup()
{
  this->Following = std::make_unique<QObject>();
  QObject::connect(pqApplicationCore::instance()->getServerManagerModel(),
    &pqServerManagerModel::modifiedStateChanged, this->Following.get(), &keepVertices);
}

void pqIsopointSelections::shutdown()
{
  this->Following.reset();
}

void pqIsopointSelections::keepVertices(pqServerManagerModelItem* item)
{
  auto* const filter = qobject_cast<pqPipelineFilter*>(item);
  if (!filter || !filter->getAnyInput() || filter->modifiedState() != pqProxy::UNMODIFIED ||
      std::strcmp(filter->getProxy()->GetXMLName(), "ExtractSelection") != 0 ||
      !vtkSMIsopointRepresentationDomain::AreIsopoints(filter->getAnyInput()->getDataInformation()))
  {
    return;
  }
  vtkSMProxy* const selection = vtkSMPropertyHelper(filter->getProxy(), "Selection").GetAsProxy();
  if (!selection || !selection->GetProperty("Input"))
  {
    return; // nothing is selected
  }
  vtkSMPropertyHelper sources(selection, "Input");
  for (unsigned int i = 0; i < sources.GetNumberOfElements(); ++i)
  {
    vtkSMProxy* const source = sources.GetAsProxy(i);
    if (!source || !source->GetProperty("ContainingCells") || !source->GetProperty("FieldType") ||
        vtkSMPropertyHelper(source, "FieldType").GetAsInt() != vtkSelectionNode::POINT ||
        vtkSMPropertyHelper(source, "ContainingCells").GetAsInt() != 0)
    {
      continue;
    }
    // The active selection may have the same source.
    vtkSMSessionProxyManager* const proxies = source->GetSessionProxyManager();
    const auto own = vtkSmartPointer<vtkSMProxy>::Take(
      proxies->NewProxy(source->GetXMLGroup(), source->GetXMLName()));
    own->Copy(source);
    vtkSMPropertyHelper(own, "ContainingCells").Set(1);
    own->UpdateVTKObjects();
    const std::string name = "selection_sources." + std::string(own->GetGlobalIDAsString());
    proxies->RegisterProxy("selection_sources", name.c_str(), own); // so that states contain it
    sources.Set(i, own);
    selection->UpdateVTKObjects();
  }
}
