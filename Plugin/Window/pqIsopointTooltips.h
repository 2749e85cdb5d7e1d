// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef pqIsopointTooltips_h
#define pqIsopointTooltips_h

#include <QObject>

#include <memory>

/// Leaves the numbers of splats out of the tooltips of ParaView's "Hover Cells On", which list all
/// arrays of a cell.
class pqIsopointTooltips
{
public:
  /// Called when the plugin is loaded into the window.
  void startup();
  void shutdown();

private:
  std::unique_ptr<QObject> Filter; // of events
};

#endif
