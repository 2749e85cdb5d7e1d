// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_ExpectedWork_h
#define isopoint_ExpectedWork_h

#include "Core/Base/Execution.h"
#include "Core/Tree/TreeletSplitting.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>

namespace isopoint
{

/// What the parts of an extraction take, in nanoseconds of one thread. Progress alone depends on
/// these figures, and on their ratios alone.
namespace work
{

constexpr double loading = 30.0;          // for each sample
constexpr double halving = 4.0;           // for each sample of a node and level
constexpr double parting = 50.0;          // for each sample, in the last treelet, besides
constexpr double searching = 3300.0;      // for each node of a front: which nodes below are needed
constexpr double finding = 2500.0;        // for each isopoint: its edge
constexpr double placing = 200.0;         // for each isopoint: sorted, and put there
constexpr double tetrahedrizing = 6000.0; // for each isopoint: its tetrahedra
constexpr double fitting = 15000.0;       // for each isopoint
constexpr double splatting = 4000.0;      // for each isopoint
constexpr double writing = 150.0;         // for each isopoint: output arrays

constexpr double isopointsForNode = 1.75; // that is crossing, in the last front

} // namespace work

/// How the fronts of a narrow band will grow: as those of a surface do, from what is known of the
/// present one.
class BandForecast
{
public:
  explicit BandForecast(std::size_t sampleCount)
    : SampleCount(sampleCount)
    , Depth(levelsToHalve(sampleCount))
  {
  }

  /// @param nodeCount of the front at a depth
  /// @param unsplitShare of its samples: in nodes that are still to be split
  void observe(int depth, std::size_t nodeCount, double unsplitShare)
  {
    const double most = std::exp2(depth);
    const auto count = static_cast<double>(nodeCount);
    // A front of almost all nodes does not show yet how large the surface is.
    if (count < 0.9 * most)
    {
      this->Extent = count / std::exp2(2.0 / 3.0 * depth);
    }
    this->UnsplitShare = unsplitShare;
  }

  /// The number of nodes of the front at a depth.
  double nodesAt(int depth) const
  {
    return std::min(std::exp2(depth), this->Extent * std::exp2(2.0 / 3.0 * depth));
  }

  /// The work of splitting a node of this many samples from a depth down to another.
  double splittingWork(double samples, int depth, int bottom) const
  {
    return samples *
           (work::halving * (bottom - depth) + (bottom >= this->Depth ? work::parting : 0.0));
  }

  /// The work of splitting the front of a depth down to another, and searching for the next front.
  double treeletWork(int depth, int bottom) const
  {
    const double samples =
      static_cast<double>(this->SampleCount) * this->nodesAt(depth) / std::exp2(depth);
    const double search = bottom < this->Depth ? work::searching * this->nodesAt(depth) : 0.0;
    return this->splittingWork(this->UnsplitShare * samples, depth, bottom) + search;
  }

  /// The work of the band from a depth on.
  double bandWork(int depth) const
  {
    double sum = 0.0;
    while (depth < this->Depth)
    {
      const int bottom = treeletBottom(depth, this->SampleCount);
      sum += this->treeletWork(depth, bottom);
      depth = bottom;
    }
    return sum;
  }

  /// The number of isopoints: about that of the nodes of the last front.
  double isopointCount() const { return this->nodesAt(std::max(0, this->Depth - treeletLevels)); }

private:
  std::size_t SampleCount;
  int Depth;
  double Extent =
    13.0; // nodes of a front over 2^(2/3 depth): that of a sphere of a third the width
  double UnsplitShare = 1.0;
};

/// Progress of parts of known expected work, in proportion to time: what a part takes is expected
/// from its share that is done, what follows from the pace of the parts before. Never goes back.
class WorkProgress
{
public:
  explicit WorkProgress(const Execution& execution)
    : Run(execution)
  {
  }
  WorkProgress(const WorkProgress&) = delete;
  WorkProgress& operator=(const WorkProgress&) = delete;

  /// Ends the part before, if there is one, and begins another. What a part takes is noted: it
  /// lasts until the next one begins.
  /// @param work of the part
  /// @param left after it
  /// @returns an execution for the part, which reports its progress from 0 to 1; for as long as
  /// this object lives and no other part has begun
  Execution part(double work, double left)
  {
    const Clock::time_point now = Clock::now();
    const double seconds = secondsBetween(this->PartBegin, now);
    if (this->Pace > 0.0 && this->PartWork > 0.0)
    {
      this->raise(seconds / (seconds + this->Pace * this->PartLeft));
    }
    else
    {
      this->raise(this->PartWork / std::max(this->PartWork + this->PartLeft, 1.0));
    }
    this->DoneSeconds += seconds;
    this->DoneWork += this->PartWork;
    this->Pace = this->DoneWork > 0.0 ? this->DoneSeconds / this->DoneWork : 0.0;
    this->PartBegin = now;
    this->PartWork = work;
    this->PartLeft = left;
    this->Base = this->Reported;
    Execution part = this->Run;
    part.progress = [this](double share)
    {
      this->raise(this->shareOfRest(share));
      this->Run.progress(this->Reported);
    };
    return part;
  }

private:
  using Clock = std::chrono::steady_clock;

  static double secondsBetween(Clock::time_point begin, Clock::time_point end)
  {
    return std::chrono::duration<double>(end - begin).count();
  }

  /// The share of what was left before the part, when a share of the part is done.
  double shareOfRest(double share) const
  {
    if (this->Pace <= 0.0 || share <= 0.0)
    {
      return share * this->PartWork / std::max(this->PartWork + this->PartLeft, 1.0);
    }
    constexpr double trust = 4.0; // the first steps of a part may differ from the others
    const double expected = this->Pace * this->PartWork;
    const double whole = std::clamp(
      secondsBetween(this->PartBegin, Clock::now()) / share, expected / trust, expected * trust);
    return share * whole / std::max(whole + this->Pace * this->PartLeft, 1e-9);
  }

  void raise(double shareOfRest)
  {
    this->Reported =
      std::max(this->Reported, this->Base + (1.0 - this->Base) * std::min(shareOfRest, 1.0));
  }

  const Execution& Run;
  Clock::time_point PartBegin = Clock::now();
  double PartWork = 0.0;
  double PartLeft = 0.0;
  double DoneSeconds = 0.0;
  double DoneWork = 0.0;
  double Pace = 0.0; // seconds for a unit of work, 0 while unknown
  double Base = 0.0; // reported before the part
  double Reported = 0.0;
};

} // namespace isopoint

#endif
