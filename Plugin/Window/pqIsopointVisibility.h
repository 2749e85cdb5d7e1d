// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef pqIsopointVisibility_h
#define pqIsopointVisibility_h

#include <QObject>
#include <QSet>

#include <memory>

class pqPipelineFilter;
class pqServerManagerModelItem;

/// Hides the input of a new filter if it is drawn as opaque splats, as ParaView does for surfaces:
/// the output would be hidden behind them. Explains what to do if a filter leaves nothing of
/// isopoints because it works on cells.
class pqIsopointVisibility
{
public:
  /// Called when the plugin is loaded into the window.
  void startup();
  void shutdown();

private:
  /// Follows the states of pipeline items: a filter is new until it is first applied.
  void follow(pqServerManagerModelItem* item);

  static void hideSplatsBehind(pqPipelineFilter* filter);

  /// Explains why a slice of isopoints shows nothing.
  static void explainEmptySlice(pqPipelineFilter* filter);

  QSet<pqServerManagerModelItem*> NewItems;
  std::unique_ptr<QObject> Following; // receives signals
};

#endif
