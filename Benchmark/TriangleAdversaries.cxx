// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds that are hard on the search for crossing tetrahedra, each timed beside CGAL's
// tetrahedralization of all samples.
#include "Clouds.h"

#include "Core/Extraction/SingleRank.h"
#include "Core/Tree/Loading.h"
#include "Core/Triangles/ExtractTriangles.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace
{

using clouds::Cloud;
using clouds::Random;
using clouds::Vector;
using clouds::withValuesOf;

constexpr double largestShare = 1.5;

/// The greatest numbers of tetrahedra and of edges asked about gaps, the same on every machine:
/// those of the tetrahedra's limit, and a quarter more edges, since a few are asked twice.
constexpr double edgesOfTetrahedron = 1.25;

constexpr const char* usage =
  "usage: TriangleAdversaries [SAMPLES [THREADS [CGAL_THREADS [NAME]]]]\n"
  "Finds the crossing tetrahedra of clouds that are hard on the search for them, and prints a Markdown\n"
  "table of the times, as shares of that of CGAL's tetrahedralization of all samples and one pass over\n"
  "its cells; of samples on curves, only what they take. Exits with 1 if any share is above 1.5, or if\n"
  "tetrahedra exceed the greater of 4 million and 60 for each sample, or edges asked about gaps a\n"
  "quarter more, without the error of samples on curves.\n"
  "  SAMPLES       of most clouds (default: 200000); for clouds on curves, where CGAL is slow, a\n"
  "                tenth or less\n"
  "  THREADS       on one thread (the default) times are processor seconds, else elapsed seconds\n"
  "  CGAL_THREADS  of CGAL (default: 1)\n"
  "  NAME          only clouds whose name contains this\n";

double distanceToMiddle(const Vector& p)
{
  return isopoint::lengthOf(p - isopoint::Vector{ 0.5, 0.5, 0.5 });
}

double along(const Vector& p)
{
  return p[0];
}

/// A share of the values becomes 0, the others 1.
Cloud withNoise(Cloud cloud, double share)
{
  Random random(2);
  std::generate(
    cloud.values.begin(), cloud.values.end(), [&]() { return random() < share ? 0.0 : 1.0; });
  return cloud;
}

Cloud scattered(const Cloud& cloud, double length)
{
  return clouds::moved(cloud, [length, random = Random(3)](double* p) mutable
    { std::for_each(p, p + 3, [&](double& c) { c += length * (random() - 0.5); }); });
}

/// Positions go to a sphere around the middle, or between it and one that is larger by a share.
Cloud ontoShell(const Cloud& cloud, double thickness)
{
  return clouds::moved(cloud,
    [thickness, random = Random(3)](double* p) mutable
    {
      const double scale =
        0.4 * (1.0 + thickness * random()) / distanceToMiddle({ p[0], p[1], p[2] });
      std::for_each(p, p + 3, [scale](double& c) { c = 0.5 + scale * (c - 0.5); });
    });
}

Cloud latticeOf(std::size_t count)
{
  const int side = static_cast<int>(std::round(std::cbrt(static_cast<double>(count))));
  const double spacing = 1.0 / (side - 1);
  return withValuesOf(
    clouds::scaled(clouds::lattice(side, side, side), spacing, spacing, spacing), distanceToMiddle);
}

/// Uniform except for an empty ball in the middle, which the surface crosses.
Cloud withVoid(std::size_t count)
{
  Cloud cloud;
  Random random(4);
  while (cloud.size() < count)
  {
    const Vector p = random.place();
    if (distanceToMiddle(p) > 0.3)
    {
      cloud.add(p, p[0]);
    }
  }
  return cloud;
}

/// Two balls of samples far apart, one on each side of the surface.
Cloud farBalls(std::size_t count)
{
  return clouds::moved(withValuesOf(clouds::uniform(count, 5), along),
    [random = Random(3)](double* p) mutable { p[0] += random() < 0.5 ? 100.0 : 0.0; });
}

/// Two skew lines at right angles, of random samples, on which the Delaunay tetrahedralization has
/// quadratic size.
Cloud skewLines(std::size_t count, double scatter)
{
  Cloud cloud;
  Random random(6);
  for (std::size_t i = 0; i < count; ++i)
  {
    const double place = random();
    i % 2 ? cloud.add(0.25, place, 0.5, place) : cloud.add(0.75, 0.5, place, place);
  }
  return scattered(cloud, scatter);
}

/// Uniform in a ball, with one value.
Cloud ball(std::size_t count)
{
  Cloud cloud;
  Random random(7);
  while (cloud.size() < count)
  {
    const Vector p = random.place();
    if (distanceToMiddle(p) < 0.5)
    {
      cloud.add(p, 1.0);
    }
  }
  return cloud;
}

struct Adversary
{
  std::string name;
  double share; // of the samples asked for
  std::function<Cloud(std::size_t count)> make;
  double isovalue;
  bool isBody = false; // the facets of the body's border are counted instead
  bool isOnCurves = false;
};

std::vector<Adversary> adversaries()
{
  const auto random = [](std::size_t count) { return clouds::uniform(count, 1); };
  const auto noisy = [=](double share)
  { return [=](std::size_t count) { return withNoise(random(count), share); }; };
  const auto shell = [=](double thickness)
  {
    return [=](std::size_t count)
    { return withValuesOf(ontoShell(random(count), thickness), along); };
  };
  const auto slab = [=](double thickness)
  {
    return [=](std::size_t count)
    { return withValuesOf(clouds::scaled(random(count), 1.0, 1.0, thickness), distanceToMiddle); };
  };
  const auto skew = [](double scatter)
  { return [=](std::size_t count) { return skewLines(count, scatter); }; };
  const auto lines = [](std::size_t count) { return clouds::lines(count, 100, 0, 1); };
  const auto manySheets = [](const Vector& p) { return std::sin(60.0 * p[0]); };
  constexpr double tenth = 0.1;
  const auto wells = [](std::size_t count) { return clouds::tiltedWells(count / 400, 400, 1); };
  return {
    { "sphere", 1.0, [=](std::size_t n) { return withValuesOf(random(n), distanceToMiddle); },
      0.3 },
    { "plane", 1.0,
      [=](std::size_t n) { return withValuesOf(random(n), [](const Vector& p) { return p[2]; }); },
      0.5 },
    { "three sheets", 1.0, random, 0.4 },
    { "many sheets", 1.0, [=](std::size_t n) { return withValuesOf(random(n), manySheets); }, 0.0 },
    { "strong clusters", 1.0, [](std::size_t n) { return clouds::clustered(n, 1); }, -4.0 },
    { "a void", 1.0, withVoid, 0.5 },
    { "two balls far apart", 1.0, farBalls, 0.5 },
    { "noise: 1 % of the values", 1.0, noisy(0.01), 0.5 },
    { "noise: 3 % of the values", 1.0, noisy(0.03), 0.5 },
    { "noise: half of the values", 1.0, noisy(0.5), 0.5 },
    { "lattice", 1.0, latticeOf, 0.4 },
    { "lattice, turned", 1.0,
      [](std::size_t n) { return clouds::moved(latticeOf(n), clouds::turn); }, 0.4 },
    { "lattice, scattered by 1e-6: hull slivers", 1.0,
      [](std::size_t n) { return scattered(latticeOf(n), 1e-6); }, 0.6 },
    { "slab of thickness 0.05", 1.0, slab(0.05), 0.6 },
    { "slab of thickness 0.001", 1.0, slab(1e-3), 0.6 },
    { "slab of thickness 0.0001", 1.0, slab(1e-4), 0.6 },
    { "shell of thickness 1e-6", 1.0, shell(1e-6), 0.5 },
    { "shell of thickness 0.01", 1.0, shell(0.01), 0.5 },
    { "shell of thickness 0.1", 1.0, shell(0.1), 0.5 },
    { "a cell that touches half of all", 1.0,
      [](std::size_t n) { return clouds::layerBeforeOne(n, 1); }, 0.5 },
    { "skew lines", 0.02, skew(0.0), 0.5 },
    { "skew lines, scattered by 0.001", tenth, skew(0.001), 0.5 },
    { "skew lines, scattered by 0.01", 1.0, skew(0.01), 0.5 },
    { "100 lines", tenth, lines, 0.3 },
    { "100 lines, smooth", tenth,
      [=](std::size_t n) { return withValuesOf(lines(n), distanceToMiddle); }, 0.3 },
    { "combs", tenth, [](std::size_t n) { return clouds::combs(n, 30, 1); }, 0.3 },
    { "linked circles", 0.03, [](std::size_t n) { return clouds::curves(n, 1); }, 0.3 },
    { "body of a ball", 1.0, ball, 0.5, true },
    { "body of a thousand on (t, t^2, t^3)", 0.005, clouds::momentCurve, 0.0, true, true },
    { "body of (t, t^2, t^3)", tenth, clouds::momentCurve, 0.0, true, true },
    { "body of five hundred on skew lines", 0.0025, clouds::twoSkewLines, 0.0, true, true },
    { "body of skew lines", tenth, clouds::twoSkewLines, 0.0, true, true },
    { "body of wells", tenth, wells, 0.0, true, true },
    { "helix", 0.025, clouds::helix, 0.5, false, true },
    { "longer helix", tenth, clouds::helix, 0.5, false, true },
    { "body of a helix", tenth, clouds::helix, 0.0, true, true },
  };
}

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Sites = std::vector<std::pair<Kernel::Point_3, bool>>; // true: below the isovalue

template <class Concurrency>
using Full = CGAL::Delaunay_triangulation_3<Kernel,
  CGAL::Triangulation_data_structure_3<CGAL::Triangulation_vertex_base_with_info_3<bool, Kernel>,
    CGAL::Delaunay_triangulation_cell_base_3<Kernel>, Concurrency>>;

/// @param isBody whether facets of the hull count instead, the border of a body without gaps
template <class Concurrency>
std::size_t countCrossing(const Full<Concurrency>& full, bool isBody)
{
  if (isBody)
  {
    return full.number_of_cells() - full.number_of_finite_cells();
  }
  std::size_t count = 0;
  for (const auto cell : full.finite_cell_handles())
  {
    int below = 0;
    for (int i = 0; i < 4; ++i)
    {
      below += cell->vertex(i)->info() ? 1 : 0;
    }
    count += below > 0 && below < 4 ? 1 : 0;
  }
  return count;
}

/// The number of crossing tetrahedra, by a tetrahedralization of all samples.
std::size_t countInFull(const Cloud& cloud, const Adversary& adversary, std::size_t threads)
{
  Sites sites;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const double* const p = cloud.positions.data() + 3 * i;
    sites.emplace_back(Kernel::Point_3(p[0], p[1], p[2]), cloud.values[i] < adversary.isovalue);
  }
#ifdef CGAL_LINKED_WITH_TBB
  if (threads > 1)
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    CGAL::Bbox_3 bounds;
    for (const auto& [place, isBelow] : sites)
    {
      bounds += place.bbox();
    }
    constexpr int locksOfAnAxis = 50;
    Full<CGAL::Parallel_tag>::Lock_data_structure locks(bounds, locksOfAnAxis);
    return countCrossing<CGAL::Parallel_tag>(
      { sites.begin(), sites.end(), &locks }, adversary.isBody);
  }
#endif
  return countCrossing<CGAL::Sequential_tag>({ sites.begin(), sites.end() }, adversary.isBody);
}

/// @param dropsGaps whether to drop tetrahedra in gaps
std::size_t countFound(const Cloud& cloud, const Adversary& adversary, std::size_t threads,
  isopoint::TetrahedraCounts& counts, bool dropsGaps)
{
  using TSample = isopoint::WideSample;
  const isopoint::Execution execution = clouds::executionOn(threads);
  auto tree = isopoint::loadSamples<TSample>(execution, cloud.size(), clouds::readerOf(cloud));
  const isopoint::NeighborhoodCache<TSample::Id> none;
  isopoint::SingleRank<TSample> rank(tree);
  std::unique_ptr<isopoint::KeptTetrahedra> band;
  isopoint::IsosurfaceRequest request{ adversary.isovalue };
  request.dropsGaps = true;
  isopoint::TriangleExtraction<TSample, isopoint::SingleRank<TSample>> extraction(
    execution, tree, rank, none, band, request);
  std::size_t found = 0;
  if (adversary.isBody)
  {
    found = extraction.bodyTetrahedra(execution).caps.size();
  }
  else
  {
    std::vector<isopoint::LeafTetrahedron> tetrahedra = extraction.tetrahedra(execution);
    if (dropsGaps)
    {
      extraction.dropGaps(execution, tetrahedra);
    }
    found = tetrahedra.size();
  }
  counts = extraction.counts();
  return found;
}

struct Options
{
  double samples;
  std::size_t threads;
  std::size_t cgalThreads;
  std::string only;
};

double seconds(const Options& options, const std::function<void()>& work)
{
  const auto now = [&options]()
  {
    if (options.threads == 1 && options.cgalThreads == 1)
    {
      return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    }
    const auto time = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(time).count();
  };
  const double begin = now();
  work();
  return now() - begin;
}

/// Whether tetrahedra and edges are within the limits, or end with an error.
bool isWithinBudget(const Cloud& cloud, const Adversary& adversary, std::size_t threads,
  isopoint::TetrahedraCounts& counts, std::size_t& found)
{
  try
  {
    found = countFound(cloud, adversary, threads, counts, true);
  }
  catch (const isopoint::TooManyTetrahedra&)
  {
    return true;
  }
  const auto most = static_cast<double>(isopoint::TetrahedraLimit().of(cloud.size()));
  return static_cast<double>(counts.cells) <= most &&
         static_cast<double>(counts.edges) <= edgesOfTetrahedron * most;
}

/// Prints the row of a cloud on curves. @returns whether it is within the budget
bool measureCurve(const Adversary& adversary, const Options& options)
{
  const Cloud cloud = adversary.make(static_cast<std::size_t>(adversary.share * options.samples));
  isopoint::TetrahedraCounts counts;
  std::size_t found = 0;
  const bool isWithin = isWithinBudget(cloud, adversary, options.threads, counts, found);
  std::printf("| %s | %zu | | | %zu tetrahedra, %zu edges asked%s | %s |\n", adversary.name.c_str(),
    cloud.size(), counts.cells, counts.edges, isWithin ? "" : ", TOO MANY",
    counts.cells > 0 ? std::to_string(found).c_str() : "error");
  std::fflush(stdout);
  return isWithin;
}

/// Prints the row of a cloud. @returns whether it is within the limits
bool measure(const Adversary& adversary, const Options& options)
{
  const Cloud cloud = adversary.make(static_cast<std::size_t>(adversary.share * options.samples));
  isopoint::TetrahedraCounts counts;
  std::size_t found = 0;
  std::size_t expected = 0;
  double full = HUGE_VAL;
  double ours = HUGE_VAL;
  for (int run = 0; run < 2; ++run) // the faster one counts; the machine's load may change
  {
    full = std::min(full,
      seconds(options, [&]() { expected = countInFull(cloud, adversary, options.cgalThreads); }));
    ours =
      std::min(ours, seconds(options, [&]()
                       { found = countFound(cloud, adversary, options.threads, counts, false); }));
  }
  isopoint::TetrahedraCounts ofBudget;
  std::size_t kept = 0;
  const bool isWithin = isWithinBudget(cloud, adversary, options.threads, ofBudget, kept);
  std::printf("| %s | %zu | %.2f | %.2f | %zu + %zu in %zu rounds%s%s | %zu%s |\n",
    adversary.name.c_str(), cloud.size(), full, ours / full, counts.atSurface,
    counts.size - counts.atSurface, counts.rounds, counts.isWhole ? ", all" : "",
    isWithin ? "" : ", TOO MANY", found, found == expected ? "" : ", WRONG");
  std::fflush(stdout);
  return isWithin && ours / full <= largestShare;
}

} // namespace

int main(int argumentCount, char** arguments)
{
  const std::vector<std::string> words(arguments + 1, arguments + argumentCount);
  const auto numberAt = [&words](std::size_t i, double usual)
  { return i < words.size() ? std::atof(words[i].c_str()) : usual; };
  const Options options{ numberAt(0, 200000.0), static_cast<std::size_t>(numberAt(1, 1.0)),
    static_cast<std::size_t>(numberAt(2, 1.0)), words.size() > 3 ? words[3] : "" };
  if (words.size() > 4 || options.samples < 1.0 || options.threads < 1 || options.cgalThreads < 1)
  {
    std::fputs(usage, stderr);
    return 2;
  }
  std::puts("| cloud | samples | CGAL, seconds | share | band + inserted | tetrahedra or facets |\n"
            "|---|---|---|---|---|---|");
  bool isWithinLimit = true;
  for (const Adversary& adversary : adversaries())
  {
    if (adversary.name.find(options.only) != std::string::npos)
    {
      const bool isWithin =
        adversary.isOnCurves ? measureCurve(adversary, options) : measure(adversary, options);
      isWithinLimit = isWithin && isWithinLimit;
    }
  }
  return isWithinLimit ? 0 : 1;
}
