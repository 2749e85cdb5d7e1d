// SPDX-License-Identifier: GPL-3.0-or-later
#include "pqIsopointSearch.h"

#include "pqCoreUtilities.h"
#include "pqPVApplicationCore.h"

#include <QAction>
#include <QList>
#include <QObject>

void pqIsopointSearch::startup()
{
  this->Entries = std::make_unique<QWidget>();
  pqPVApplicationCore* const core = pqPVApplicationCore::instance();
  core->registerForQuicklaunch(this->Entries.get());
  QObject::connect(core, &pqPVApplicationCore::aboutToShowQuickLaunch, this->Entries.get(),
    [this]() { this->updateEntries(); });
}

void pqIsopointSearch::shutdown()
{
  this->Entries.reset();
}

void pqIsopointSearch::updateEntries()
{
  const QList<QAction*> former = this->Entries->actions();
  qDeleteAll(former);
  for (const char* const filter : { "ScatteredIsopoints", "ScatteredIsosurface" })
  {
    // Actions in the filter menu are named after their filters.
    if (auto* const action = pqCoreUtilities::mainWidget()->findChild<QAction*>(filter))
    {
      auto* const entry =
        new QAction(action->icon(), action->text() + " (contour)", this->Entries.get());
      entry->setObjectName(action->objectName() + "Contour"); // the search needs distinct names
      entry->setEnabled(action->isEnabled());
      entry->setData(action->data());
      QObject::connect(entry, &QAction::triggered, action, &QAction::trigger);
      this->Entries->addAction(entry);
    }
  }
}
