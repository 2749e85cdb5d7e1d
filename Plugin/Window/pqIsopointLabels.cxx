// SPDX-License-Identifier: GPL-3.0-or-later
#include "pqIsopointLabels.h"

#include <QGridLayout>
#include <QLabel>
#include <QList>
#include <QWidget>

void pqShowHelpAtLabels(QWidget* panel)
{
  const QList<QGridLayout*> grids = panel->findChildren<QGridLayout*>();
  for (const QGridLayout* const grid : grids)
  {
    for (int row = 0; row < grid->rowCount(); ++row)
    {
      QLayoutItem* const left = grid->itemAtPosition(row, 0);
      QLayoutItem* const right = grid->itemAtPosition(row, 1);
      auto* const label = left ? qobject_cast<QLabel*>(left->widget()) : nullptr;
      if (label && right && right->widget() && right->widget() != label)
      {
        label->setToolTip(right->widget()->toolTip());
      }
    }
  }
}
