// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef pqIsopointVisibility_h
#define pqIsopointVisibility_h

#include <QObject>
#include <QSet>

#include <memory>

class pqPipelineFilter;
class pqServerManagerModelItem;

/// Hides what a filter was applied to where it is drawn as splats, as ParaView's window does where
/// it is drawn as a surface: behind opaque splats the output would not be seen. Where a filter
/// leaves nothing of isopoints, since it takes cells, it says what to do.
class pqIsopointVisibility
{
public:
  /// Called when the plugin is loaded into the window.
  void startup();
  void shutdown();

private:
  /// Follows the states of a pipeline's items: a filter is new until it is first applied.
  void follow(pqServerManagerModelItem* item);

  static void hideSplatsBehind(pqPipelineFilter* filter);

  /// Says why a slice of isopoints shows nothing.
  static void explainEmptySlice(pqPipelineFilter* filter);

  QSet<pqServerManagerModelItem*> NewItems;
  std::unique_ptr<QObject> Following; // as long as signals are followed
};

#endif
