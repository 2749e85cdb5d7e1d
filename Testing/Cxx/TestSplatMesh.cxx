// SPDX-License-Identifier: GPL-3.0-or-later
// The triangles of splats against analytic shapes and brute force.
#include "Clouds.h"

#include "Core/SplatMesh/SplatMesh.h"

#include <gtest/gtest.h>

namespace
{

using namespace isopoint;

/// Splats as arrays hold them, but for the normals, which have length 1.
struct Splats
{
  std::vector<Vector> positions;
  std::vector<Vector> normals;
  std::vector<Vector> axes;
  std::vector<SplatCorners> corners;
  double scale = 1.0;
  bool areFloat = false;

  std::size_t size() const { return this->positions.size(); }

  void add(const Vector& position, const Vector& normal, const Vector& axis,
    const std::vector<SplatCorner>& corners)
  {
    this->positions.push_back(position);
    this->normals.push_back(normal);
    this->axes.push_back(axis);
    SplatCorners& all = this->corners.emplace_back();
    all.fill(corners.back());
    std::copy(corners.begin(), corners.end(), all.begin());
  }

  SplatFan fanAt(std::size_t i) const
  {
    return fanOf(this->positions[i], this->normals[i], this->axes[i], numbersOf(this->corners[i]),
      this->scale, positionErrorOf(this->areFloat));
  }

  SplatMesh mesh(const Execution& execution = {}) const
  {
    return buildSplatMesh(
      execution, this->size(), [this](std::size_t i) { return this->fanAt(i); });
  }
};

constexpr Vector up{ 0.0, 0.0, 1.0 };
const float half = static_cast<float>(std::sqrt(0.5)); // of a diagonal, in units of the radius

std::vector<SplatCorner> squareCorners(float height = 0.0f, float slope = 0.0f)
{
  return { { half, -half, height, slope, -slope }, { half, half, height, slope, slope },
    { -half, half, height, -slope, slope }, { -half, -half, height, -slope, -slope } };
}

/// Squares that tile the plane z = 0, in rows of this many.
Splats tiles(std::size_t rows, double side = 1.0, const Vector& origin = { 0.0, 0.0, 0.0 })
{
  Splats splats;
  for (std::size_t i = 0; i < rows * rows; ++i)
  {
    const Vector offset{ side * static_cast<double>(i % rows), side * static_cast<double>(i / rows),
      0.0 };
    splats.add(origin + offset, up, { side * std::sqrt(0.5), 0.0, 0.0 }, squareCorners());
  }
  return splats;
}

/// Splats of random shapes, sizes and slopes, a few of which have crossed corners, repeated points
/// or no shape.
Splats randomSplats(std::size_t count, std::uint64_t seed)
{
  clouds::Random random(seed);
  const auto number = [&random](double size)
  { return static_cast<float>(size * (random() - 0.5)); };
  Splats splats;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vector normal = unitNormal(random.inCube(2.0));
    const double radius = std::pow(10.0, -3.0 * random());
    const Vector axis = radius * TangentFrame(normal).first;
    const std::size_t corners = 3 + static_cast<std::size_t>(6.0 * random());
    const double bend = random() < 0.5 ? 0.02 : 1.0;
    std::vector<SplatCorner> fan;
    for (std::size_t k = 0; k < corners; ++k)
    {
      const double angle = 2.0 * M_PI * (static_cast<double>(k) + 1.5 * random()) / 9.0;
      fan.push_back({ static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)),
        number(bend), number(bend), number(bend) });
    }
    if (random() < 0.02)
    {
      fan = { fan.front() };
    }
    splats.add(random.inCube(2.0), normal, axis, fan);
    if (random() < 0.4) // corners that meet those of another splat, or lie a little too far away
    {
      const double farthest = 3e-6 * radius;
      const Vector moved = splats.positions.back() + farthest * random.inCube(2.0);
      splats.add(moved, normal, axis, fan);
    }
  }
  return splats;
}

bool areOne(const SplatVertex& a, const SplatVertex& b)
{
  const float tolerance = std::min(a.tolerance, b.tolerance);
  bool areClose = tolerance > 0.0f;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    areClose = areClose && std::abs(a.position[axis] - b.position[axis]) <= tolerance &&
               std::abs(a.normal[axis] - b.normal[axis]) <= 1e-3f;
  }
  return areClose;
}

/// The first vertex of each group of those that are one, by comparing all with all.
std::vector<std::size_t> bruteForceGroups(const std::vector<SplatVertex>& vertices)
{
  std::vector<std::size_t> group(vertices.size());
  std::iota(group.begin(), group.end(), 0);
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    for (std::size_t k = 0; k < i; ++k)
    {
      if (group[k] != group[i] && areOne(vertices[k], vertices[i]))
      {
        const auto [low, high] = std::minmax({ group[k], group[i] });
        std::replace(group.begin(), group.end(), std::size_t{ high }, std::size_t{ low });
      }
    }
  }
  return group;
}

void expectSame(const SplatMesh& expected, const SplatMesh& mesh)
{
  ASSERT_EQ(expected.vertices.size(), mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
  {
    EXPECT_EQ(expected.vertices[i].position, mesh.vertices[i].position);
    EXPECT_EQ(expected.vertices[i].normal, mesh.vertices[i].normal);
    EXPECT_EQ(expected.vertices[i].tolerance, mesh.vertices[i].tolerance);
  }
  EXPECT_EQ(expected.pointOfVertex, mesh.pointOfVertex);
  EXPECT_EQ(expected.triangles, mesh.triangles);
  EXPECT_EQ(expected.meetsAt, mesh.meetsAt);
}

Vector areaOf(const SplatMesh& mesh, std::size_t triangle)
{
  const auto [a, b, c] = mesh.triangles[triangle];
  const Vector& first = mesh.vertices[a].position;
  return 0.5 * cross(mesh.vertices[b].position - first, mesh.vertices[c].position - first);
}

} // namespace

TEST(SplatMesh, SquaresHaveTheirCornersAndArea)
{
  for (const double scale : { 0.3, 1.0, 2.5 })
  {
    Splats splats = tiles(3);
    splats.scale = scale;
    const SplatMesh mesh = splats.mesh();
    ASSERT_EQ(mesh.vertices.size(), 9 * 4);
    ASSERT_EQ(mesh.triangles.size(), 9 * 2);
    double area = 0.0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    {
      area += areaOf(mesh, i)[2];
      EXPECT_EQ(mesh.pointOfTriangle(i), i / 2);
    }
    EXPECT_NEAR(area, 9.0 * scale * scale, 1e-5);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    {
      const Vector offset = mesh.vertices[i].position - splats.positions[mesh.pointOfVertex[i]];
      EXPECT_NEAR(std::abs(offset[0]), 0.5 * scale, 1e-6);
      EXPECT_NEAR(std::abs(offset[1]), 0.5 * scale, 1e-6);
      EXPECT_EQ(mesh.vertices[i].normal[2], 1.0f);
    }
  }
}

TEST(SplatMesh, FlatFansHaveNoVertexInTheMiddle)
{
  // The slope along the diagonal is greater by the square root of 2.
  for (const auto& [height, slope, scale, isFlat] :
    { std::tuple(0.029f, 0.0f, 1.0, true), std::tuple(-0.031f, 0.0f, 1.0, false),
      std::tuple(0.0f, 0.0211f, 1.0, true), std::tuple(0.0f, 0.0213f, 1.0, false),
      std::tuple(0.0f, 0.0211f, 1.01, false), std::tuple(0.0f, 1.0f, 0.01, true) })
  {
    Splats splats;
    splats.scale = scale;
    splats.add({ 1.0, 2.0, 3.0 }, up, { 1.0, 0.0, 0.0 }, squareCorners(height, slope));
    const SplatMesh mesh = splats.mesh();
    EXPECT_EQ(mesh.vertices.size(), isFlat ? 4u : 5u);
    EXPECT_EQ(mesh.triangles.size(), isFlat ? 2u : 4u);
  }
}

TEST(SplatMesh, CornersOfAParaboloidAreOnIt)
{
  // z = (x^2 + y^2) / 2 for x, y of the unit square around 0, whose slopes are x and y.
  for (const double scale : { 0.5, 1.0 })
  {
    Splats splats;
    splats.scale = scale;
    const float radius = static_cast<float>(std::sqrt(2.0));
    splats.add({ 0.0, 0.0, 0.0 }, up, { radius, 0.0, 0.0 }, squareCorners(1.0f / radius, -1.0f));
    const SplatMesh mesh = splats.mesh();
    ASSERT_EQ(mesh.vertices.size(), 5);
    for (const SplatVertex& vertex : mesh.vertices)
    {
      const auto [x, y, z] = vertex.position;
      EXPECT_NEAR(z, 0.5 * (x * x + y * y), 1e-6);
      const Vector normal = directionOf({ -x, -y, 1.0 });
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        EXPECT_NEAR(vertex.normal[axis], normal[axis], 1e-6);
      }
    }
  }
}

TEST(SplatMesh, NoTriangleFacesAway)
{
  const Splats splats = randomSplats(2000, 1);
  const SplatMesh mesh = splats.mesh();
  std::size_t bent = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    const auto& normal = mesh.vertices[mesh.triangles[i][0]].normal;
    const Vector area = areaOf(mesh, i);
    const double facing = dot(area, { normal[0], normal[1], normal[2] });
    EXPECT_GE(facing, -1e-6 * std::sqrt(dot(area, area)));
    bent += mesh.triangles[i][1] > mesh.triangles[i][2] &&
            mesh.triangles[i][2] != mesh.triangles[i][0] + 1;
  }
  EXPECT_GT(bent, 0) << "some have crossed corners";
}

TEST(SplatMesh, WhatHasNoShapeIsLeftOut)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Splats splats = tiles(3);
  splats.axes[1] = { 0.0, 0.0, 0.0 };
  splats.axes[2][0] = nan;
  splats.corners[3].fill({ 0.0f, 0.0f, 0.0f, 0.0f, 0.0f });
  splats.corners[4][7].across = std::numeric_limits<float>::infinity();
  const SplatMesh mesh = splats.mesh();
  const std::set<std::size_t> drawn(mesh.pointOfVertex.begin(), mesh.pointOfVertex.end());
  EXPECT_EQ(drawn, (std::set<std::size_t>{ 0, 5, 6, 7, 8 }));
  EXPECT_TRUE(Splats{}.mesh().vertices.empty());
}

TEST(SplatMesh, TilesMeetAtTheirCorners)
{
  for (const double side : { 1e-20, 1.0, 0.37, 1e20 })
  {
    for (const Vector& origin :
      { Vector{ 0.0, 0.0, 0.0 }, Vector{ -3e3 * side, 77.7 * side, 0.0 } })
    {
      const SplatMesh mesh = tiles(20, side, origin).mesh();
      std::map<std::size_t, std::size_t> sizes;
      for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
      {
        sizes[mesh.meeting.at(i).count] += mesh.meetsAt[i] == i;
      }
      sizes.erase(0);
      EXPECT_EQ(
        sizes, (std::map<std::size_t, std::size_t>{ { 1, 4 }, { 2, 4 * 19 }, { 4, 19 * 19 } }))
        << side;
    }
  }
}

TEST(SplatMesh, CoordinatesOfFloatMeetWithinTheirRounding)
{
  Splats splats = tiles(2, 1.0, { 1e4, 1e4, 0.0 });
  splats.positions[1][0] += 1e-3;
  const auto groups = [&splats](bool areFloat)
  {
    splats.areFloat = areFloat;
    const SplatMesh mesh = splats.mesh();
    return std::set<std::size_t>(mesh.meetsAt.begin(), mesh.meetsAt.end()).size();
  };
  EXPECT_EQ(groups(true), 9);
  EXPECT_GT(groups(false), 9);
}

TEST(SplatMesh, VerticesMeetAsByBruteForceInOnePlace)
{
  for (const std::uint64_t seed : { 1, 2, 3 })
  {
    const SplatMesh mesh = randomSplats(400, seed).mesh();
    const std::vector<std::size_t> expected = bruteForceGroups(mesh.vertices);
    EXPECT_EQ(mesh.meetsAt, expected);
    std::size_t met = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      met += expected[i] != i;
      EXPECT_EQ(mesh.vertices[i].position, mesh.vertices[expected[i]].position) << "exactly";
      const auto list = mesh.meeting.at(i);
      EXPECT_EQ(
        list.count, static_cast<std::size_t>(std::count(expected.begin(), expected.end(), i)));
      EXPECT_TRUE(std::all_of(
        list.begin(), list.end(), [&](std::size_t vertex) { return expected[vertex] == i; }));
    }
    EXPECT_GT(met, 200);
    EXPECT_LT(met, expected.size() / 2);
  }
}

TEST(SplatMesh, SplatsOfDifferentSizesMeet)
{
  // The corner of each is one of the next, which is 30 times as large.
  Splats splats;
  double radius = 1e-4;
  for (int i = 0; i < 6; ++i)
  {
    splats.add({ -half * radius, -half * radius, 0.0 }, up, { radius, 0.0, 0.0 }, squareCorners());
    radius *= 30.0;
  }
  const SplatMesh mesh = splats.mesh();
  EXPECT_EQ(mesh.meetsAt, bruteForceGroups(mesh.vertices));
  const auto largest = std::max_element(mesh.meetsAt.begin(), mesh.meetsAt.end(),
    [&](std::size_t a, std::size_t b)
    { return mesh.meeting.at(a).count < mesh.meeting.at(b).count; });
  EXPECT_EQ(mesh.meeting.at(*largest).count, 6);
}

TEST(SplatMesh, VerticesMeetThroughOthers)
{
  // In a row of vertices only neighbors are one, in cells of their own.
  std::vector<SplatVertex> vertices;
  for (int i = 0; i < 2000; ++i)
  {
    vertices.push_back({ { 0.9 * i, 10.0, 10.0 }, { 0.0f, 0.0f, 1.0f }, 1.0f });
  }
  EXPECT_EQ(meetingVertices({}, vertices), std::vector<std::size_t>(2000, 0));
  vertices[1000].tolerance = 0.8f;
  EXPECT_EQ(meetingVertices({}, vertices), bruteForceGroups(vertices));
}

TEST(SplatMesh, EdgesOfCreasesStayApart)
{
  // Two squares at a right angle, with a side in common.
  Splats splats = tiles(1);
  splats.add({ 0.5, 0.0, -0.5 }, { 1.0, 0.0, 0.0 }, { 0.0, std::sqrt(0.5), 0.0 }, squareCorners());
  const SplatMesh mesh = splats.mesh();
  ASSERT_EQ(mesh.vertices.size(), 8);
  EXPECT_EQ(std::set<std::size_t>(mesh.meetsAt.begin(), mesh.meetsAt.end()).size(), 8);
}

TEST(SplatMesh, MeansAreThoseOfAllThatMeet)
{
  const Splats splats = randomSplats(400, 4);
  const SplatMesh mesh = splats.mesh();
  clouds::Random random(5);
  const std::vector<std::size_t> groups = bruteForceGroups(mesh.vertices);
  const auto expectMeans = [&](auto zero, std::size_t components)
  {
    using T = decltype(zero);
    std::vector<T> values(components * splats.size());
    std::generate(values.begin(), values.end(), [&]() { return static_cast<T>(random()); });
    std::vector<T> means(components * mesh.vertices.size());
    meansAtVertices(
      Execution{}, mesh, components,
      [&](std::size_t point, std::size_t i) { return values[components * point + i]; },
      means.data());
    for (std::size_t vertex = 0; vertex < groups.size(); ++vertex)
    {
      for (std::size_t k = 0; k < components; ++k)
      {
        double sum = 0.0;
        for (std::size_t other = 0; other < groups.size(); ++other)
        {
          const T value = values[components * mesh.pointOfVertex[other] + k];
          sum += groups[other] == groups[vertex] ? static_cast<double>(value) : 0.0;
        }
        const auto count = std::count(groups.begin(), groups.end(), groups[vertex]);
        EXPECT_EQ(means[components * vertex + k], static_cast<T>(sum / static_cast<double>(count)));
      }
    }
  };
  expectMeans(0.0f, 1);
  expectMeans(0.0, 3);
}

TEST(SplatMesh, PermutedPointsGiveThePermutedMesh)
{
  const Splats splats = randomSplats(1000, 6);
  const std::vector<std::size_t> order = clouds::randomOrder(splats.size(), 7);
  const SplatMesh mesh = splats.mesh();
  const SplatMesh permuted =
    buildSplatMesh({}, splats.size(), [&](std::size_t i) { return splats.fanAt(order[i]); });
  ASSERT_EQ(mesh.vertices.size(), permuted.vertices.size());
  ASSERT_EQ(mesh.triangles.size(), permuted.triangles.size());

  // Each triangle by its corners: their points, and the positions of all that meet there.
  const auto contentsOf = [&](const SplatMesh& of, const auto& pointAt)
  {
    std::vector<std::vector<Vector>> met(of.vertices.size()); // by the first of them
    for (std::size_t i = 0; i < of.vertices.size(); ++i)
    {
      met[of.meetsAt[i]].push_back(of.vertices[i].position);
    }
    for (std::vector<Vector>& positions : met)
    {
      std::sort(positions.begin(), positions.end());
    }
    std::multiset<std::array<std::tuple<std::size_t, Vector, std::vector<Vector>>, 3>> contents;
    for (const auto& triangle : of.triangles)
    {
      const auto corner = [&](std::size_t i)
      {
        const std::size_t vertex = triangle[i];
        return std::tuple(
          pointAt(of.pointOfVertex[vertex]), of.vertices[vertex].position, met[of.meetsAt[vertex]]);
      };
      contents.insert({ corner(0), corner(1), corner(2) });
    }
    return contents;
  };
  EXPECT_TRUE(contentsOf(mesh, [](std::size_t point) { return point; }) ==
              contentsOf(permuted, [&](std::size_t point) { return order[point]; }));
}

TEST(SplatMesh, IsTheSameOnThreads)
{
  const Splats splats = randomSplats(8000, 8);
  expectSame(splats.mesh(), splats.mesh(clouds::executionOn(4)));
}

TEST(SplatMesh, ReportsProgressAndStopsAtAnyTime)
{
  const Splats splats = randomSplats(20000, 9);
  std::vector<double> shares; // done whenever it is asked
  double share = 0.0;
  Execution execution;
  std::vector<double> reported;
  execution.progress = [&](double done)
  {
    share = done;
    reported.push_back(done);
  };
  execution.isAborted = [&]()
  {
    shares.push_back(share);
    return false;
  };
  static_cast<void>(splats.mesh(execution));
  const std::size_t most = shares.size();
  EXPECT_GT(most, 4);
  ASSERT_GE(reported.size(), 3u);
  EXPECT_LT(reported[0], reported[1]);
  EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
  EXPECT_GE(reported.front(), 0.0);
  EXPECT_LE(reported.back(), 1.0);
  EXPECT_GT(shares.back(), 0.67) << "even while vertices are united";
  for (std::size_t at = 1; at <= most; at += 1 + most / 4)
  {
    std::size_t asked = 0;
    execution.isAborted = [&]() { return ++asked >= at; };
    EXPECT_THROW(static_cast<void>(splats.mesh(execution)), Aborted);
    EXPECT_EQ(asked, at) << "work goes on";
  }
}
