// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef pqIsopointFilters_h
#define pqIsopointFilters_h

#include <QObject>
#include <QSet>

#include <memory>

class pqPipelineFilter;
class pqServerManagerModelItem;

/// Adapts filters when they are applied: those downstream of isopoints, and images.
class pqIsopointFilters
{
public:
  /// Called when the plugin is loaded into the window.
  void startup();
  void shutdown();

private:
  /// Follows all pipeline items from now on.
  void followPipeline();

  /// Follows the states of pipeline items: a filter is new until it is first applied.
  void follow(pqServerManagerModelItem* item);

  /// Makes Extract Selection keep the vertices of selected points, and with them the shapes of
  /// their splats. The active selection stays: ParaView only adds selections of the same kind to
  /// it.
  static void keepVertices(pqPipelineFilter* filter);

  /// Hides the input of a new filter if it is drawn as opaque splats, as ParaView does for
  /// surfaces: the output would be hidden behind them.
  static void hideSplatsBehind(pqPipelineFilter* filter);

  /// Colors a new image as its input is, if by an array of cells: the image has it at points.
  static void keepColor(pqPipelineFilter* filter);

  /// Explains what to do if a new filter yields nothing because it needs cells other than vertices.
  static void explainEmptyResult(pqPipelineFilter* filter);

  QSet<pqServerManagerModelItem*> NewItems;
  std::unique_ptr<QObject> Following; // receives signals
};

#endif
