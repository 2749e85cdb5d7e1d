// SPDX-License-Identifier: GPL-3.0-or-later
#include "pqIsopointFilters.h"

#include "pqApplicationCore.h"
#include "pqDataRepresentation.h"
#include "pqIsopointWindow.h"
#include "pqOutputPort.h"
#include "pqPipelineFilter.h"
#include "pqProxy.h"
#include "pqServerManagerModel.h"
#include "pqView.h"

#include "vtkNew.h"
#include "vtkOutputWindow.h"
#include "vtkPVDataInformation.h"
#include "vtkSMIsopointRepresentationDomain.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"
#include "vtkSelectionNode.h"
#include "vtkSmartPointer.h"

#include <QList>
#include <QObject>
#include <QStringList>

#include <algorithm>
#include <cstring>
#include <string>

namespace
{

bool isOpaqueSplats(pqDataRepresentation* representation)
{
  vtkSMProxy* const proxy = representation->getProxy();
  const char* const type = vtkSMPropertyHelper(proxy, "Representation", true).GetAsString();
  return type && std::strcmp(type, "Isopoint Splats") == 0 &&
         vtkSMPropertyHelper(proxy, "Opacity", true).GetAsDouble() >= 1.0;
}

} // namespace

void pqIsopointFilters::startup()
{
  this->Following = std::make_unique<QObject>();
  pqCallWithWindow(this->Following.get(), [this]() { this->followPipeline(); });
}

void pqIsopointFilters::followPipeline()
{
  pqServerManagerModel* const model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::modifiedStateChanged, this->Following.get(),
    [this](pqServerManagerModelItem* item) { this->follow(item); });
  QObject::connect(model, &pqServerManagerModel::preItemRemoved, this->Following.get(),
    [this](pqServerManagerModelItem* item) { this->NewItems.remove(item); });
}

void pqIsopointFilters::shutdown()
{
  this->Following.reset();
}

void pqIsopointFilters::follow(pqServerManagerModelItem* item)
{
  auto* const filter = qobject_cast<pqPipelineFilter*>(item);
  if (!filter)
  {
    return;
  }
  if (filter->modifiedState() == pqProxy::UNINITIALIZED)
  {
    this->NewItems.insert(item);
    return;
  }
  const bool isNew = this->NewItems.remove(item);
  if (filter->modifiedState() != pqProxy::UNMODIFIED)
  {
    return;
  }
  keepVertices(filter);
  if (isNew)
  {
    hideSplatsBehind(filter);
    explainEmptySlice(filter);
  }
}

void pqIsopointFilters::keepVertices(pqPipelineFilter* filter)
{
  if (!filter->getAnyInput() ||
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

void pqIsopointFilters::hideSplatsBehind(pqPipelineFilter* filter)
{
  if (filter->replaceInput() == 0)
  {
    return;
  }
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  const QList<pqOutputPort*> inputs = filter->getAllInputs();
  const QList<pqView*> views = filter->getViews();
  for (pqView* const view : views)
  {
    pqDataRepresentation* const own = filter->getRepresentation(view);
    for (pqOutputPort* const input : inputs)
    {
      pqDataRepresentation* const behind = input->getRepresentation(view);
      if (own && own->isVisible() && behind && behind->isVisible() && isOpaqueSplats(behind))
      {
        controller->Hide(input->getSourceProxy(), input->getPortNumber(), view->getViewProxy());
      }
    }
  }
}

void pqIsopointFilters::explainEmptySlice(pqPipelineFilter* filter)
{
  static const QStringList filtersOfCells{ "Cut", "SliceWithPlane", "SliceAlongPolyLine",
    "Contour" };
  if (!filtersOfCells.contains(filter->getProxy()->GetXMLName()) ||
      filter->getOutputPort(0)->getDataInformation()->GetNumberOfPoints() > 0)
  {
    return;
  }
  const QList<pqOutputPort*> inputs = filter->getAllInputs();
  if (std::any_of(inputs.begin(), inputs.end(),
        [](pqOutputPort* input)
        { return vtkSMIsopointRepresentationDomain::AreIsopoints(input->getDataInformation()); }))
  {
    const std::string message = std::string(filter->getProxy()->GetXMLLabel()) +
                                " yields nothing from isopoints, which have no cells."
                                " Apply it to the triangles of Scattered Isosurface instead.\n";
    vtkOutputWindowDisplayWarningText(message.c_str());
  }
}
