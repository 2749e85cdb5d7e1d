// SPDX-License-Identifier: GPL-3.0-or-later
#include "pqIsopointCounts.h"

#include "pqCoreUtilities.h"

#include "vtkCommand.h"
#include "vtkSMDocumentation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyGroup.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <QFormLayout>
#include <QLabel>
#include <QString>

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
  this->setShowLabel(false);
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
    auto* const label = new QLabel(QString(part->GetXMLLabel()).remove("Number Of "), this);
    for (QLabel* const each : { label, value })
    {
      each->setToolTip(QString(part->GetDocumentation()->GetDescription()).simplified());
    }
    layout->addRow(label, value);
    this->Counts.push_back({ value, part, whole });
    for (vtkSMProperty* const property : { part, whole })
    {
      if (property)
      {
        pqCoreUtilities::connect(property, vtkCommand::ModifiedEvent, this, SLOT(updateTexts()));
      }
    }
  }
  this->updateTexts();
}

void pqIsopointCounts::updateTexts()
{
  const auto number = [](vtkSMProperty* property)
  { return QString::number(vtkSMPropertyHelper(property).GetAsIdType()); };
  for (const Count& count : this->Counts)
  {
    count.Text->setText(
      count.Whole ? number(count.Part) + " of " + number(count.Whole) : number(count.Part));
  }
}
