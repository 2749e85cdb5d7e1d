// SPDX-License-Identifier: GPL-3.0-or-later
#include "pqIsopointSearch.h"

#include "pqCoreUtilities.h"
#include "pqPVApplicationCore.h"

#include <QAction>
#include <QList>
#include <QMenu>
#include <QObject>
#include <QString>

namespace
{

/// The entry of a filter in the window's menus; null if there is none.
QAction* findAction(const QString& filter)
{
  const QList<QMenu*> menus = pqCoreUtilities::mainWidget()->findChildren<QMenu*>();
  for (const QMenu* const menu : menus)
  {
    const QList<QAction*> actions = menu->actions();
    for (QAction* const action : actions)
    {
      if (action->objectName() == filter)
      {
        return action;
      }
    }
  }
  return nullptr;
}

} // namespace

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
    if (QAction* const action = findAction(filter))
    {
      auto* const entry =
        new QAction(action->icon(), "Contour " + action->text(), this->Entries.get());
      entry->setObjectName("Contour" + action->objectName()); // the search tells them apart by it
      entry->setEnabled(action->isEnabled());
      entry->setData(action->data());
      QObject::connect(entry, &QAction::triggered, action, &QAction::trigger);
      this->Entries->addAction(entry);
    }
  }
}
