// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef pqIsopointLabels_h
#define pqIsopointLabels_h

#include <QObject>

#include <memory>

/// Shows the help of a property of the filters at its label too: ParaView shows it at what is to
/// the right of that alone.
class pqIsopointLabels
{
public:
  /// Called when the plugin is loaded into the window.
  void startup();
  void shutdown();

private:
  std::unique_ptr<QObject> Watcher;
};

#endif
