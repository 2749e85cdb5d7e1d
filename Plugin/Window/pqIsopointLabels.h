// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef pqIsopointLabels_h
#define pqIsopointLabels_h

class QWidget;

/// Shows the help of each property in a panel at its label too: ParaView shows it only at what is
/// to the right of the label.
void pqShowHelpAtLabels(QWidget* panel);

#endif
