// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * RanksBenchmark RANKS SAMPLES [all] [triangles]: extracts a sphere from random samples on ranks
 * that are threads of this process, points or triangles alone, or with "all" fits, normals and
 * radii. Prints for each rank
 * the processor seconds, what it sent to others and the number of exchanges: of loading, of the
 * first isovalue, of another one, and of new values at the same positions with the first one.
 */
#include "ThreadRanks.h"

#include "Core/Base/Team.h"
#include "Core/IsosurfaceExtractor.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

namespace
{

/// Processor seconds of this thread.
double seconds()
{
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// SplitMix64.
std::uint64_t mixed(std::uint64_t number)
{
  number += 0x9e3779b97f4a7c15u;
  number = (number ^ (number >> 30)) * 0xbf58476d1ce4e5b9u;
  number = (number ^ (number >> 27)) * 0x94d049bb133111ebu;
  return number ^ (number >> 31);
}

/// Reads random samples of the distance from the middle of a unit cube.
struct Reader
{
  std::uint64_t first; // of the ids
  double shift;        // of the values

  template <class TCoordinate, class TValue>
  bool operator()(std::size_t id, TCoordinate* position, TValue& value) const
  {
    constexpr double unit = 1.0 / 16777216.0;
    double squared = 0.0;
    for (std::uint64_t axis = 0; axis < 3; ++axis)
    {
      const double place = static_cast<double>(mixed(3 * (this->first + id) + axis) >> 40) * unit;
      position[axis] = static_cast<TCoordinate>(place);
      squared += (place - 0.5) * (place - 0.5);
    }
    value = static_cast<TValue>(std::sqrt(squared) + this->shift);
    return true;
  }
};

/// What a step took.
class Step
{
public:
  explicit Step(const isopoint::Team& team)
    : Team(team)
  {
  }

  /// Prints what was used since the last call.
  void print(const char* what, int rank)
  {
    const double now = seconds();
    const isopoint::Traffic all = this->Team.traffic();
    std::printf("rank %d, %s: %.3f s, %.2f MB sent, %llu exchanges\n", rank, what,
      now - this->Begin, 1e-6 * static_cast<double>(all.sent - this->Former.sent),
      static_cast<unsigned long long>(all.rounds - this->Former.rounds));
    this->Former = all;
    this->Begin = now;
  }

private:
  const isopoint::Team& Team;
  isopoint::Traffic Former;
  double Begin = seconds();
};

void extract(isopoint::Team& team, std::size_t samples, const isopoint::ExtractionRequest& first)
{
  const isopoint::Execution execution;
  const std::size_t own = samples / static_cast<std::size_t>(team.size());
  const std::size_t begin = static_cast<std::size_t>(team.rank()) * own;
  isopoint::IsosurfaceExtractor extractor;
  Step step(team);
  extractor.load<float, float>(execution, team, own, Reader{ begin, 0.0 });
  step.print("loading", team.rank());
  const std::size_t count = extractor.extract(execution, first).surface.size();
  step.print("isovalue", team.rank());
  isopoint::ExtractionRequest another = first;
  another.isosurface.isovalue = 0.35;
  extractor.extract(execution, another);
  step.print("another", team.rank());
  extractor.replaceValues<float, float>(execution, own, Reader{ begin, 0.01 });
  step.print("replacing", team.rank());
  extractor.extract(execution, first);
  step.print("replaced", team.rank());
  std::printf("rank %d: %zu samples, %zu points\n", team.rank(), extractor.sampleCount(), count);
}

} // namespace

int main(int argc, char** argv)
{
  if (argc < 3 || std::atoi(argv[1]) < 1 || std::atof(argv[2]) < 1)
  {
    std::fprintf(stderr, "usage: %s RANKS SAMPLES [all] [triangles]\n", argv[0]);
    return 2;
  }
  const int ranks = std::atoi(argv[1]);
  const auto samples = static_cast<std::size_t>(std::atof(argv[2]));
  isopoint::ExtractionRequest request;
  request.isosurface.isovalue = 1.0 / 3.0;
  const auto hasWord = [&](const char* word)
  {
    return std::any_of(argv + 3, argv + argc,
      [word](const char* argument) { return std::strcmp(argument, word) == 0; });
  };
  if (hasWord("all"))
  {
    request.isosurface.fit = isopoint::FitRequest{ isopoint::FitOrder::Cubic, true };
    request.splats = isopoint::SplatOptions();
  }
  request.triangles = hasWord("triangles");
  ThreadRanks threads(ranks);
  threads.run(
    [&](isopoint::Communicator& communicator)
    {
      isopoint::Team team(communicator);
      team.together([&]() { extract(team, samples, request); });
    });
  return 0;
}
