// SPDX-License-Identifier: GPL-3.0-or-later
#include "pqIsopointVisibility.h"

#include "pqApplicationCore.h"
#include "pqDataRepresentation.h"
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
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"

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

void pqIsopointVisibility::startup()
{
  pqServerManagerModel* const model = pqApplicationCore::instance()->getServerManagerModel();
  this->Following = std::make_unique<QObject>();
  QObject::connect(model, &pqServerManagerModel::modifiedStateChanged, this->Following.get(),
    [this](pqServerManagerModelItem* item) { this->follow(item); });
  QObject::connect(model, &pqServerManagerModel::preItemRemoved, this->Following.get(),
    [this](pqServerManagerModelItem* item) { this->NewItems.remove(item); });
}

void pqIsopointVisibility::shutdown()
{
  this->Following.reset();
}

void pqIsopointVisibility::follow(pqServerManagerModelItem* item)
{
  auto* const proxy = qobject_cast<pqProxy*>(item);
  if (!proxy)
  {
    return;
  }
  if (proxy->modifiedState() == pqProxy::UNINITIALIZED)
  {
    this->NewItems.insert(item);
  }
  else if (this->NewItems.remove(item) && proxy->modifiedState() == pqProxy::UNMODIFIED)
  {
    if (auto* const filter = qobject_cast<pqPipelineFilter*>(item))
    {
      hideSplatsBehind(filter);
      explainEmptySlice(filter);
    }
  }
}

void pqIsopointVisibility::hideSplatsBehind(pqPipelineFilter* filter)
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

void pqIsopointVisibility::explainEmptySlice(pqPipelineFilter* filter)
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
