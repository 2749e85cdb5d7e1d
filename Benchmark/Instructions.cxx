// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * InstructionsBenchmark CASE: runs a case on one thread of each rank, and prints a hash of its
 * results. Callgrind with --collect-atstart=no counts the instructions of what the case is about,
 * without its preparations. See instructions.py.
 */
#include "Clouds.h"
#include "ThreadRanks.h"

#include "Core/Base/Hash.h"
#include "Library/isopoint.h"

#include <valgrind/callgrind.h>

#include <cstdio>
#include <map>
#include <string>

namespace
{

using clouds::Cloud;

constexpr std::size_t sampleCount = 20000;
constexpr double radius = 0.35;

void check(isopoint_status status)
{
  if (status != ISOPOINT_OK)
  {
    std::fprintf(stderr, "%s\n", isopoint_get_error());
    std::exit(1);
  }
}

/// Counts the instructions of this thread.
template <class Work>
void count(const Work& work)
{
  CALLGRIND_TOGGLE_COLLECT;
  work();
  CALLGRIND_TOGGLE_COLLECT;
}

std::uint64_t hashOfBytes(const void* bytes, std::size_t count)
{
  return isopoint::hashOf({}, static_cast<const unsigned char*>(bytes), count);
}

/// Coordinates are multiples of 2^-10, so that predicates are exact: Valgrind ignores the directed
/// rounding of intervals.
Cloud rounded(Cloud cloud)
{
  for (double& coordinate : cloud.positions)
  {
    coordinate = std::ldexp(std::round(std::ldexp(coordinate, 10)), -10);
  }
  return clouds::withValuesOf(std::move(cloud), clouds::fromMiddle);
}

isopoint_array arrayOf(const std::vector<double>& numbers, int components)
{
  return { numbers.data(), ISOPOINT_DOUBLE, components,
    static_cast<std::int64_t>(numbers.size()) / components, 0, 0 };
}

/// Samples in the C library, on one thread, and the last surface.
class Samples
{
public:
  explicit Samples(Cloud cloud)
    : All(std::move(cloud))
  {
    check(isopoint_set_extractor_threads(this->Extractor, 1));
    isopoint_initialize_options(&this->Options, sizeof(this->Options));
    this->load();
  }

  ~Samples()
  {
    isopoint_destroy_surface(this->Surface);
    isopoint_destroy_extractor(this->Extractor);
  }

  Samples(const Samples&) = delete;
  Samples& operator=(const Samples&) = delete;

  void load()
  {
    const isopoint_array positions = arrayOf(this->All.positions, 3);
    const isopoint_array values = arrayOf(this->All.values, 1);
    check(isopoint_set_samples(this->Extractor, &positions, &values, nullptr));
  }

  void extract(double isovalue)
  {
    isopoint_destroy_surface(this->Surface);
    check(isopoint_extract(this->Extractor, &isovalue, 1, &this->Options, &this->Surface));
  }

  void probe(const Cloud& where)
  {
    const isopoint_array places = arrayOf(where.positions, 3);
    const isopoint_array values = arrayOf(this->All.values, 1);
    this->Values.resize(where.size());
    const isopoint_probe_result probed{ this->Values.data(), sizeof(double) * this->Values.size(),
      nullptr, 0 };
    check(isopoint_probe(this->Extractor, &places, &values, 1, nullptr, &probed, nullptr, 0));
  }

  void meshSplats() { check(isopoint_make_splat_mesh(this->Surface, 1.0)); }

  std::uint64_t hash() const
  {
    std::uint64_t hash = hashOfBytes(this->Values.data(), sizeof(double) * this->Values.size());
    for (std::int32_t id = ISOPOINT_ARRAY_POINTS;
         this->Surface && id <= ISOPOINT_ARRAY_SPLAT_TRIANGLES; ++id)
    {
      isopoint_array array{};
      check(isopoint_get_array(this->Surface, id, &array));
      constexpr std::array<std::size_t, 10> sizes{ 4, 8, 1, 1, 2, 2, 4, 4, 8, 8 };
      hash = isopoint::extendedHash(
        hash, hashOfBytes(array.data, sizes[static_cast<std::size_t>(array.type)] *
                                        static_cast<std::size_t>(array.components) *
                                        static_cast<std::size_t>(array.count)));
    }
    return hash;
  }

  Cloud All;
  isopoint_options Options{};

private:
  isopoint_extractor* const Extractor = isopoint_create_extractor();
  isopoint_surface* Surface = nullptr;
  std::vector<double> Values;
};

std::uint64_t points()
{
  Samples samples(rounded(clouds::uniform(sampleCount, 1)));
  count([&]() { samples.extract(radius); });
  return samples.hash();
}

std::uint64_t nextIsovalue()
{
  Samples samples(rounded(clouds::uniform(sampleCount, 1)));
  samples.extract(radius);
  count([&]() { samples.extract(radius + 0.01); });
  return samples.hash();
}

std::uint64_t triangles()
{
  Samples samples(rounded(clouds::uniform(sampleCount, 2)));
  samples.Options.triangles = 1;
  count([&]() { samples.extract(radius); });
  return samples.hash();
}

/// Kept tetrahedra make it cheaper than the first.
std::uint64_t nextTriangles()
{
  Samples samples(rounded(clouds::uniform(sampleCount, 2)));
  samples.Options.triangles = 1;
  samples.extract(radius);
  count([&]() { samples.extract(radius + 0.001); });
  return samples.hash();
}

/// Its spheres pass through many samples, which predicates on integers decide.
std::uint64_t latticeTriangles()
{
  Samples samples(clouds::withValuesOf(clouds::lattice(27, 27, 27),
    [](const clouds::Vector& p) {
      return isopoint::lengthOf(p - clouds::Vector{ 13.0, 13.0, 13.0 });
    }));
  samples.Options.triangles = 1;
  samples.Options.projection = ISOPOINT_PROJECTION_NONE;
  count([&]() { samples.extract(9.3); });
  return samples.hash();
}

std::uint64_t gaps()
{
  // A slit between two halves.
  Samples samples(rounded(clouds::filtered(clouds::uniform(sampleCount, 3),
    [](const clouds::Vector& p) { return std::abs(p[0] - 0.5) > 0.1; })));
  samples.Options.compute_splats = samples.Options.compute_normals = 0;
  samples.Options.projection = ISOPOINT_PROJECTION_NONE;
  count([&]() { samples.extract(radius); });
  return samples.hash();
}

std::uint64_t splatMesh()
{
  Samples samples(rounded(clouds::uniform(sampleCount, 4)));
  samples.extract(radius);
  count([&]() { samples.meshSplats(); });
  return samples.hash();
}

std::uint64_t newValues()
{
  Samples samples(rounded(clouds::uniform(sampleCount, 5)));
  samples.extract(radius);
  for (double& value : samples.All.values)
  {
    value += 0.01;
  }
  count(
    [&]()
    {
      samples.load();
      samples.extract(radius);
    });
  return samples.hash();
}

std::uint64_t places()
{
  Samples samples(rounded(clouds::uniform(sampleCount, 6)));
  const Cloud where = clouds::uniform(2000, 7);
  count([&]() { samples.probe(where); });
  return samples.hash();
}

/// Many small calls: what each costs besides its samples.
std::uint64_t smallCalls()
{
  Samples samples(rounded(clouds::uniform(50, 8)));
  count(
    [&]()
    {
      for (int i = 0; i < 100; ++i)
      {
        samples.load();
        samples.extract(radius);
      }
    });
  return samples.hash();
}

std::uint64_t twoRanks()
{
  std::array<std::uint64_t, 2> hashes{};
  ThreadRanks(2).run(
    [&](isopoint::Communicator& communicator)
    {
      isopoint::ProcessGroup processes(communicator);
      processes.runCollectively(
        [&]()
        {
          const auto rank = static_cast<std::size_t>(processes.rank());
          const Cloud cloud = rounded(clouds::uniform(sampleCount / 2, 9 + rank));
          isopoint::IsosurfaceExtractor extractor;
          isopoint::ExtractedIsosurface found;
          count(
            [&]()
            {
              extractor.load<double, double>({}, processes, cloud.size(), clouds::readerOf(cloud));
              found = extractor.extract({}, clouds::requestOf(radius, isopoint::FitOrder::Cubic));
            });
          for (const isopoint::Vector& position : found.surface.positions)
          {
            hashes[rank] =
              isopoint::extendedHash(hashes[rank], hashOfBytes(position.data(), sizeof(position)));
          }
        });
    });
  return isopoint::extendedHash(hashes[0], hashes[1]);
}

} // namespace

int main(int argc, char** argv)
{
  const std::map<std::string, std::uint64_t (*)()> cases{ { "points", points },
    { "next isovalue", nextIsovalue }, { "triangles", triangles },
    { "next triangles", nextTriangles }, { "lattice triangles", latticeTriangles },
    { "gaps", gaps }, { "splat mesh", splatMesh }, { "new values", newValues },
    { "places", places }, { "small calls", smallCalls }, { "two ranks", twoRanks } };
  const auto found = argc == 2 ? cases.find(argv[1]) : cases.end();
  if (found != cases.end())
  {
    std::printf("%016llx\n", static_cast<unsigned long long>(found->second()));
    return 0;
  }
  for (const auto& [name, run] : cases)
  {
    std::printf("%s\n", name.c_str());
  }
  return 2;
}
