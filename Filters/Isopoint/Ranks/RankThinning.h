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

/// Which isopoints of a rank remain when those of all ranks are thinned, taken in the order of the
/// whole surface. That order runs through all ranks, so one rank does it for all: it takes memory
/// for all isopoints. Collective.
/// @param surface with fits, each isopoint on one rank or on several
/// @returns for each of this rank's isopoints whether it stays
/// @throws std::bad_alloc, Aborted, FailedElsewhere
class RankThinning
{
public:
  RankThinning(const Execution& execution, Team& team, double minimumSpacing)
    : Run(execution)
    , Ranks(team)
    , MinimumSpacing(minimumSpacing)
  {
  }

  std::vector<bool> kept(const Isosurface& surface)
  {
    std::vector<std::vector<Candidate>> outgoing;
    this->Ranks.together(
      [&]()
      {
        outgoing.resize(static_cast<std::size_t>(this->Ranks.size()));
        for (std::size_t i = 0; i < surface.size() && !surface.fits.empty(); ++i)
        {
          const LocalFit& fit = surface.fits[i];
          outgoing.front().push_back(
            { surface.edges[i], fit.position, fit.gradient, fit.spacing, fit.isSmooth ? 1u : 0u });
        }
      });
    const std::vector<std::vector<Candidate>> arrived = this->Ranks.exchange(outgoing);
    std::vector<std::vector<unsigned char>> answers;
    this->Ranks.together([&]() { answers = this->answer(arrived); });
    const std::vector<std::vector<unsigned char>> received = this->Ranks.exchange(answers);
    std::vector<bool> result;
    this->Ranks.together(
      [&]() { result.assign(received.front().begin(), received.front().end()); });
    return result;
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

  static bool isBefore(const IsopointEdge& a, const IsopointEdge& b)
  {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  }

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
            std::binary_search(whole.edges.begin(), whole.edges.end(), candidate.edge, isBefore));
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
      [](const Candidate& a, const Candidate& b) { return isBefore(a.edge, b.edge); });
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
  Team& Ranks;
  const double MinimumSpacing;
};

} // namespace isopoint

#endif
