// SPDX-License-Identifier: GPL-3.0-or-later
#include "pqIsopointSearch.h"

#include "pqCoreUtilities.h"
#include "pqIsopointWindow.h"
#include "pqPVApplicationCore.h"

#include <QAction>
#include <QList>
#include <QObject>
#include <QString>

#include <utility>

void pqIsopointSearch::startup()
{
  this->Entries = std::make_unique<QWidget>();
  pqCallWithWindow(this->Entries.get(), [this]() { this->registerEntries(); });
}

void pqIsopointSearch::shutdown()
{
  this->Entries.reset();
}

void pqIsopointSearch::registerEntries()
{
  pqPVApplicationCore* const core = pqPVApplicationCore::instance();
  core->registerForQuicklaunch(this->Entries.get());
  QObject::connect(core, &pqPVApplicationCore::aboutToShowQuickLaunch, this->Entries.get(),
    [this]() { this->updateEntries(); });
}

void pqIsopointSearch::updateEntries()
{
  const QList<QAction*> former = this->Entries->actions();
  qDeleteAll(former);
  const std::pair<const char*, const char*> names[] = {
    { "ScatteredIsopoints", "Contour samples as points" },
    { "ScatteredIsosurface", "Contour samples as triangles" },
    // Texts that begin with the words come first, in the order of their characters.
    { "ScatteredIsosurface", "Surface (isosurface) of a cloud of samples" },
    { "ScatteredGrid", "Resample samples to an image" },
    { "ScatteredGrid", "Streamlines of samples, by an image" },
    { "ScatteredProbe", "Resample samples with a data set" },
    { "ScatteredLine", "Plot samples over a line" },
    { "ScatteredSlice", "Cut samples by a plane" },
    { "ScatteredGradient", "Derivatives of samples" },
    { "ScatteredGradient", "Vorticity of samples" },
    { "ScatteredBody", "Surface of particles" },
  };
  for (const auto& [filter, name] : names)
  {
    // Actions in the filter menu are named after their filters.
    if (auto* const action = pqCoreUtilities::mainWidget()->findChild<QAction*>(filter))
    {
      auto* const entry = new QAction(action->icon(), name, this->Entries.get());
      // The search needs distinct names.
      entry->setObjectName(
        action->objectName() + "Entry" + QString::number(this->Entries->actions().size()));
      entry->setEnabled(action->isEnabled());
      entry->setData(action->data());
      QObject::connect(entry, &QAction::triggered, action, &QAction::trigger);
      this->Entries->addAction(entry);
    }
  }
}
