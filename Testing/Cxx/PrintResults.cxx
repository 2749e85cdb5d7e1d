// SPDX-License-Identifier: GPL-3.0-or-later
// Prints a hash of all that the core yields for each of several clouds and requests. What it prints
// is to be the same for all compilers, libraries and processors: Utilities/compile_elsewhere.sh.
// Fields are polynomials and their maxima, which no library of functions takes part in.
#include "Random.h"

#include "Core/IsosurfaceExtractor.h"

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <type_traits>
#include <vector>

namespace
{

using isopoint::FitOrder;
using isopoint::Vector;

using Field = double (*)(double x, double y, double z);

double smooth(double x, double y, double z)
{
  return x * x + 0.7 * y * y + z * z * z - x * y * z - 0.06;
}

double sharp(double x, double y, double z)
{
  return std::max({ std::abs(x), std::abs(y), std::abs(z) }) - 0.3;
}

/// Around the origin.
struct Cloud
{
  std::vector<Vector> positions;
  std::vector<double> values;

  void add(const Vector& position, Field field)
  {
    this->positions.push_back(position);
    this->values.push_back(field(position[0], position[1], position[2]));
  }
};

Cloud randomCloud(Field field)
{
  clouds::Random random(7);
  Cloud cloud;
  for (int i = 0; i < 6000; ++i)
  {
    const double x = random() - 0.5;
    const double y = random() - 0.5;
    cloud.add({ x, y, random() - 0.5 }, field);
  }
  return cloud;
}

Cloud lattice(Field field)
{
  constexpr int side = 17;
  Cloud cloud;
  for (int i = 0; i < side * side * side; ++i)
  {
    cloud.add(
      { (i % side - 8) / 16.0, (i / side % side - 8) / 16.0, (i / side / side - 8) / 16.0 }, field);
  }
  return cloud;
}

/// FNV-1a of the bytes of numbers.
class Hash
{
public:
  template <class T>
  void add(const T& number)
  {
    static_assert(std::is_arithmetic_v<T>, "structures have bytes between their members");
    const auto* const bytes = reinterpret_cast<const unsigned char*>(&number);
    std::for_each(bytes, bytes + sizeof(number),
      [this](unsigned char byte) { this->Value = (this->Value ^ byte) * 1099511628211u; });
  }

  template <class... Numbers>
  void addAll(const Numbers&... lists)
  {
    const auto addList = [this](const auto& list)
    { std::for_each(list.begin(), list.end(), [this](const auto& number) { this->add(number); }); };
    (addList(lists), ...);
  }

  std::uint64_t value() const { return this->Value; }

private:
  std::uint64_t Value = 14695981039346656037u;
};

std::uint64_t hashOf(const isopoint::ExtractedIsosurface& found)
{
  Hash hash;
  for (std::size_t i = 0; i < found.surface.size(); ++i)
  {
    for (std::size_t k = found.surface.edgeBegin(i); k < found.surface.edgeBegin(i + 1); ++k)
    {
      hash.add(std::uint64_t{ found.surface.edges[k].first });
      hash.add(std::uint64_t{ found.surface.edges[k].second });
      hash.add(found.surface.edges[k].parameter);
    }
    hash.addAll(found.surface.positions[i], found.surface.decreasingEdges[i]);
  }
  for (const isopoint::LocalFit& fit : found.surface.fits)
  {
    hash.addAll(fit.position, fit.gradient, fit.hessian);
    hash.add(fit.spacing);
    for (const isopoint::CreasePlane& crease : fit.creases)
    {
      hash.addAll(crease.inward);
      hash.add(crease.distance);
    }
  }
  for (const isopoint::Splat& splat : found.splats)
  {
    hash.addAll(splat.normal, splat.axis);
    hash.add(splat.radius);
    for (const isopoint::SplatCorner& corner : splat.corners)
    {
      hash.addAll(std::array{
        corner.along, corner.across, corner.height, corner.slopeAlong, corner.slopeAcross });
    }
  }
  for (const Vector& normal : found.normals)
  {
    hash.addAll(normal);
  }
  for (const isopoint::SurfaceTriangle& triangle : found.triangles)
  {
    for (const std::size_t corner : triangle)
    {
      hash.add(std::uint64_t{ corner });
    }
  }
  return hash.value();
}

template <class TCoordinate, class TValue>
void print(const char* name, const Cloud& cloud)
{
  constexpr std::array names{ "linear", "quadratic", "cubic", "crease" };
  const isopoint::Execution execution;
  isopoint::IsosurfaceExtractor extractor;
  extractor.load<TCoordinate, TValue>(execution, cloud.values.size(),
    [&cloud](std::size_t id, auto* position, auto& value)
    {
      std::copy(cloud.positions[id].begin(), cloud.positions[id].end(), position);
      value = static_cast<std::decay_t<decltype(value)>>(cloud.values[id]);
      return true;
    });
  for (const std::optional<FitOrder> order : { std::optional<FitOrder>(),
         std::optional(FitOrder::Linear), std::optional(FitOrder::Quadratic),
         std::optional(FitOrder::Cubic), std::optional(FitOrder::Crease) })
  {
    constexpr std::array kinds{ "splats", "triangles", "regularized triangles" };
    for (std::size_t kind = 0; kind < kinds.size(); ++kind)
    {
      isopoint::ExtractionRequest request;
      request.isosurface.isovalue = 0.0;
      request.isosurface.dropsGaps = true;
      request.isosurface.fit =
        order ? std::optional(isopoint::FitRequest{ *order, true }) : std::nullopt;
      request.isosurface.partsCreases = order == FitOrder::Crease;
      request.splats = isopoint::SplatOptions();
      request.triangles = kind > 0;
      request.isosurface.regularizes = kind > 1;
      const isopoint::ExtractedIsosurface found = extractor.extract(execution, request);
      std::printf("%s %s %s: %zu points, %zu triangles, %016" PRIx64 "\n", name,
        order ? names[static_cast<std::size_t>(*order) - 1] : "no fit", kinds[kind],
        found.surface.size(), found.triangles.size(), hashOf(found));
    }
  }
}

} // namespace

int main()
{
  print<float, float>("random", randomCloud(smooth));
  print<double, double>("random sharp", randomCloud(sharp));
  print<double, float>("lattice", lattice(smooth));
  print<float, double>("lattice sharp", lattice(sharp));
}
