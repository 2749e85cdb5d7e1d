// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * RanksBenchmark RANKS SAMPLES [all] [triangles]: extracts a sphere from random samples on ranks
 * that are threads of this process, points or triangles alone, or with "all" fits, normals and
 * radii. Prints for each rank
 * the processor seconds, what it sent to others and the number of exchanges: of loading, of the
 * first isovalue, of another one, and of new values at the same positions with the first one.
 */
#include "ThreadRanks.h"

#include "Isopoint/IsosurfaceExtractor.h"

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
  explicit Step(const isopoint::IsosurfaceExtractor& extractor)
    : Extractor(extractor)
  {
  }

  /// Prints what was used since the last call.
  void print(const char* what, int rank)
  {
    const double now = seconds();
    const isopoint::Traffic* const traffic = this->Extractor.traffic();
    const isopoint::Traffic all = traffic ? *traffic : isopoint::Traffic();
    std::printf("rank %d, %s: %.3f s, %.2f MB sent, %llu exchanges\n", rank, what,
      now - this->Begin, 1e-6 * static_cast<double>(all.sent - this->Former.sent),
      static_cast<unsigned long long>(all.rounds - this->Former.rounds));
    this->Former = all;
    this->Begin = now;
  }

private:
  const isopoint::IsosurfaceExtractor& Extractor;
  isopoint::Traffic Former;
  double Begin = seconds();
};

template <class Replace>
void extract(isopoint::IsosurfaceExtractor& extractor, const isopoint::ExtractionRequest& first,
  Step& step, int rank, const Replace& replace)
{
  step.print("loading", rank);
  const std::size_t count = extractor.extract(isopoint::Execution(), first).surface.size();
  step.print("isovalue", rank);
  isopoint::ExtractionRequest another = first;
  another.isosurface.isovalue = 0.35;
  extractor.extract(isopoint::Execution(), another);
  step.print("another", rank);
  replace();
  step.print("replacing", rank);
  extractor.extract(isopoint::Execution(), first);
  step.print("replaced", rank);
  std::printf("rank %d: %zu samples, %zu points\n", rank, extractor.sampleCount(), count);
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
  if (ranks == 1)
  {
    isopoint::IsosurfaceExtractor extractor;
    Step step(extractor);
    extractor.load<float, float>(isopoint::Execution(), samples, Reader{ 0, 0.0 });
    extract(extractor, request, step, 0,
      [&]() {
        extractor.replaceValues<float, float>(isopoint::Execution(), samples, Reader{ 0, 0.01 });
      });
    return 0;
  }
  ThreadRanks team(ranks);
  team.run(
    [&](isopoint::Communicator& communicator)
    {
      const std::size_t own = samples / static_cast<std::size_t>(ranks);
      const auto rank = static_cast<std::size_t>(communicator.rank());
      isopoint::IsosurfaceExtractor extractor;
      Step step(extractor);
      extractor.loadOnRanks<float, float>(
        isopoint::Execution(), communicator, own, Reader{ rank * own, 0.0 });
      extract(extractor, request, step, communicator.rank(),
        [&]()
        {
          extractor.replaceValuesOnRanks<float, float>(
            isopoint::Execution(), own, Reader{ rank * own, 0.01 });
        });
    });
  return 0;
}
