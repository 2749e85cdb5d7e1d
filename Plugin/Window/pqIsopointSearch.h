// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef pqIsopointSearch_h
#define pqIsopointSearch_h

#include <QWidget>

#include <memory>

/// Makes the quick search (Filters > Search) find the filters by "contour", "resample" and the
/// like. It searches the names of menu entries, so filters get another entry, whose name has no
/// word of the filter's.
class pqIsopointSearch
{
public:
  /// Called when the plugin is loaded into the window.
  void startup();
  void shutdown();

private:
  void registerEntries();

  /// Entries with the icons and states of those in the menu.
  void updateEntries();

  std::unique_ptr<QWidget> Entries;
};

#endif
