// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef pqIsopointSelections_h
#define pqIsopointSelections_h

#include <QObject>

#include <memory>

class pqServerManagerModelItem;

/// Makes Extract Selection keep the vertices of points from isopoints, and with them the shapes of
/// their splats. The active selection stays: ParaView only adds selections of the same kind to it.
class pqIsopointSelections
{
public:
  /// Called when the plugin is loaded into the window.
  void startup();
  void shutdown();

private:
  /// Makes the selection of an applied filter contain cells.
  static void keepVertices(pqServerManagerModelItem* item);

  std::unique_ptr<QObject> Following; // receives signals
};

#endif
