// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef pqIsopointRayTracing_h
#define pqIsopointRayTracing_h

#include <QObject>
#include <QPointer>

#include <memory>

class QProgressBar;
class QProgressDialog;

/// Exports of ray-traced pictures: an entry in the menu File, and the progress of all such exports,
/// with a button that stops them.
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

  /// Shows the share of an export that is done. @returns whether it is to go on
  bool show(double share);

  QPointer<QObject> Entry;                 // of the menu
  std::unique_ptr<QProgressDialog> Dialog; // while an export is under way
  QProgressBar* Bar = nullptr;             // of the dialog
};

#endif
