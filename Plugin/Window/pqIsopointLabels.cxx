// SPDX-License-Identifier: GPL-3.0-or-later
#include "pqIsopointLabels.h"

#include "pqProxyWidget.h"

#include "vtkSMProxy.h"

#include <QApplication>
#include <QEvent>
#include <QGridLayout>
#include <QLabel>
#include <QString>

namespace
{

bool isOfOurFilter(pqProxyWidget* panel)
{
  return panel && panel->proxy() &&
         QString(panel->proxy()->GetXMLName()).startsWith("ScatteredIso");
}

/// Copies the tool tip of what is to the right of a label in a panel.
void setToolTip(QLabel* label)
{
  auto* const panel = qobject_cast<pqProxyWidget*>(label->parentWidget());
  auto* const grid = panel ? qobject_cast<QGridLayout*>(panel->layout()) : nullptr;
  const int index = grid && isOfOurFilter(panel) ? grid->indexOf(label) : -1;
  if (index < 0)
  {
    return;
  }
  int row = 0;
  int column = 0;
  int rows = 0;
  int columns = 0;
  grid->getItemPosition(index, &row, &column, &rows, &columns);
  QLayoutItem* const item = grid->itemAtPosition(row, column + columns);
  if (item && item->widget() && !item->widget()->toolTip().isEmpty())
  {
    label->setToolTip(item->widget()->toolTip());
  }
}

class Watcher : public QObject
{
public:
  bool eventFilter(QObject* object, QEvent* event) override
  {
    if (event->type() == QEvent::Show)
    {
      if (auto* const label = qobject_cast<QLabel*>(object))
      {
        setToolTip(label);
      }
    }
    return false;
  }
};

} // namespace

void pqIsopointLabels::startup()
{
  this->Watcher = std::make_unique<::Watcher>();
  QApplication::instance()->installEventFilter(this->Watcher.get());
}

void pqIsopointLabels::shutdown()
{
  this->Watcher.reset();
}
