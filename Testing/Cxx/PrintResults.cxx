// SPDX-License-Identifier: GPL-3.0-or-later
// Prints a hash of all that the core yields for each of several clouds and requests. The output is
// the same for all compilers, libraries and processors: Utilities/compile_elsewhere.sh. So fields
// are polynomials and their maxima, without functions of libraries.
#include "Clouds.h"

#include <cinttypes>
#include <cstdio>

namespace
{

using clouds::Cloud;
using isopoint::FitOrder;
using isopoint::Vector;

double smooth(const Vector& p)
{
  const auto& [x, y, z] = p;
  return x * x + 0.7 * y * y + z * z * z - x * y * z - 0.06;
}

double sharp(const Vector& p)
{
  return std::max({ std::abs(p[0]), std::abs(p[1]), std::abs(p[2]) }) - 0.3;
}

Cloud randomCloud(double (*field)(const Vector&))
{
  clouds::Random random(7);
  Cloud cloud;
  for (int i = 0; i < 6000; ++i)
  {
    const Vector p = random.inCube(1.0);
    cloud.add(p, field(p));
  }
  return cloud;
}

Cloud lattice(double (*field)(const Vector&))
{
  constexpr int side = 17;
  Cloud cloud;
  for (int i = 0; i < side * side * side; ++i)
  {
    const Vector p{ (i % side - 8) / 16.0, (i / side % side - 8) / 16.0,
      (i / side / side - 8) / 16.0 };
    cloud.add(p, field(p));
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
  constexpr std::array names{ "no fit", "linear", "quadratic", "cubic", "crease" };
  constexpr std::array kinds{ "splats", "triangles", "regularized triangles" };
  isopoint::IsosurfaceExtractor extractor = clouds::loaded<TCoordinate, TValue>(cloud);
  for (std::size_t i = 0; i < names.size() * kinds.size(); ++i)
  {
    const std::size_t kind = i % kinds.size();
    const auto order = static_cast<FitOrder>(i / kinds.size());
    isopoint::ExtractionRequest request = clouds::withSplats(clouds::requestOf(
      0.0, i < kinds.size() ? std::nullopt : std::optional<FitOrder>(order), true));
    request.isosurface.partsCreases = order == FitOrder::Crease;
    request.triangles = kind > 0;
    request.isosurface.regularizes = kind > 1;
    const isopoint::ExtractedIsosurface found = extractor.extract({}, request);
    std::printf("%s %s %s: %zu points, %zu triangles, %016" PRIx64 "\n", name,
      names[i / kinds.size()], kinds[kind], found.surface.size(), found.triangles.size(),
      hashOf(found));
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
