// SPDX-License-Identifier: GPL-3.0-or-later
// Prints a hash of all that the core yields for each of several clouds and requests. The output is
// the same for all compilers, libraries and processors: Utilities/compile_elsewhere.sh. So fields
// are polynomials and their maxima, without functions of libraries.
#include "Descriptions.h"

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

/// The 64-bit FNV-1a hash of all that is known of a surface.
std::uint64_t hashOf(const isopoint::ExtractedIsosurface& found)
{
  std::uint64_t hash = 14695981039346656037u;
  const auto add = [&hash](const void* bytes, std::size_t size)
  {
    const auto* const begin = static_cast<const unsigned char*>(bytes);
    std::for_each(
      begin, begin + size, [&hash](unsigned char byte) { hash = (hash ^ byte) * 1099511628211u; });
  };
  for (const std::string& point : ranks::described(found))
  {
    add(point.data(), point.size());
  }
  for (const auto& [a, b, c] : found.triangles)
  {
    const std::uint64_t corners[3] = { a, b, c };
    add(corners, sizeof(corners));
  }
  return hash;
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
    request.isosurface.duplicatesCreaseVertices = order == FitOrder::Crease;
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
  const auto centered = [](const Cloud& cloud, double middle, double scale)
  {
    return clouds::moved(cloud,
      [=](double* p) { std::for_each(p, p + 3, [=](double& c) { c = (c - middle) * scale; }); });
  };
  const Cloud random = centered(clouds::uniform(6000, 7), 0.5, 1.0);
  const Cloud lattice = centered(clouds::lattice(17, 17, 17), 8.0, 1.0 / 16.0);
  print<float, float>("random", clouds::withValuesOf(random, smooth));
  print<double, double>("random sharp", clouds::withValuesOf(random, sharp));
  print<double, float>("lattice", clouds::withValuesOf(lattice, smooth));
  print<float, double>("lattice sharp", clouds::withValuesOf(lattice, sharp));
}
