// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef pqIsopointSelections_h
#define pqIsopointSelections_h

#include <QObject>

#include <memory>

class pqServerManagerModelItem;

/// Lets Extract Selection keep the vertices of points that it takes from isopoints, and with them
/// the shapes of their splats. The active selection stays as it is: ParaView adds to it only what
/// is selected in the same way.
class pqIsopointSelections
{
public:
  /// Called when the plugin is loaded into the window.
  void startup();
  void shutdown();

private:
  /// Makes the selection of a filter that was applied contain cells.
  static void keepVertices(pqServerManagerModelItem* item);

  std::unique_ptr<QObject> Following; // as long as signals are followed
};

#endif
