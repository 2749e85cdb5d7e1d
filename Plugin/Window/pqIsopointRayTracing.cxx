// SPDX-License-Identifier: GPL-3.0-or-later
#include "pqIsopointRayTracing.h"

#include "pqActiveObjects.h"
#include "pqCoreUtilities.h"
#include "pqFileDialog.h"
#include "pqProxyWidgetDialog.h"
#include "pqRenderView.h"
#include "vtkIsopointRayTracingExporter.h"

#include "vtkNew.h"
#include "vtkSMExporterProxy.h"
#include "vtkSMParaViewPipelineController.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMTrace.h"
#include "vtkSMViewProxy.h"
#include "vtkSmartPointer.h"

#include <QAction>
#include <QEventLoop>
#include <QList>
#include <QMenu>
#include <QPointer>
#include <QProgressDialog>
#include <QPushButton>
#include <QString>
#include <QTimer>

#include <cmath>

namespace
{

/// Asks for a file and for options, and traces the active view.
void exportActiveView()
{
  const QPointer<pqView> view = pqActiveObjects::instance().activeView();
  if (!qobject_cast<pqRenderView*>(view))
  {
    return;
  }
  QWidget* const window = pqCoreUtilities::mainWidget();
  pqFileDialog files(
    nullptr, window, "Export Ray-Traced Picture", QString(), "PNG picture (*.png)");
  files.setObjectName("FileExportDialog");
  files.setFileMode(pqFileDialog::AnyFile);
  if (files.exec() != QDialog::Accepted || files.getSelectedFiles().empty() || !view)
  {
    return;
  }
  vtkSMViewProxy* const viewProxy = view->getViewProxy();
  const auto exporter = vtkSmartPointer<vtkSMExporterProxy>::Take(vtkSMExporterProxy::SafeDownCast(
    viewProxy->GetSessionProxyManager()->NewProxy("exporters", "IsopointRayTracingExporter")));
  const QByteArray file = files.getSelectedFiles().first().toUtf8();
  vtkNew<vtkSMParaViewPipelineController> controller;
  controller->PreInitializeProxy(exporter);
  exporter->SetView(viewProxy);
  vtkSMPropertyHelper(exporter, "FileName").Set(file.data());
  controller->PostInitializeProxy(exporter);
  exporter->UpdateVTKObjects();

  pqProxyWidgetDialog options(exporter, window);
  options.setObjectName("RayTracingOptions");
  options.setWindowTitle("Export Ray-Traced Picture");
  options.setApplyChangesImmediately(true);
  if (options.exec() == QDialog::Accepted)
  {
    SM_SCOPED_TRACE(ExportView)
      .arg("view", viewProxy)
      .arg("exporter", exporter)
      .arg("filename", file.data());
    exporter->Write();
  }
}

} // namespace

pqIsopointRayTracing::pqIsopointRayTracing() = default;
pqIsopointRayTracing::~pqIsopointRayTracing() = default;

void pqIsopointRayTracing::startup()
{
  vtkIsopointRayTracingExporter::SetMonitor([this](double share) { return this->show(share); });
  this->addMenuEntry();
}

void pqIsopointRayTracing::shutdown()
{
  vtkIsopointRayTracingExporter::SetMonitor(nullptr);
  this->Entry.reset();
}

void pqIsopointRayTracing::addMenuEntry()
{
  auto* const menu = pqCoreUtilities::mainWidget()->findChild<QMenu*>("menu_File");
  if (!menu)
  {
    return;
  }
  auto entry = std::make_unique<QAction>("Export Ray-Traced Picture...");
  entry->setObjectName("actionExportRayTracedPicture");
  entry->setToolTip("Write the view as a ray-traced PNG picture, with shadows and reflections.");
  QObject::connect(entry.get(), &QAction::triggered, entry.get(), &exportActiveView);
  QAction* behind = nullptr; // the entry for other exports
  const QList<QAction*> actions = menu->actions();
  for (int i = 0; i + 1 < actions.size(); ++i)
  {
    if (actions[i]->objectName() == "actionExport")
    {
      behind = actions[i + 1];
    }
  }
  menu->insertAction(behind, entry.get());
  this->Entry = std::move(entry);
}

bool pqIsopointRayTracing::show(double share)
{
  if (share >= 1.0)
  {
    this->Dialog.reset();
    return true;
  }
  constexpr int all = 100;
  if (!this->Dialog)
  {
    this->Dialog = std::make_unique<QProgressDialog>(
      "Tracing rays...", QString(), 0, all, pqCoreUtilities::mainWidget());
    this->Dialog->setObjectName("RayTracingProgress");
    auto* const stop = new QPushButton("Stop");
    stop->setObjectName("Stop");
    this->Dialog->setCancelButton(stop);
    this->Dialog->setWindowTitle("Export Ray-Traced Picture");
    this->Dialog->setWindowModality(Qt::ApplicationModal);
    this->Dialog->setAutoReset(false);
    this->Dialog->setAutoClose(false);
    this->Dialog->show();
  }
  this->Dialog->setValue(static_cast<int>(std::floor(all * share)));
  QEventLoop events; // of the button too
  QTimer::singleShot(1, &events, &QEventLoop::quit);
  events.exec();
  return !this->Dialog->wasCanceled();
}
