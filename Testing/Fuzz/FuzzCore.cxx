// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds made of a fuzzer's bytes: the core must give, to the last bit, what brute force gives.
#include "ByteSource.h"

#include "../Cxx/BruteForce.h"
#include "../Cxx/Clouds.h"

#include <cmath>
#include <cstring>
#include <optional>
#include <set>
#include <utility>

namespace
{

using clouds::Cloud;

template <class TCoordinate, class TValue>
Cloud readCloud(ByteSource& bytes, std::size_t count)
{
  const int coordinateKind = bytes.below(4);
  const int valueKind = bytes.below(4);
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i)
  {
    double p[3];
    for (double& coordinate : p)
    {
      coordinate = asHeld<TCoordinate>(bytes.number(coordinateKind));
    }
    cloud.add(p[0], p[1], p[2], asHeld<TValue>(bytes.number(valueKind)));
  }
  return cloud;
}

/// Copies the finite samples alone. @returns their ids among all
std::vector<std::uint64_t> copyFinite(const Cloud& all, Cloud& finite)
{
  std::vector<std::uint64_t> ids;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const double* const p = all.positions.data() + 3 * i;
    if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]) &&
        std::isfinite(all.values[i]))
    {
      finite.add(p[0], p[1], p[2], all.values[i]);
      ids.push_back(i);
    }
  }
  return ids;
}

void compare(
  const Cloud& all, double isovalue, double angle, const std::vector<isopoint::IsopointEdge>& found)
{
  Cloud finite;
  const std::vector<std::uint64_t> ids = copyFinite(all, finite);
  const std::vector<bruteforce::Isopoint> expected = bruteforce::extract(finite, isovalue, angle);
  require(expected.size() == found.size(), "the number of isopoints");
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    require(ids[expected[i].first] == found[i].first && ids[expected[i].second] == found[i].second,
      "an edge");
    require(
      std::memcmp(&expected[i].parameter, &found[i].parameter, sizeof(double)) == 0, "a parameter");
  }
}

/// The surface of a body is closed: each side of a triangle has one opposite side.
void requireClosed(const isopoint::ExtractedIsosurface& body)
{
  std::set<std::pair<std::size_t, std::size_t>> sides;
  for (const isopoint::SurfaceTriangle& corners : body.triangles)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      require(sides.emplace(corners[i], corners[(i + 1) % 3]).second, "a side of one triangle");
    }
  }
  for (const auto& [start, end] : sides)
  {
    require(sides.count({ end, start }) == 1, "an opposite side");
  }
}

template <class TCoordinate, class TValue>
void run(ByteSource& bytes)
{
  const std::size_t count = static_cast<std::size_t>(bytes.below(100));
  const isopoint::Execution execution = clouds::executionOn(bytes.below(8) == 0 ? 2 : 1);
  Cloud cloud = readCloud<TCoordinate, TValue>(bytes, count);
  isopoint::IsosurfaceExtractor extractor;
  extractor.load<TCoordinate, TValue>(execution, count, clouds::readerOf(cloud));
  for (int round = 0; round < 3; ++round)
  {
    const double angles[6] = { 54.7, 0.0, 30.0, 90.0, 120.0, 180.0 };
    const double angle = angles[bytes.below(6)];
    double isovalue = bytes.number(bytes.below(4));
    if (count > 0 && bytes.flag())
    {
      isovalue = cloud.values[static_cast<std::size_t>(bytes.below(100)) % count];
    }
    compare(
      cloud, isovalue, angle, clouds::extractFrom(extractor, execution, isovalue, angle).edges);
    if (bytes.flag())
    {
      auto request = clouds::withTriangles(clouds::requestOf(isovalue, std::nullopt, bytes.flag()));
      request.isosurface.caps = true;
      request.isosurface.regularizes = bytes.flag();
      if (bytes.flag())
      {
        request.isosurface.fit = { isopoint::FitOrder::Cubic, true };
      }
      requireClosed(extractor.extract(execution, request));
    }
    if (bytes.flag())
    {
      // New values at the same positions, some of them perhaps not finite.
      const int kind = bytes.below(4);
      for (double& value : cloud.values)
      {
        value = asHeld<TValue>(bytes.number(kind));
      }
      const auto read = clouds::readerOf(cloud);
      if (!extractor.replaceValues<TCoordinate, TValue>(execution, count, read))
      {
        extractor.load<TCoordinate, TValue>(execution, count, read);
      }
    }
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  ByteSource bytes(data, size);
  using Run = void (*)(ByteSource&);
  constexpr Run runs[4] = { run<float, float>, run<float, double>, run<double, float>,
    run<double, double> };
  runs[bytes.below(4)](bytes);
  return 0;
}
