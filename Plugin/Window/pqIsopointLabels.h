// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef pqIsopointLabels_h
#define pqIsopointLabels_h

class QWidget;

/// Shows the help of each property also at its label; ParaView shows it only at the widget.
void pqShowHelpAtLabels(QWidget* panel);

#endif
