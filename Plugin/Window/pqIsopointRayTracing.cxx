// SPDX-License-Identifier: GPL-3.0-or-later
#include "pqIsopointRayTracing.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqFileDialog.h"
#include "pqIsopointLabels.h"
#include "pqIsopointWindow.h"
#include "pqProgressManager.h"
#include "pqProxyWidgetDialog.h"
#include "pqRenderView.h"
#include "pqRepresentation.h"
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
#include <QCoreApplication>
#include <QEventLoop>
#include <QList>
#include <QMenu>
#include <QPointer>
#include <QProgressBar>
#include <QProgressDialog>
#include <QPushButton>
#include <QString>

#include <algorithm>
#include <cmath>

namespace
{

/// Whether a view shows anything that can be traced.
bool showsSomething(pqView* view)
{
  if (!qobject_cast<pqRenderView*>(view))
  {
    return false;
  }
  const QList<pqRepresentation*> all = view->getRepresentations();
  return std::any_of(
    all.begin(), all.end(), [](pqRepresentation* each) { return each->isVisible(); });
}

/// Processes only user input while ParaView draws, so that the dialog's buttons work. Timers and
/// messages of a server must wait: they may change the scene.
void processInput()
{
  pqProgressManager* const progress = pqApplicationCore::instance()->getProgressManager();
  const bool before = progress->unblockEvents(true); // otherwise it drops mouse events
  QCoreApplication::processEvents(
    QEventLoop::ExcludeSocketNotifiers | QEventLoop::X11ExcludeTimers);
  progress->unblockEvents(before);
}

/// Asks for a file and options, and traces the active view.
void exportActiveView()
{
  const QPointer<pqView> view = pqActiveObjects::instance().activeView();
  if (!showsSomething(view))
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
  pqShowHelpAtLabels(&options);
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
  this->Waiting = std::make_unique<QObject>();
  pqCallWithWindow(this->Waiting.get(), [this]() { this->addMenuEntry(); });
}

void pqIsopointRayTracing::shutdown()
{
  vtkIsopointRayTracingExporter::SetMonitor(nullptr);
  this->Waiting.reset();
  delete this->Entry;
}

void pqIsopointRayTracing::addMenuEntry()
{
  auto* const menu = pqCoreUtilities::mainWidget()->findChild<QMenu*>("menu_File");
  if (!menu)
  {
    return;
  }
  auto* const entry = new QAction("Export Ray-Traced Picture...", menu);
  entry->setObjectName("actionExportRayTracedPicture");
  entry->setToolTip("Write the view as a ray-traced PNG picture, with shadows and reflections.");
  QObject::connect(entry, &QAction::triggered, entry, &exportActiveView);
  QObject::connect(menu, &QMenu::aboutToShow, entry,
    [entry]() { entry->setEnabled(showsSomething(pqActiveObjects::instance().activeView())); });
  QAction* behind = nullptr; // the entry for other exports
  const QList<QAction*> actions = menu->actions();
  for (int i = 0; i + 1 < actions.size(); ++i)
  {
    if (actions[i]->objectName() == "actionExport")
    {
      behind = actions[i + 1];
    }
  }
  menu->insertAction(behind, entry);
  this->Entry = entry;
}

bool pqIsopointRayTracing::show(double share)
{
  if (share >= 1.0)
  {
    this->Dialog.reset();
    return true;
  }
  if (!this->Dialog)
  {
    this->Dialog = std::make_unique<QProgressDialog>(
      "Tracing rays...", QString(), 0, 100, pqCoreUtilities::mainWidget());
    this->Dialog->setObjectName("RayTracingProgress");
    this->Dialog->setCancelButton(new QPushButton("Stop"));
    this->Bar = new QProgressBar; // setValue() of the dialog, unlike this, processes events
    this->Dialog->setBar(this->Bar);
    this->Dialog->setWindowTitle("Ray Tracing");
    this->Dialog->setWindowModality(Qt::ApplicationModal);
    this->Dialog->show();
  }
  this->Bar->setValue(static_cast<int>(std::floor(100 * share)));
  processInput();
  return !this->Dialog->wasCanceled();
}
