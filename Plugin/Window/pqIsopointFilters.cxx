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

#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkOutputWindow.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMIsopointRepresentationDomain.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"
#include "vtkSelectionNode.h"
#include "vtkSmartPointer.h"

#include <QList>
#include <QObject>

#include <algorithm>
#include <cstring>
#include <map>
#include <string>

namespace
{

bool isOpaqueSplats(pqDataRepresentation* representation)
{
  vtkSMProxy* const proxy = representation->getProxy();
  const char* const type = vtkSMPropertyHelper(proxy, "Representation", true).GetAsString();
  return type && std::strcmp(type, vtkSMIsopointRepresentationDomain::Splats) == 0 &&
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
    keepColor(filter);
    explainEmptyResult(filter);
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

void pqIsopointFilters::keepColor(pqPipelineFilter* filter)
{
  if (std::strcmp(filter->getProxy()->GetXMLName(), "ScatteredGrid") != 0)
  {
    return;
  }
  pqOutputPort* const input = filter->getAnyInput();
  const QList<pqView*> views = filter->getViews();
  for (pqView* const view : views)
  {
    pqDataRepresentation* const own = filter->getRepresentation(view);
    pqDataRepresentation* const former = input ? input->getRepresentation(view) : nullptr;
    if (!own || !former || !own->getProxy()->GetProperty("ColorArrayName") ||
        !former->getProxy()->GetProperty("ColorArrayName"))
    {
      continue;
    }
    vtkSMPropertyHelper color(former->getProxy(), "ColorArrayName");
    const char* const name = color.GetInputArrayNameToProcess();
    if (name && name[0] && color.GetInputArrayAssociation() == vtkDataObject::CELL &&
        filter->getOutputPort(0)->getDataInformation()->GetArrayInformation(
          name, vtkDataObject::POINT))
    {
      vtkSMPropertyHelper(own->getProxy(), "ColorArrayName")
        .SetInputArrayToProcess(vtkDataObject::POINT, name);
      own->getProxy()
        ->GetProperty("LookupTable")
        ->Copy(former->getProxy()->GetProperty("LookupTable"));
      own->getProxy()->UpdateVTKObjects();
      view->render();
    }
  }
}

namespace
{

/// Whether points have an array whose components are all 0. Since ParaView 6 hidden points do not
/// count: the range of an array is empty if all are hidden.
bool isZero(vtkPVDataInformation* data, const std::string& name)
{
  vtkPVArrayInformation* const array =
    data->GetArrayInformation(name.c_str(), vtkDataObject::POINT);
  bool isZero = array != nullptr;
  for (int i = 0; isZero && i < array->GetNumberOfComponents(); ++i)
  {
    double range[2];
    array->GetComponentFiniteRange(i, range);
    isZero = range[0] >= 0.0 && range[1] <= 0.0;
  }
  return isZero;
}

/// Whether the output of a filter that needs cells shows that there were none.
bool isWithoutCells(pqPipelineFilter* filter)
{
  vtkPVDataInformation* const output = filter->getOutputPort(0)->getDataInformation();
  vtkSMProxy* const proxy = filter->getProxy();
  const std::string gradient = proxy->GetProperty("ResultArrayName")
                                 ? vtkSMPropertyHelper(proxy, "ResultArrayName").GetAsString()
                                 : "";
  return output->GetNumberOfPoints() == 0 || isZero(output, "vtkValidPointMask") ||
         (!gradient.empty() && isZero(output, gradient));
}

/// Whether data are points, perhaps with vertices. Only a guess: meshes may have as many cells.
bool mayBePoints(vtkPVDataInformation* data)
{
  const auto cells = data->GetNumberOfCells();
  return data->GetNumberOfPoints() > 0 && !data->IsDataStructured() &&
         (cells <= 1 || cells == data->GetNumberOfPoints());
}

} // namespace

void pqIsopointFilters::explainEmptyResult(pqPipelineFilter* filter)
{
  // Filters of cells, and what to use for points.
  static const std::map<std::string, std::string> filtersOfPoints{ { "Contour",
                                                                     "Scattered Isosurface" },
    { "Cut", "Scattered Slice" }, { "SliceWithPlane", "Scattered Slice" },
    { "SliceAlongPolyLine", "Scattered Probe" }, { "Gradient", "Scattered Gradient" },
    { "ProbeLine", "Scattered Line" }, { "ResampleToLine", "Scattered Line" },
    { "ResampleToImage", "Scattered Grid" }, { "ResampleWithDataset", "Scattered Probe" } };
  const auto found = filtersOfPoints.find(filter->getProxy()->GetXMLName());
  if (found == filtersOfPoints.end() || !isWithoutCells(filter))
  {
    return;
  }
  const QList<pqOutputPort*> inputs = filter->getAllInputs();
  const auto isAny = [&](auto has)
  {
    return std::any_of(inputs.begin(), inputs.end(),
      [&](pqOutputPort* input) { return has(input->getDataInformation()); });
  };
  const std::string label = filter->getProxy()->GetXMLLabel();
  std::string message;
  if (isAny(vtkSMIsopointRepresentationDomain::AreIsopoints))
  {
    message = label + " yields nothing from isopoints, which are no mesh."
                      " Apply it to the triangles of Scattered Isosurface instead.\n";
  }
  else if (isAny(mayBePoints))
  {
    message =
      label + " yields nothing from points without a mesh. Apply " + found->second + " instead.\n";
  }
  if (!message.empty())
  {
    vtkOutputWindowDisplayWarningText(message.c_str());
  }
}
