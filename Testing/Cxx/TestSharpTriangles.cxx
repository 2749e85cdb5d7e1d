// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles of bodies with sharp edges: edges and corners are where the body has them, hardly a
// triangle looks the wrong way, and the surface is closed.
#include "FilterTesting.h"

#include "vtkScatteredIsosurfaceFilter.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkStaticCellLocator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

namespace
{

using filtertesting::newArray;
using Place = std::array<double, 3>;
using Field = std::function<double(const Place&)>;

constexpr double cubeSide = 0.6;
constexpr double boreRadius = 0.3;

double cube(const Place& p)
{
  return std::max({ std::abs(p[0]), std::abs(p[1]), std::abs(p[2]) }) - cubeSide;
}

double block(const Place& p)
{
  return std::max(cube(p), boreRadius - std::hypot(p[0], p[1]));
}

/// About the axes z and x.
Place turned(const Place& p)
{
  const double c = std::cos(0.5);
  const double s = std::sin(0.5);
  const Place q{ c * p[0] + s * p[1], c * p[1] - s * p[0], p[2] };
  return { q[0], c * q[1] + s * q[2], c * q[2] - s * q[1] };
}

double turnedCube(const Place& p)
{
  return cube(turned(p));
}

struct Body
{
  const char* name;
  Field field;
  bool hasRims;
};

constexpr vtkIdType sampleCount = 60000;
const double spacing = std::cbrt(8.0 / static_cast<double>(sampleCount));

/// Samples in a cube of side 2: random, or a lattice.
vtkSmartPointer<vtkPolyData> samplesOf(const Field& field, bool isLattice)
{
  const auto cloud = filtertesting::newCloud(sampleCount, VTK_DOUBLE);
  const auto size = static_cast<vtkIdType>(std::floor(std::cbrt(sampleCount)));
  if (isLattice)
  {
    cloud->GetPoints()->SetNumberOfPoints(size * size * size);
    for (vtkIdType i = 0; i < size * size * size; ++i)
    {
      const auto coordinate = [size](vtkIdType index)
      { return 2.0 * static_cast<double>(index % size) / static_cast<double>(size - 1) - 1.0; };
      cloud->GetPoints()->SetPoint(
        i, coordinate(i), coordinate(i / size), coordinate(i / size / size));
    }
  }
  cloud->GetPointData()->Initialize();
  const auto values = newArray<vtkDoubleArray>("f", cloud->GetNumberOfPoints());
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    Place p;
    cloud->GetPoint(i, p.data());
    values->SetValue(i, field(p));
  }
  cloud->GetPointData()->SetScalars(values);
  return cloud;
}

vtkSmartPointer<vtkPolyData> trianglesOf(const Field& field, bool isLattice, bool hasNormals)
{
  vtkNew<vtkScatteredIsosurfaceFilter> filter;
  filter->SetInputData(samplesOf(field, isLattice));
  filter->SetValue(0, 0.0);
  filter->SetProjection(vtkScatteredIsopointFilter::CREASE_FIT);
  filter->SetComputeNormals(hasNormals);
  filter->Update();
  return filter->GetOutput();
}

std::vector<std::array<vtkIdType, 3>> cornersOf(vtkPolyData* surface)
{
  std::vector<std::array<vtkIdType, 3>> corners;
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < surface->GetPolys()->GetNumberOfCells(); ++i)
  {
    surface->GetPolys()->GetCellAtId(i, ids);
    corners.push_back({ ids->GetId(0), ids->GetId(1), ids->GetId(2) });
  }
  return corners;
}

Place positionOf(vtkPolyData* surface, vtkIdType point)
{
  Place p;
  surface->GetPoint(point, p.data());
  return p;
}

/// Of triangles on a body's surface.
struct Figures
{
  std::size_t strays = 0; // triangles with a place farther than 0.2 spacings from the surface
  std::size_t turned = 0; // that look the wrong way
};

Figures measure(vtkPolyData* surface, const Field& field)
{
  Figures figures;
  for (const auto& corners : cornersOf(surface))
  {
    std::array<Place, 3> p;
    Place center{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      p[i] = positionOf(surface, corners[i]);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        center[axis] += p[i][axis] / 3.0;
      }
    }
    figures.strays += std::abs(field(center)) > 0.2 * spacing ? 1 : 0;
    double normal[3];
    double area = 0.0;
    double rise = 0.0;
    double slope = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::size_t y = (axis + 1) % 3;
      const std::size_t z = (axis + 2) % 3;
      normal[axis] =
        (p[1][y] - p[0][y]) * (p[2][z] - p[0][z]) - (p[1][z] - p[0][z]) * (p[2][y] - p[0][y]);
      constexpr double step = 1e-6;
      Place ahead = center;
      Place behind = center;
      ahead[axis] += step;
      behind[axis] -= step;
      const double gradient = field(ahead) - field(behind);
      area += normal[axis] * normal[axis];
      rise += normal[axis] * gradient;
      slope += gradient * gradient;
    }
    // Normals point to decreasing values. Slivers along edges have none.
    const bool isSliver = std::sqrt(area) < 0.02 * spacing * spacing;
    figures.turned += !isSliver && rise > 0.1 * std::sqrt(area * slope) ? 1 : 0;
  }
  return figures;
}

bool isClosed(vtkPolyData* surface)
{
  std::map<std::array<vtkIdType, 2>, int> sides;
  for (const auto& corners : cornersOf(surface))
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      ++sides[{ corners[i], corners[(i + 1) % 3] }];
    }
  }
  return std::all_of(sides.begin(), sides.end(),
    [&](const auto& side)
    {
      const auto opposite = sides.find({ side.first[1], side.first[0] });
      return opposite != sides.end() && opposite->second == side.second;
    });
}

/// Distances of places on true edges from the surface, ascending, in spacings.
std::vector<double> distancesOfEdges(vtkPolyData* surface, bool hasRims)
{
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(surface);
  locator->BuildLocator();
  std::vector<double> distances;
  const auto add = [&](Place place)
  {
    double closest[3];
    vtkIdType cell = 0;
    int part = 0;
    double square = 0.0;
    locator->FindClosestPoint(place.data(), closest, cell, part, square);
    distances.push_back(std::sqrt(square) / spacing);
  };
  constexpr int steps = 300;
  for (int i = 0; i <= steps; ++i)
  {
    const double along = cubeSide * (2.0 * i / steps - 1.0);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      for (const double u : { -cubeSide, cubeSide })
      {
        for (const double v : { -cubeSide, cubeSide })
        {
          Place place{};
          place[axis] = along;
          place[(axis + 1) % 3] = u;
          place[(axis + 2) % 3] = v;
          add(place);
        }
      }
    }
    const double angle = 6.2831853 * i / steps;
    for (const double z : { -cubeSide, cubeSide })
    {
      if (hasRims)
      {
        add({ boreRadius * std::cos(angle), boreRadius * std::sin(angle), z });
      }
    }
  }
  std::sort(distances.begin(), distances.end());
  return distances;
}

} // namespace

TEST(SharpTriangles, EdgesAreWhereTheBodyHasThem)
{
  for (const Body& body : { Body{ "cube", cube, false }, Body{ "block with a bore", block, true } })
  {
    for (const bool isLattice : { false, true })
    {
      SCOPED_TRACE(std::string(body.name) + (isLattice ? ", lattice" : ""));
      const auto surface = trianglesOf(body.field, isLattice, false);
      const std::vector<double> distances = distancesOfEdges(surface, body.hasRims);
      const std::size_t count = distances.size();
      EXPECT_LT(distances[count * 99 / 100], 0.06);
      EXPECT_LT(distances[count / 2], 0.01);
      EXPECT_LT(distances.back(), 0.4); // at a corner
    }
  }
}

TEST(SharpTriangles, FewLookTheWrongWayOrStray)
{
  for (const Body& body : { Body{ "cube", cube, false }, Body{ "block with a bore", block, true },
         Body{ "turned cube", turnedCube, false } })
  {
    for (const bool isLattice : { false, true })
    {
      SCOPED_TRACE(std::string(body.name) + (isLattice ? ", lattice" : ""));
      const auto surface = trianglesOf(body.field, isLattice, false);
      EXPECT_TRUE(isClosed(surface));
      const Figures figures = measure(surface, body.field);
      EXPECT_LE(figures.turned, 6u) << "of " << surface->GetNumberOfCells();
      EXPECT_LE(figures.strays, 4u) << "of " << surface->GetNumberOfCells();
    }
  }
}

TEST(SharpTriangles, WithNormalsEachSideOfAnEdgeHasItsOwn)
{
  const auto surface = trianglesOf(cube, false, true);
  const auto whole = trianglesOf(cube, false, false);
  EXPECT_GT(surface->GetNumberOfPoints(), whole->GetNumberOfPoints());
  EXPECT_EQ(surface->GetNumberOfCells(), whole->GetNumberOfCells());
  vtkDataArray* const normals = surface->GetPointData()->GetNormals();
  vtkIdType oblique = 0;
  for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
  {
    double normal[3];
    normals->GetTuple(i, normal);
    // That of a face of the cube is along an axis.
    const double along =
      std::max({ std::abs(normal[0]), std::abs(normal[1]), std::abs(normal[2]) });
    oblique += along < 0.95 ? 1 : 0;
  }
  EXPECT_LT(oblique, normals->GetNumberOfTuples() / 200);
}

TEST(SharpTriangles, ArraysOfTheInputAreThoseOfNearbyPoints)
{
  const auto samples = samplesOf(cube, false);
  const auto x = newArray<vtkDoubleArray>("x", samples->GetNumberOfPoints());
  for (vtkIdType i = 0; i < samples->GetNumberOfPoints(); ++i)
  {
    x->SetValue(i, samples->GetPoint(i)[0]);
  }
  samples->GetPointData()->AddArray(x);
  vtkNew<vtkScatteredIsosurfaceFilter> filter;
  filter->SetInputData(samples);
  filter->SetValue(0, 0.0);
  filter->SetProjection(vtkScatteredIsopointFilter::CREASE_FIT);
  filter->Update();
  vtkPolyData* const surface = filter->GetOutput();
  vtkDataArray* const interpolated = surface->GetPointData()->GetArray("x");
  ASSERT_EQ(interpolated->GetNumberOfTuples(), surface->GetNumberOfPoints());
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    EXPECT_NEAR(interpolated->GetComponent(i, 0), surface->GetPoint(i)[0], 3.0 * spacing) << i;
  }
}
