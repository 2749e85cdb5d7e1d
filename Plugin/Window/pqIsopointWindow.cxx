// SPDX-License-Identifier: GPL-3.0-or-later
#include "pqIsopointWindow.h"

#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"

#include <QObject>
#include <QWidget>

void pqCallWithWindow(QObject* context, const std::function<void()>& function)
{
  const QWidget* const window = pqCoreUtilities::mainWidget();
  if (window && window->isVisible())
  {
    function();
    return;
  }
  QObject::connect(
    pqApplicationCore::instance(), &pqApplicationCore::clientEnvironmentDone, context, function);
}
