// SPDX-License-Identifier: GPL-3.0-or-later
#include "pqIsopointCounts.h"

#include "pqCoreUtilities.h"
#include "pqIsopointLabels.h"

#include "vtkCommand.h"
#include "vtkSMDocumentation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyGroup.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <QFormLayout>
#include <QLabel>
#include <QString>
#include <QTimer>

#include <algorithm>
#include <string>

namespace
{

const std::string wholeSuffix = " of";

bool endsWith(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

} // namespace

pqIsopointCounts::pqIsopointCounts(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent)
  : Superclass(proxy, parent)
{
  auto* const layout = new QFormLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  for (unsigned int i = 0; i < group->GetNumberOfProperties(); ++i)
  {
    vtkSMProperty* const part = group->GetProperty(i);
    const std::string function = group->GetFunction(part);
    if (endsWith(function, wholeSuffix))
    {
      continue;
    }
    vtkSMProperty* const whole = group->GetProperty((function + wholeSuffix).c_str());
    auto* const value = new QLabel(this);
    value->setObjectName(proxy->GetPropertyName(part));
    value->setTextInteractionFlags(Qt::TextSelectableByMouse);
    auto* const label = new QLabel(QString::fromStdString(function), this);
    for (QLabel* const each : { label, value })
    {
      each->setToolTip(QString(part->GetDocumentation()->GetDescription()).simplified());
    }
    layout->addRow(label, value);
    this->Counts.push_back({ label, value, part, whole });
    for (vtkSMProperty* const property : { part, whole })
    {
      if (property)
      {
        pqCoreUtilities::connect(property, vtkCommand::ModifiedEvent, this, SLOT(updateTexts()));
      }
    }
  }
  this->updateTexts();
  // After the panel is complete. The panels of all filters of this plugin contain this group.
  QTimer::singleShot(0, this, [this]() { pqShowHelpAtLabels(this->parentWidget()); });
}

void pqIsopointCounts::updateTexts()
{
  const auto number = [](vtkSMProperty* property)
  { return vtkSMPropertyHelper(property).GetAsIdType(); };
  const bool isUpdated = std::any_of(this->Counts.begin(), this->Counts.end(),
    [&](const Count& count) { return number(count.Whole ? count.Whole : count.Part) > 0; });
  for (const Count& count : this->Counts)
  {
    const QString part = QString::number(number(count.Part));
    count.Text->setText(!isUpdated    ? QString()
                        : count.Whole ? part + " of " + QString::number(number(count.Whole))
                                      : part);
    if (count.Text->objectName() == "NumberOfSkippedSamples")
    {
      count.Label->setVisible(number(count.Part) > 0);
      count.Text->setVisible(number(count.Part) > 0);
    }
  }
}
