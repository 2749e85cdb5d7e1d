// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef pqIsopointCounts_h
#define pqIsopointCounts_h

#include "pqPropertyWidget.h"

#include <vector>

class QLabel;
class vtkSMProperty;
class vtkSMPropertyGroup;

/// Counts of the last update as text, "27 of 12717"; empty before the first update. Skipped samples
/// are only shown if there are any. The function of
/// a property is its label, and the property with the function "label of" is its total.
class pqIsopointCounts : public pqPropertyWidget
{
  Q_OBJECT
  using Superclass = pqPropertyWidget;

public:
  pqIsopointCounts(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);

private Q_SLOTS:
  void updateTexts();

private:
  struct Count
  {
    QLabel* Label;
    QLabel* Text;
    vtkSMProperty* Part;
    vtkSMProperty* Whole; // null: of nothing
  };
  std::vector<Count> Counts;
};

#endif
