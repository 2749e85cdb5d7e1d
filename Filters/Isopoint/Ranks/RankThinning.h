// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_RankThinning_h
#define isopoint_RankThinning_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Base/Team.h"
#include "Isopoint/Extraction/Isosurface.h"
#include "Isopoint/Extraction/Thinning.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace isopoint
{

/// Thins the isopoints of all ranks (see thin()), taken in the order of the whole surface. That
/// order runs through all ranks, so one rank does it for all: it takes memory for all isopoints.
/// Collective.
class RankThinning
{
public:
  RankThinning(const Execution& execution, Team& team, double minimumSpacing)
    : Run(execution)
    , Group(team)
    , MinimumSpacing(minimumSpacing)
  {
  }

  /// @param surface with fits, each isopoint on one rank or on several
  /// @throws std::bad_alloc, Aborted, FailedElsewhere
  void thinOut(Isosurface& surface)
  {
    std::vector<std::vector<Candidate>> outgoing(static_cast<std::size_t>(this->Group.size()));
    for (std::size_t i = 0; i < surface.size() && !surface.fits.empty(); ++i)
    {
      const LocalFit& fit = surface.fits[i];
      outgoing.front().push_back(
        { surface.edges[i], fit.position, fit.gradient, fit.spacing, fit.isSmooth ? 1u : 0u });
    }
    const std::vector<std::vector<unsigned char>> isKept =
      this->Group.exchange(this->answer(this->Group.exchange(outgoing)));
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < isKept.front().size(); ++i)
    {
      if (isKept.front()[i] != 0)
      {
        kept.push_back(i);
      }
    }
    surface = chosenIsopoints(surface, kept);
  }

private:
  /// What thin() looks at.
  struct Candidate
  {
    IsopointEdge edge;
    Vector position;
    Vector gradient;
    double spacing;
    std::uint64_t isSmooth;
  };

  std::vector<std::vector<unsigned char>> answer(
    const std::vector<std::vector<Candidate>>& arrived) const
  {
    Isosurface whole = united(arrived);
    thin(this->Run, this->MinimumSpacing, whole);
    std::vector<std::vector<unsigned char>> answers(arrived.size());
    for (std::size_t rank = 0; rank < arrived.size(); ++rank)
    {
      std::transform(arrived[rank].begin(), arrived[rank].end(), std::back_inserter(answers[rank]),
        [&whole](const Candidate& candidate)
        {
          return static_cast<unsigned char>(
            std::binary_search(whole.edges.begin(), whole.edges.end(), candidate.edge));
        });
    }
    return answers;
  }

  /// A surface of all candidates, each once, with what thin() looks at.
  static Isosurface united(const std::vector<std::vector<Candidate>>& arrived)
  {
    std::vector<Candidate> all;
    for (const std::vector<Candidate>& list : arrived)
    {
      all.insert(all.end(), list.begin(), list.end());
    }
    std::sort(all.begin(), all.end(),
      [](const Candidate& a, const Candidate& b) { return a.edge < b.edge; });
    all.erase(std::unique(all.begin(), all.end(),
                [](const Candidate& a, const Candidate& b) { return a.edge == b.edge; }),
      all.end());
    Isosurface whole;
    for (const Candidate& candidate : all)
    {
      LocalFit fit{};
      fit.position = candidate.position;
      fit.gradient = candidate.gradient;
      fit.spacing = candidate.spacing;
      fit.isSmooth = candidate.isSmooth != 0;
      whole.edges.push_back(candidate.edge);
      whole.positions.push_back(candidate.position);
      whole.decreasingEdges.push_back({});
      whole.fits.push_back(std::move(fit));
    }
    return whole;
  }

  const Execution& Run;
  Team& Group;
  const double MinimumSpacing;
};

} // namespace isopoint

#endif
