// SPDX-License-Identifier: GPL-3.0-or-later
#include "pqIsopointTooltips.h"

#include <QCoreApplication>
#include <QCursor>
#include <QEvent>
#include <QLabel>
#include <QRegularExpression>
#include <QString>
#include <QTimer>
#include <QToolTip>

namespace
{

/// Replaces a tooltip as soon as it is shown, or takes another size because of another text.
class TooltipFilter : public QObject
{
public:
  bool eventFilter(QObject* object, QEvent* event) override
  {
    const bool mayHaveText = event->type() == QEvent::Show || event->type() == QEvent::Resize;
    if (mayHaveText && object->inherits("QTipLabel"))
    {
      static const QRegularExpression lines("\n *Splat(Axis|Polygon): \\([^)]*\\)");
      const QString text = static_cast<QLabel*>(object)->text();
      QString without = text;
      without.remove(lines);
      if (without != text)
      {
        // Not within the event: a tip that is not visible yet would be replaced by another one.
        QTimer::singleShot(0, this,
          [text, without]()
          {
            if (QToolTip::isVisible() && QToolTip::text() == text)
            {
              QToolTip::showText(QCursor::pos(), without);
            }
          });
      }
    }
    return QObject::eventFilter(object, event);
  }
};

} // namespace

void pqIsopointTooltips::startup()
{
  this->Filter = std::make_unique<TooltipFilter>();
  QCoreApplication::instance()->installEventFilter(this->Filter.get());
}

void pqIsopointTooltips::shutdown()
{
  this->Filter.reset();
}
