// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_TeamOfTree_h
#define isopoint_TeamOfTree_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Ranks/NodeExchange.h"
#include "Isopoint/Ranks/Rounds.h"

#include <cstddef>
#include <cstdint>

namespace isopoint
{

/// The ranks that share a tree, as work on its leaves sees them: what SingleTeam is for one. All
/// functions are collective.
/// @throws FailedElsewhere, besides what work throws
template <class TSample>
class TeamOfTree
{
public:
  explicit TeamOfTree(NodeExchange<TSample>& exchange)
    : Exchange(exchange)
  {
  }

  template <class Work>
  void together(const Work& work)
  {
    this->Exchange.together(work);
  }

  bool isAny(bool mine) { return this->Exchange.isAny(mine); }
  std::uint64_t sum(std::uint64_t mine) { return this->Exchange.team().sum(mine); }

  template <class MakeWorker, class Work>
  void forEach(
    const Execution& execution, std::size_t count, const MakeWorker& makeWorker, const Work& work)
  {
    inRounds(execution, this->Exchange, count, makeWorker, work, false);
  }

protected:
  NodeExchange<TSample>& Exchange;
};

} // namespace isopoint

#endif
