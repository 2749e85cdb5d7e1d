// SPDX-License-Identifier: GPL-3.0-or-later
#include "pqIsopointTooltips.h"

#include <QCoreApplication>
#include <QCursor>
#include <QEvent>
#include <QLabel>
#include <QPoint>
#include <QRegularExpression>
#include <QString>

namespace
{

/// Shortens the text of a tooltip before it is painted.
class TooltipFilter : public QObject
{
public:
  bool eventFilter(QObject* object, QEvent* event) override
  {
    const bool mayHaveText = event->type() == QEvent::Show || event->type() == QEvent::Resize;
    if (mayHaveText && object->inherits("QTipLabel"))
    {
      static const QRegularExpression lines("\n *Splat(Axis|Polygon): \\([^)]*\\)");
      auto* const tip = static_cast<QLabel*>(object);
      QString text = tip->text();
      text.remove(lines);
      if (text != tip->text())
      {
        tip->setText(text);
        tip->resize(tip->sizeHint());
        constexpr int height = 16; // of a pointer
        tip->move(QCursor::pos() + QPoint(0, height));
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
