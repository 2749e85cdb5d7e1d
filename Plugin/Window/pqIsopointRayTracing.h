// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef pqIsopointRayTracing_h
#define pqIsopointRayTracing_h

#include <QObject>
#include <QPointer>

#include <memory>

class QProgressBar;
class QProgressDialog;

/// Exports ray-traced pictures: adds an entry to the File menu, and shows the progress of all such
/// exports with a button that stops them.
class pqIsopointRayTracing
{
public:
  pqIsopointRayTracing();
  ~pqIsopointRayTracing();

  /// Called when the plugin is loaded into the window.
  void startup();
  void shutdown();

private:
  void addMenuEntry();

  /// Shows the share of an export that is done. @returns whether to continue
  bool show(double share);

  std::unique_ptr<QObject> Waiting;        // for the window
  QPointer<QObject> Entry;                 // in the menu
  std::unique_ptr<QProgressDialog> Dialog; // during an export
  QProgressBar* Bar = nullptr;             // of the dialog
};

#endif
