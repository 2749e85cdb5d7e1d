// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles of bodies with sharp edges: edges and corners are where the body has them, hardly a
// triangle looks the wrong way, and the surface is closed.
#include "InputTesting.h"

#include "vtkMath.h"
#include "vtkStaticCellLocator.h"

#include <map>

using namespace inputtesting;

namespace
{

constexpr double cubeSide = 0.6;
constexpr double boreRadius = 0.3;

double cube(const Vector& p)
{
  return std::max({ std::abs(p[0]), std::abs(p[1]), std::abs(p[2]) }) - cubeSide;
}

double block(const Vector& p)
{
  return std::max(cube(p), boreRadius - std::hypot(p[0], p[1]));
}

/// About the axes z and x.
double turnedCube(const Vector& p)
{
  const double c = std::cos(0.5);
  const double s = std::sin(0.5);
  const Vector q{ c * p[0] + s * p[1], c * p[1] - s * p[0], p[2] };
  return cube({ q[0], c * q[1] + s * q[2], c * q[2] - s * q[1] });
}

struct Body
{
  const char* name;
  double (*field)(const Vector&);
};

const std::vector<Body> bodies{ { "cube", cube }, { "block with a bore", block },
  { "turned cube", turnedCube } };

constexpr vtkIdType sampleCount = 60000;
const double spacing = std::cbrt(8.0 / static_cast<double>(sampleCount));

/// Of samples in a cube of side 2, random or a lattice, with the array "x".
vtkSmartPointer<vtkPolyData> trianglesOfBody(
  const Body& body, bool isLattice = false, bool hasNormals = false)
{
  const auto cloud = newCloud(sampleCount, VTK_DOUBLE);
  if (isLattice)
  {
    cloud->GetPointData()->Initialize();
    cloud->SetPoints(pointsOfDataSet(newImage({ 38, 38, 38 }, 2.0 / 38.0)));
  }
  setScalars(cloud, body.field);
  const auto filter = newFilter<Isosurface>(cloud, 0.0);
  filter->SetProjection(Isopoints::CREASE_FIT);
  filter->SetComputeNormals(hasNormals);
  return outputOf(filter);
}

void expectFewStrayOrTurned(vtkPolyData* surface, const Body& body)
{
  int strays = 0; // triangles with a center farther than 0.2 spacings from the surface
  int turned = 0; // triangles that look the wrong way
  for (const auto& corners : trianglesOf(surface))
  {
    const Vector a = placeOf(surface, corners[0]);
    const Vector b = placeOf(surface, corners[1]);
    const Vector c = placeOf(surface, corners[2]);
    const Vector center = 1.0 / 3.0 * (a + (b + c));
    strays += std::abs(body.field(center)) > 0.2 * spacing ? 1 : 0;
    Vector gradient;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      Vector step{};
      step[axis] = 1e-6;
      gradient[axis] = body.field(center + step) - body.field(center - step);
    }
    // Normals point to decreasing values. Slivers along edges have none.
    const Vector normal = analytic::cross(b - a, c - a);
    const bool isSliver = length(normal) < 0.02 * spacing * spacing;
    turned += !isSliver && dot(normal, gradient) > 0.1 * length(normal) * length(gradient) ? 1 : 0;
  }
  EXPECT_LE(turned, 6) << "of " << surface->GetNumberOfCells();
  EXPECT_LE(strays, 4) << "of " << surface->GetNumberOfCells();
}

bool isClosed(vtkPolyData* surface)
{
  std::map<std::array<vtkIdType, 2>, int> sides;
  for (const auto& corners : trianglesOf(surface))
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
  const auto add = [&](Vector place)
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
    for (int edge = 0; edge < 12; ++edge)
    {
      const auto axis = static_cast<std::size_t>(edge / 4);
      Vector place{};
      place[axis] = along;
      place[(axis + 1) % 3] = edge % 2 ? cubeSide : -cubeSide;
      place[(axis + 2) % 3] = edge / 2 % 2 ? cubeSide : -cubeSide;
      add(place);
    }
    const double angle = 2.0 * vtkMath::Pi() * i / steps;
    if (hasRims)
    {
      add({ boreRadius * std::cos(angle), boreRadius * std::sin(angle), -cubeSide });
      add({ boreRadius * std::cos(angle), boreRadius * std::sin(angle), cubeSide });
    }
  }
  std::sort(distances.begin(), distances.end());
  return distances;
}

} // namespace

TEST(SharpTriangles, AreClosedAndFollowTheBody)
{
  for (const Body& body : bodies)
  {
    for (const bool isLattice : { false, true })
    {
      SCOPED_TRACE(std::string(body.name) + (isLattice ? ", lattice" : ""));
      const auto surface = trianglesOfBody(body, isLattice);
      EXPECT_TRUE(isClosed(surface));
      expectFewStrayOrTurned(surface, body);
      if (body.field != turnedCube)
      {
        const std::vector<double> distances = distancesOfEdges(surface, body.field == block);
        EXPECT_LT(distances[distances.size() * 99 / 100], 0.06);
        EXPECT_LT(distances[distances.size() / 2], 0.01);
        EXPECT_LT(distances.back(), 0.4); // at a corner
      }
    }
  }
}

TEST(SharpTriangles, WithNormalsEachSideOfAnEdgeHasItsOwn)
{
  const auto surface = trianglesOfBody(bodies[0], false, true);
  const auto whole = trianglesOfBody(bodies[0]);
  EXPECT_GT(surface->GetNumberOfPoints(), whole->GetNumberOfPoints());
  EXPECT_EQ(surface->GetNumberOfCells(), whole->GetNumberOfCells());
  vtkIdType oblique = 0;
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    // That of a face of the cube is along an axis.
    const Vector normal = tupleOf(surface->GetPointData()->GetNormals(), i);
    const double along =
      std::max({ std::abs(normal[0]), std::abs(normal[1]), std::abs(normal[2]) });
    oblique += along < 0.95 ? 1 : 0;
  }
  EXPECT_LT(oblique, surface->GetNumberOfPoints() / 200);
}

TEST(SharpTriangles, ArraysOfTheInputAreThoseOfNearbyPoints)
{
  const auto surface = trianglesOfBody(bodies[0], false, true);
  const std::vector<double> x = numbersOf(findArray(surface, "x"));
  ASSERT_EQ(static_cast<vtkIdType>(x.size()), surface->GetNumberOfPoints());
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    EXPECT_NEAR(x[i], surface->GetPoint(static_cast<vtkIdType>(i))[0], 3.0 * spacing) << i;
  }
}
