// SPDX-License-Identifier: GPL-3.0-or-later
#include "Library/Surface.h"

#include "Core/Base/Vector.h"
#include "Core/Failure.h"
#include "Core/OutputArrays.h"
#include "Core/SplatMesh/SplatFan.h"
#include "Library/Arrays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

namespace
{

template <class T>
constexpr std::int32_t typeOf()
{
  return std::is_same_v<T, float>          ? ISOPOINT_FLOAT
         : std::is_same_v<T, double>       ? ISOPOINT_DOUBLE
         : std::is_same_v<T, std::uint8_t> ? ISOPOINT_UINT8
                                           : ISOPOINT_INT64;
}

/// A view of contiguous numbers for the caller.
template <class T>
isopoint_array asArray(const std::vector<T>& numbers, int components)
{
  const auto tuples = static_cast<std::int64_t>(numbers.size()) / components;
  return { numbers.empty() ? nullptr : numbers.data(), typeOf<T>(), components, tuples, 0, 0 };
}

isopoint_array asArray(const isopoint_surface::Coordinates& coordinates)
{
  return std::visit([](const auto& numbers) { return asArray(numbers, 3); }, coordinates);
}

/// Allocates `components` numbers for each of `count` points, if wanted.
template <class T>
T* prepare(std::vector<T>& numbers, bool areWanted, std::size_t count, std::size_t components)
{
  numbers.resize(areWanted ? components * count : 0);
  return areWanted ? numbers.data() : nullptr;
}

/// Coordinates for `count` positions.
isopoint_surface::Coordinates makeCoordinates(bool areFloat, std::size_t count)
{
  return areFloat ? isopoint_surface::Coordinates(std::vector<float>(3 * count))
                  : isopoint_surface::Coordinates(std::vector<double>(3 * count));
}

/// Copies the numbers of an array of points.
/// @throws UsageError unless there are `count` tuples of `components` numbers of type T
template <class T>
std::vector<T> numbersOf(
  const isopoint_array* array, const char* name, std::size_t count, std::size_t components)
{
  const isopoint::ArrayReader reader(array, name);
  reader.require(count, static_cast<int>(components));
  if (reader.type() != typeOf<T>())
  {
    throw isopoint::UsageError(std::string("The array of ") + name + " has the type " +
                                 std::to_string(reader.type()) + ". Pass the type " +
                                 std::to_string(typeOf<T>()) + " of isopoint_type.",
      isopoint::UsageError::Array);
  }
  if (const T* const contiguous = reader.contiguous<T>())
  {
    return { contiguous, contiguous + components * count };
  }
  std::vector<T> numbers;
  numbers.reserve(components * count);
  for (std::size_t i = 0; i < components * count; ++i)
  {
    numbers.push_back(reader.at<T>(i / components, static_cast<int>(i % components)));
  }
  return numbers;
}

isopoint_surface::Coordinates coordinatesOf(const isopoint_array* points)
{
  const isopoint::ArrayReader reader(points, "the points");
  reader.requireFloatingPoint();
  if (reader.type() == ISOPOINT_FLOAT)
  {
    return numbersOf<float>(points, "the points", reader.count(), 3);
  }
  return numbersOf<double>(points, "the points", reader.count(), 3);
}

} // namespace

isopoint_surface::isopoint_surface(const isopoint::Execution& making,
  std::vector<isopoint::ExtractedIsosurface> surfaces, const isopoint::Options& chosen,
  bool areFloatPositions, const isopoint::Report& counts, std::size_t samples)
  : execution(making)
  , options(chosen)
  , isExtracted(true)
  , report(counts)
  , SampleCount(samples)
  , Isosurfaces(std::move(surfaces))
  , Points(makeCoordinates(isopoint::isSinglePrecision(options, areFloatPositions),
      isopoint::countIsopoints(this->Isosurfaces)))
{
  const std::size_t count = isopoint::countIsopoints(this->Isosurfaces);
  this->Isovalues.resize(count);
  this->Triangles.resize(3 * isopoint::countTriangles(this->Isosurfaces));
  isopoint::OutputArrays arrays;
  arrays.normals = prepare(this->Normals, options.computeNormals, count, 3);
  arrays.gradients = prepare(this->Gradients, options.computeGradients, count, 3);
  arrays.projectionOrders =
    prepare(this->ProjectionOrders, options.computeProjectionOrders, count, 1);
  arrays.radii = prepare(this->Radii, options.computeSplats, count, 1);
  arrays.splatAxes = prepare(this->SplatAxes, options.computeSplats, count, 3);
  arrays.splatPolygons =
    prepare(this->SplatPolygons, options.computeSplats, count, isopoint::numbersOfSplat);
  std::size_t first = 0;
  std::int64_t* corners = this->Triangles.data();
  for (isopoint::ExtractedIsosurface& isosurface : this->Isosurfaces)
  {
    isopoint::writeArrays(execution, isosurface, options.projection != 0, first, arrays);
    isopoint::writeTriangles(execution, isosurface, first, corners);
    std::visit([&](auto& numbers)
      { isopoint::writePositions(execution, isosurface.surface, numbers.data() + 3 * first); },
      this->Points);
    std::fill_n(this->Isovalues.begin() + static_cast<std::ptrdiff_t>(first),
      isosurface.surface.size(), isosurface.surface.isovalue);
    first += isosurface.surface.size();
    corners += 3 * isosurface.triangles.size();
    this->Caps.insert(this->Caps.end(), isosurface.areCaps.begin(), isosurface.areCaps.end());
    // What interpolation needs.
    isopoint::ExtractedIsosurface kept;
    kept.surface.edges = std::move(isosurface.surface.edges);
    kept.surface.edgeBegins = std::move(isosurface.surface.edgeBegins);
    kept.surface.coincident = std::move(isosurface.surface.coincident);
    isosurface = std::move(kept);
  }
}

isopoint_surface::isopoint_surface(const isopoint::Execution& making, const isopoint_array* points,
  const isopoint_array* normals, const isopoint_array* axes, const isopoint_array* polygons)
  : execution(making)
  , Points(coordinatesOf(points))
  , Normals(numbersOf<float>(normals, "the normals", this->pointCount(), 3))
  , SplatAxes(numbersOf<float>(axes, "the splat axes", this->pointCount(), 3))
  , SplatPolygons(numbersOf<float>(
      polygons, "the splat polygons", this->pointCount(), isopoint::numbersOfSplat))
{
}

std::size_t isopoint_surface::pointCount() const
{
  return std::visit([](const auto& numbers) { return numbers.size() / 3; }, this->Points);
}

void isopoint_surface::listEdges() const
{
  std::vector<std::int64_t> edges;
  std::vector<double> parameters;
  edges.reserve(2 * this->pointCount());
  parameters.reserve(this->pointCount());
  for (const isopoint::ExtractedIsosurface& isosurface : this->Isosurfaces)
  {
    for (std::size_t i = 0; i < isosurface.surface.size(); ++i)
    {
      const isopoint::IsopointEdge& edge = isosurface.surface.edgeOf(i);
      edges.push_back(static_cast<std::int64_t>(edge.first));
      edges.push_back(static_cast<std::int64_t>(edge.second));
      parameters.push_back(edge.parameter);
    }
  }
  this->Edges.swap(edges);
  this->EdgeParameters.swap(parameters);
}

isopoint_array isopoint_surface::array(std::int32_t id) const
{
  if ((id == ISOPOINT_ARRAY_EDGES || id == ISOPOINT_ARRAY_EDGE_PARAMETERS) &&
      this->EdgeParameters.empty())
  {
    this->listEdges();
  }
  const SplatArrays none(
    this->execution, isopoint::buildSplatMesh({}, 0, {}), this->hasFloatPoints());
  const SplatArrays& splats = this->Splats ? *this->Splats : none;
  const std::array<isopoint_array, ISOPOINT_ARRAY_CAPS + 1> arrays{
    asArray(this->Points),
    asArray(this->Isovalues, 1),
    asArray(this->Normals, 3),
    asArray(this->Gradients, 3),
    asArray(this->ProjectionOrders, 1),
    asArray(this->Edges, 2),
    asArray(this->EdgeParameters, 1),
    asArray(this->Triangles, 3),
    asArray(this->Radii, 1),
    asArray(this->SplatAxes, 3),
    asArray(this->SplatPolygons, static_cast<int>(isopoint::numbersOfSplat)),
    asArray(splats.vertices),
    asArray(splats.normals, 3),
    asArray(splats.points, 1),
    asArray(splats.triangles, 3),
    asArray(this->Caps, 1),
  }; // by isopoint_array_id
  if (id < 0 || static_cast<std::size_t>(id) >= arrays.size())
  {
    throw isopoint::UsageError(
      "There is no array " + std::to_string(id) + ". Use an isopoint_array_id.");
  }
  return arrays[static_cast<std::size_t>(id)];
}

void isopoint_surface::interpolate(
  const isopoint_array* ofSamples, void* result, std::size_t size) const
{
  if (!this->isExtracted)
  {
    throw isopoint::UsageError("A surface made by isopoint_create_surface() has no samples. Extract"
                               " one by isopoint_extract().",
      isopoint::UsageError::Order);
  }
  const isopoint::ArrayReader reader(ofSamples, "the samples");
  reader.require(this->SampleCount, reader.components());
  const auto components = static_cast<std::size_t>(reader.components());
  isopoint::requireMemory(result, size, "the result", this->Isovalues.size(),
    components * isopoint::sizeOfType(reader.type()));
  isopoint::withType(reader.type(),
    [&](auto type)
    {
      using T = decltype(type);
      T* next = static_cast<T*>(result);
      for (const isopoint::ExtractedIsosurface& isosurface : this->Isosurfaces)
      {
        isopoint::interpolateComponents(
          this->execution, isosurface.surface, reader.components(),
          [&](std::uint64_t sample, int component) {
            return static_cast<double>(reader.at<T>(static_cast<std::size_t>(sample), component));
          },
          [&](std::size_t i, int component, double value) {
            next[components * i + static_cast<std::size_t>(component)] =
              isopoint::toArrayType<T>(value);
          });
        if (!this->Caps.empty())
        {
          isopoint::forEachAtSample(this->execution, isosurface.surface,
            [&](std::size_t i, std::uint64_t sample)
            {
              for (std::size_t component = 0; component < components; ++component)
              {
                next[components * i + component] =
                  reader.at<T>(static_cast<std::size_t>(sample), static_cast<int>(component));
              }
            });
        }
        next += components * isosurface.surface.size();
      }
    });
}

void isopoint_surface::makeSplatMesh(double scale)
{
  if (!(scale > 0.0) || !std::isfinite(scale))
  {
    throw isopoint::UsageError(
      "The scale of splats is " + std::to_string(scale) + ". Pass a finite number above 0.");
  }
  if ((this->SplatAxes.empty() || this->Normals.empty()) && this->pointCount() > 0)
  {
    throw isopoint::UsageError("The surface has no splats. Extract points with compute_splats and"
                               " compute_normals.",
      isopoint::UsageError::Order);
  }
  const bool areFloat = this->hasFloatPoints();
  const double error = isopoint::positionErrorOf(areFloat);
  const auto fanAt = [&](std::size_t point)
  {
    const auto vectorAt = [point](const auto& numbers)
    {
      return isopoint::Vector{ static_cast<double>(numbers[3 * point]),
        static_cast<double>(numbers[3 * point + 1]), static_cast<double>(numbers[3 * point + 2]) };
    };
    const isopoint::Vector position = std::visit(vectorAt, this->Points);
    if (!isopoint::isFinite(position))
    {
      return isopoint::SplatFan{};
    }
    isopoint::SplatNumbers numbers;
    std::copy_n(
      this->SplatPolygons.begin() + static_cast<std::ptrdiff_t>(isopoint::numbersOfSplat * point),
      isopoint::numbersOfSplat, numbers.begin());
    return isopoint::fanOf(position, isopoint::unitNormal(vectorAt(this->Normals)),
      vectorAt(this->SplatAxes), numbers, scale, error);
  };
  const isopoint::Execution making = isopoint::partOf(this->execution, 0.0, 0.9);
  this->Splats = SplatArrays(
    this->execution, isopoint::buildSplatMesh(making, this->pointCount(), fanAt), areFloat);
  this->execution.progress(1.0);
}

isopoint_surface::SplatArrays::SplatArrays(
  const isopoint::Execution& execution, isopoint::SplatMesh made, bool areFloat)
  : mesh(std::move(made))
  , vertices(makeCoordinates(areFloat, this->mesh.vertices.size()))
  , normals(3 * this->mesh.vertices.size())
  , points(this->mesh.vertices.size())
  , triangles(3 * this->mesh.triangles.size())
{
  std::visit(
    [&](auto& coordinates)
    {
      isopoint::forEachIndex(execution, this->mesh.vertices.size(),
        [&](std::size_t i)
        {
          const isopoint::SplatVertex& vertex = this->mesh.vertices[i];
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            using T = std::decay_t<decltype(coordinates[0])>;
            coordinates[3 * i + axis] = static_cast<T>(vertex.position[axis]);
            this->normals[3 * i + axis] = vertex.normal[axis];
          }
          this->points[i] = static_cast<std::int64_t>(this->mesh.pointOfVertex[i]);
        });
    },
    this->vertices);
  isopoint::forEachIndex(execution, this->mesh.triangles.size(),
    [&](std::size_t i)
    {
      std::transform(this->mesh.triangles[i].begin(), this->mesh.triangles[i].end(),
        this->triangles.begin() + static_cast<std::ptrdiff_t>(3 * i),
        [](std::size_t vertex) { return static_cast<std::int64_t>(vertex); });
    });
}

void isopoint_surface::averageAtSplatVertices(
  const isopoint_array* ofPoints, void* result, std::size_t size) const
{
  if (!this->Splats)
  {
    throw isopoint::UsageError("There is no splat mesh. Call isopoint_make_splat_mesh() first.",
      isopoint::UsageError::Order);
  }
  const isopoint::ArrayReader reader(ofPoints, "the points");
  reader.require(this->pointCount(), reader.components());
  reader.requireFloatingPoint();
  const auto components = static_cast<std::size_t>(reader.components());
  isopoint::requireMemory(result, size, "the result", this->Splats->mesh.vertices.size(),
    components * isopoint::sizeOfType(reader.type()));
  const auto average = [&](auto type)
  {
    using T = decltype(type);
    isopoint::meansAtVertices(
      this->execution, this->Splats->mesh, components,
      [&](std::size_t point, std::size_t i)
      { return static_cast<double>(reader.at<T>(point, static_cast<int>(i))); },
      static_cast<T*>(result));
  };
  reader.type() == ISOPOINT_FLOAT ? average(float{}) : average(double{});
}
