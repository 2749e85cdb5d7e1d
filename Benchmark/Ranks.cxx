// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * RanksBenchmark RANKS SAMPLES [all] [triangles]: extracts a sphere from random samples on ranks
 * that are threads of this process, points or triangles alone, or with "all" fits, normals and
 * radii. Prints for each rank the processor seconds, the bytes sent to others and the number of
 * exchanges: of loading, of the first isovalue, of another one, and of new values at the same
 * positions with the first one.
 */
#include "Clouds.h"
#include "ThreadRanks.h"

#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace
{

/// Prints what a step takes on the thread of a rank.
template <class Work>
void measure(const char* what, isopoint::ProcessGroup& processes, const Work& work)
{
  const auto seconds = []()
  {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double begin = seconds();
  const ThreadRanks::Traffic former = ThreadRanks::traffic;
  work();
  const ThreadRanks::Traffic& all = ThreadRanks::traffic;
  std::printf("rank %d, %s: %.3f s, %.2f MB sent, %llu exchanges\n", processes.rank(), what,
    seconds() - begin, 1e-6 * static_cast<double>(all.sent - former.sent),
    static_cast<unsigned long long>(all.exchanges - former.exchanges));
}

void extract(
  isopoint::ProcessGroup& processes, std::size_t samples, const isopoint::ExtractionRequest& first)
{
  const auto distanceFrom = [](double shift)
  {
    return [shift](const clouds::Vector& p) {
      return isopoint::lengthOf({ p[0] - 0.5, p[1] - 0.5, p[2] - 0.5 }) + shift;
    };
  };
  const clouds::Cloud cloud =
    clouds::withValuesOf(clouds::uniform(samples / static_cast<std::size_t>(processes.size()),
                           static_cast<std::uint64_t>(processes.rank())),
      distanceFrom(0.0));
  const clouds::Cloud shifted = clouds::withValuesOf(cloud, distanceFrom(0.01));
  isopoint::ExtractionRequest another = first;
  another.isosurface.isovalue = 0.35;
  isopoint::IsosurfaceExtractor extractor;
  std::size_t count = 0;
  measure("loading", processes,
    [&]() { extractor.load<float, float>({}, processes, cloud.size(), clouds::readerOf(cloud)); });
  measure("isovalue", processes, [&]() { count = extractor.extract({}, first).surface.size(); });
  measure("another", processes, [&]() { extractor.extract({}, another); });
  measure("replacing", processes,
    [&]() { extractor.replaceValues<float, float>({}, cloud.size(), clouds::readerOf(shifted)); });
  measure("replaced", processes, [&]() { extractor.extract({}, first); });
  std::printf(
    "rank %d: %zu samples, %zu points\n", processes.rank(), extractor.sampleCount(), count);
}

} // namespace

int main(int argc, char** argv)
{
  if (argc < 3 || std::atoi(argv[1]) < 1 || std::atof(argv[2]) < 1)
  {
    std::fprintf(stderr, "usage: %s RANKS SAMPLES [all] [triangles]\n", argv[0]);
    return 2;
  }
  const auto samples = static_cast<std::size_t>(std::atof(argv[2]));
  const std::set<std::string> words(argv + 3, argv + argc);
  isopoint::ExtractionRequest request = clouds::requestOf(1.0 / 3.0);
  if (words.count("all") > 0)
  {
    request = clouds::withSplats(clouds::requestOf(1.0 / 3.0, isopoint::FitOrder::Cubic));
  }
  request.triangles = words.count("triangles") > 0;
  ThreadRanks threads(std::atoi(argv[1]));
  threads.run(
    [&](isopoint::Communicator& communicator)
    {
      isopoint::ProcessGroup processes(communicator);
      processes.runCollectively([&]() { extract(processes, samples, request); });
    });
  return 0;
}
