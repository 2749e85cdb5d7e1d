// SPDX-License-Identifier: GPL-3.0-or-later
// Splats: normals, and shapes where there is no crease.
#include "SplatTesting.h"

#include "Core/Splat/MutualSides.h"

using namespace splattesting;

TEST(Splats, NormalsPointToDecreasingValues)
{
  for (const double scale : { 1.0, 1e-20, 1e20 })
  {
    const Sphere sphere(5000, scale, scale);
    const std::vector<Splat> splats = splatsOf(sphere.positions, sphere.edges);
    for (std::size_t i = 0; i < splats.size(); ++i)
    {
      ASSERT_NEAR(dot(splats[i].normal, splats[i].normal), 1.0, 1e-12);
      ASSERT_GT(dot(splats[i].normal, sphere.outwards[i]), 0.98);
    }
  }
}

// The corners lie on the sphere, have its normals, and are those of neighboring splats.
TEST(Splats, AreClosedAndBentAsTheSurfaceIs)
{
  const Sphere sphere(800, 1.0, 0.0);
  Points points;
  for (const Vector& p : sphere.positions)
  {
    addFitted(points, p, isopoint::FitOrder::Quadratic, isopoint::scaled(-1.0, p));
    points.fits.back().hessian = { -1.0, -1.0, -1.0, 0.0, 0.0, 0.0 };
    points.fits.back().spacing = 0.12;
  }
  const std::vector<Splat> splats = splatsOf(points);
  double area = 0.0;
  double heights = 0.0;
  std::vector<Vector> corners;
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    if (!(splats[i].radius > 0.0))
    {
      continue; // another one represents it
    }
    area += areaOf(splats[i]);
    for (const isopoint::SplatCorner& corner : cornersOf(splats[i]))
    {
      const Vector place = isopoint::sum(points.positions[i], 1.0, offsetOf(splats[i], corner));
      ASSERT_NEAR(lengthOf(place), 1.0, 0.002);
      ASSERT_GT(dot(normalAt(splats[i], corner), place), 0.9995);
      heights = std::max(heights, std::abs(static_cast<double>(corner.height)));
      corners.push_back(place);
    }
  }
  EXPECT_GT(heights, 0.04);
  const double sphereArea = 4.0 * std::acos(-1.0);
  EXPECT_NEAR(area, sphereArea, 0.02 * sphereArea);
  std::size_t shared = 0; // by three splats or more
  for (const Vector& a : corners)
  {
    shared += std::count_if(corners.begin(), corners.end(),
                [&](const Vector& b) { return lengthOf(difference(a, b)) < 1e-6; }) >= 3
                ? 1
                : 0;
  }
  EXPECT_GT(shared, corners.size() * 97 / 100);
}

// Rows ten times farther apart than points in a row: the nearest points all lie in one row.
TEST(Splats, CoverTheGapsBetweenRows)
{
  std::vector<Vector> positions;
  for (int row = 0; row < 20; ++row)
  {
    for (int i = 0; i < 200; ++i)
    {
      positions.push_back({ 0.1 * i, static_cast<double>(row), 0.0 });
    }
  }
  Points points;
  points.positions = positions;
  points.decreasingEdges.assign(positions.size(), { 0.0, 0.0, 1.0 });
  points.fits.assign(
    positions.size(), fitAmong(1.0, isopoint::FitOrder::Linear, { 0.0, 0.0, -1.0 }));
  const std::vector<Splat> splats = splatsOf(points);
  const auto& inside = splats[10 * 200 + 100];
  EXPECT_EQ(inside.normal, (Vector{ 0.0, 0.0, 1.0 }));
  EXPECT_GT(inside.radius, 0.5);
  EXPECT_LT(inside.radius, 0.7);
}

TEST(Splats, OfAnIsolatedPointStaySmall)
{
  Sphere sphere(800, 1.0, 0.0);
  sphere.positions.push_back({ 50.0, 0.0, 0.0 });
  sphere.edges.push_back({ 0.1, 0.0, 0.0 });
  EXPECT_LT(splatsOf(sphere.positions, sphere.edges).back().radius, 0.12);
}

// Where a coarse lattice meets a fine one, many isopoints crowd at one coarse sample. Their splats
// cover what lies between that and the next.
TEST(Splats, CoverTheGapsBetweenCrowds)
{
  const Vector gradient{ 0.0, 0.0, -1.0 };
  Points points;
  for (int i = -4; i <= 4; ++i)
  {
    for (int k = -4; k <= 4; ++k)
    {
      for (int n = 0; n < 14; ++n)
      {
        addFitted(points, { i + 0.001 * std::cos(n), k + 0.001 * std::sin(n), 0.0 }, std::nullopt,
          gradient);
      }
    }
  }
  const std::vector<Splat> splats = splatsOf(points);
  double farthest = 0.0; // of the splats at the middle
  for (std::size_t i = splats.size() / 2 - 7; i < splats.size() / 2 + 7; ++i)
  {
    farthest = std::max(farthest, splats[i].radius);
  }
  EXPECT_GT(farthest, 0.7);
  EXPECT_LT(farthest, 1.5);
}

TEST(Splats, PlanesAreFittedToAsManyPointsAsRequested)
{
  // A wavy sheet: planes through more points are flatter.
  Points points;
  for (int i = 0; i < 41; ++i)
  {
    for (int k = 0; k < 41; ++k)
    {
      points.positions.push_back({ 1.0 * i, 1.0 * k, (i + k) % 2 == 0 ? 0.2 * (k % 3) : 0.0 });
      points.decreasingEdges.push_back({ 0.0, 0.0, 1.0 });
    }
  }
  const auto worstSlope = [&](int count)
  {
    isopoint::SplatOptions options;
    options.neighborCount = count;
    options.fieldNormals = false;
    isopoint::AllPoints all(points.positions.size());
    const std::vector<Splat> splats = isopoint::computeSplats(clouds::executionOn(2),
      { points.positions, points.decreasingEdges, points.fits }, NearestAround(points.positions),
      static_cast<const HalfSpace*>(nullptr), options, all);
    double slope = 0.0;
    for (int i = 15; i <= 25; ++i)
    {
      for (int k = 15; k <= 25; ++k)
      {
        slope =
          std::max(slope, std::hypot(splats[41 * i + k].normal[0], splats[41 * i + k].normal[1]));
      }
    }
    return slope;
  };
  EXPECT_LT(worstSlope(150), 0.5 * worstSlope(40));
  EXPECT_EQ(worstSlope(600), worstSlope(192)); // all of two rings
}

// A blob no wider than the sample spacing: its splats are hardly larger than it is.
TEST(Splats, OfASmallBlobDoNotStickOut)
{
  for (const std::size_t count : { 8, 14, 40 })
  {
    const Sphere sphere(count, 1.0, 0.0);
    Points points;
    points.positions = sphere.positions;
    points.decreasingEdges = sphere.edges;
    for (const Vector& p : sphere.positions)
    {
      points.fits.push_back(
        fitAmong(2.0, isopoint::FitOrder::Quadratic, isopoint::scaled(-1.0, p)));
      points.fits.back().hessian = { -1.0, -1.0, -1.0, 0.0, 0.0, 0.0 };
    }
    for (const Splat& splat : splatsOf(points))
    {
      EXPECT_LT(splat.radius, 1.8);
    }
  }
}

// At the border of a sheet cells are bounded far outside, by other points of the border only.
TEST(Splats, EndSoonBeyondTheSamples)
{
  const Vector gradient{ 0.0, 0.0, -1.0 };
  Points points;
  const HalfSpace samples;
  clouds::Random random(5);
  for (int i = 0; i < 1000; ++i)
  {
    addFitted(
      points, { -10.0 * random(), 40.0 * random(), 0.0 }, isopoint::FitOrder::Quadratic, gradient);
  }
  const std::vector<Splat> splats = splatsOf(points, &samples);
  double farthest = 0.0;
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    for (const isopoint::SplatCorner& corner : cornersOf(splats[i]))
    {
      farthest = std::max(farthest, points.positions[i][0] + offsetOf(splats[i], corner)[0]);
    }
  }
  EXPECT_GT(farthest, 0.1);
  EXPECT_LT(farthest, 1.5);
}

// The splats of a plane cover it once, wherever fits held.
TEST(Splats, OfPointsWithAndWithoutSmoothFitsDoNotOverlap)
{
  const Vector gradient{ 0.0, 0.0, -1.0 };
  clouds::Random random(3);
  Points points;
  constexpr int half = 12;
  constexpr double distance = 0.4;
  for (int i = -half; i <= half; ++i)
  {
    for (int k = -half; k <= half; ++k)
    {
      const double x = distance * (i + 0.4 * random());
      const double y = distance * (k + 0.4 * random());
      addFitted(points, { x, y, 0.0 },
        random() < 0.5 ? std::optional(isopoint::FitOrder::Quadratic) : std::nullopt, gradient);
    }
  }
  const std::vector<Splat> splats = splatsOf(points);
  double area = 0.0;
  double inner = 0.0; // of Voronoi cells, which are one of the lattice's on average
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    const Vector& place = points.positions[i];
    if (std::max(std::abs(place[0]), std::abs(place[1])) < distance * (half - 2))
    {
      area += areaOf(splats[i]);
      inner += distance * distance;
    }
  }
  EXPECT_NEAR(area / inner, 1.0, 0.03);
}

// In a lattice the planes halfway to diagonal neighbors pass through the corners that the others
// leave: rounding decides which of them cut. Shapes do not depend on that.
TEST(Splats, ShapesDoNotDependOnRounding)
{
  const auto splatsTurnedBy = [](double angle, double noise)
  {
    clouds::Random random(2);
    Points points;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    for (int i = -6; i <= 6; ++i)
    {
      for (int k = -6; k <= 6; ++k)
      {
        const double x = 0.8 * i + noise * random();
        const double y = 0.5 * k + noise * random();
        addFitted(points, { c * x - s * y, s * x + c * y, noise * random() },
          isopoint::FitOrder::Quadratic, { 0.0, 0.0, -1.0 });
        points.fits.back().hessian = { 0.1 * c * c, 0.1 * s * s, 0.0, 0.1 * c * s, 0.0, 0.0 };
      }
    }
    return splatsOf(points);
  };
  const std::vector<Splat> expected = splatsTurnedBy(0.0, 0.0);
  const std::size_t middle = expected.size() / 2;
  for (int i = 0; i < 50; ++i)
  {
    const std::vector<Splat> splats = splatsTurnedBy(0.1 * i, i % 2 == 0 ? 0.0 : 1e-12);
    EXPECT_NEAR(splats[middle].radius, expected[middle].radius, 1e-9) << i;
    EXPECT_NEAR(areaOf(splats[middle]), areaOf(expected[middle]), 1e-6) << i;
  }
}

// A corner is listed once, however many cuts pass through it, and cuts that miss the cell leave it.
TEST(Splats, CellsListEachCornerOnce)
{
  isopoint::TangentCell cell({ 0.0, 0.0, 1.0 }, 4.0);
  for (const double x : { -1.0, 1.0 })
  {
    cell.cut(x, 0.0, 1.0, 1);
    cell.cut(0.0, x, 1.0, 2);
  }
  const auto count = [&]() { return cell.end() - cell.begin(); };
  EXPECT_EQ(count(), 4);
  EXPECT_FALSE(cell.isOpen());
  for (const double x : { -1.0, 1.0 })
  {
    cell.cut(x, x, 2.0, 3);
    cell.cut(x, -x, 2.0 + 1e-13, 4);
    cell.cut(x, 0.0, 1.0, 5);
    cell.cut(x, 0.0, 3.0, 6);
  }
  EXPECT_EQ(count(), 4);
  EXPECT_NEAR(cell.squaredReach(), 2.0, 1e-12);
  cell.limitTo(0.5);
  EXPECT_EQ(count(), 8);
  EXPECT_TRUE(cell.isOpen());
  EXPECT_NEAR(cell.squaredReach(), 0.25, 1e-12);
}

// Of many corners those at the shortest sides become one; nothing else changes.
TEST(Splats, CellsLoseTheirShortestSides)
{
  isopoint::TangentCell cell({ 0.0, 0.0, 1.0 }, 1.0);
  cell.cut(1.0, 0.0, 0.99, 7);
  cell.cut(0.0, 1.0, 0.999, 8);
  EXPECT_EQ(cell.end() - cell.begin(), 10);
  cell.reduceTo(8);
  EXPECT_EQ(cell.end() - cell.begin(), 8);
  for (const isopoint::TangentCell::Corner& corner : cell)
  {
    EXPECT_EQ(corner.side, isopoint::TangentCell::limit);
    EXPECT_NEAR(std::hypot(corner.x, corner.y), 1.0, 0.011);
  }
  cell.reduceTo(8);
  EXPECT_EQ(cell.end() - cell.begin(), 8);
}

// Samples whose value equals the isovalue have many isopoints at their own position.
TEST(Splats, CoincidentPointsCountOnceAmongTheNearest)
{
  const Sphere sphere(800, 1.0, 0.0);
  const std::vector<Splat> expected = splatsOf(sphere.positions, sphere.edges);
  std::vector<Vector> positions;
  std::vector<Vector> edges;
  for (std::size_t i = 0; i < sphere.positions.size(); ++i)
  {
    positions.insert(positions.end(), 30, sphere.positions[i]);
    edges.insert(edges.end(), 30, sphere.edges[i]);
  }
  const std::vector<Splat> splats = splatsOf(positions, edges);
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    const bool isFirst = i % 30 == 0;
    ASSERT_NEAR(splats[i].radius, isFirst ? expected[i / 30].radius : 0.0, 1e-12);
    ASSERT_NEAR(areaOf(splats[i]), isFirst ? areaOf(expected[i / 30]) : 0.0, 1e-12);
    ASSERT_GT(dot(splats[i].normal, expected[i / 30].normal), 1.0 - 1e-9);
  }
}

// Points in lines, each closer to the next one than points may be: a visible one is close to each.
TEST(Splats, AreHiddenBesideVisibleOnesAlone)
{
  constexpr double step = 0.02;
  constexpr double closeness = 0.05; // see HiddenPoints
  clouds::Random random(7);
  std::vector<Vector> positions;
  for (int line = 0; line < 6; ++line)
  {
    for (int i = 0; i < 100; ++i)
    {
      const double along = step * (i + 0.4 * random());
      positions.push_back({ along, static_cast<double>(line), 0.0 });
    }
  }
  const std::vector<Splat> splats =
    splatsOf(positions, std::vector<Vector>(positions.size(), { 0.0, 0.0, 2.0 }));
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    double nearest = closeness; // visible point
    for (std::size_t k = 0; k < splats.size(); ++k)
    {
      const double distance = isopoint::lengthOf(isopoint::difference(positions[i], positions[k]));
      nearest = splats[k].radius > 0.0 ? std::min(nearest, distance) : nearest;
    }
    EXPECT_LT(nearest, closeness) << i;
    hidden += splats[i].radius > 0.0 ? 0 : 1;
  }
  EXPECT_GT(hidden, splats.size() / 3);
  EXPECT_LT(hidden, splats.size() * 3 / 4);
}

// The second cell reaches over the side of the first one, the third one does not.
TEST(Splats, CellsThatReachOverSidesOfOthersHaveMissedTheirPoints)
{
  using isopoint::SplatCell;
  const std::vector<Vector> positions{ { 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 } };
  const std::vector<Vector> planes(3, { 0.0, 0.0, 1.0 });
  const std::vector<isopoint::LocalFit> noFits;
  const isopoint::TangentFrame frame(planes[0]);
  const auto cellOf = [&](double reach, std::size_t right, std::size_t top)
  {
    // Counterclockwise from the corner before the side on the right.
    SplatCell cell{ {}, 0, 1.0, {} };
    const std::array<std::pair<Vector, std::size_t>, 4> corners{ { { { reach, -reach, 0 }, right },
      { { reach, reach, 0 }, top }, { { -reach, reach, 0 }, SplatCell::none },
      { { -reach, -reach, 0 }, SplatCell::none } } };
    for (const auto& [place, beyond] : corners)
    {
      cell.corners[cell.count++] = { isopoint::dot(place, frame.first),
        isopoint::dot(place, frame.second), beyond };
    }
    return cell;
  };
  isopoint::RawArray<SplatCell> cells;
  cells.resize(3);
  cells[0] = cellOf(1.0, 1, 2);
  cells[1] = cellOf(1.5, SplatCell::none, SplatCell::none);
  cells[2] = cellOf(0.9, SplatCell::none, SplatCell::none);
  EXPECT_EQ(isopoint::missedPoints({}, { positions, positions, noFits }, planes, cells),
    std::vector<isopoint::MissedPoint>{ isopoint::MissedPoint(1, 0) });
}

// The sides before and after it are parallel: they do not meet.
TEST(Splats, SidesThatOthersDroppedAreReplacedByTheirMiddle)
{
  using isopoint::SplatCell;
  for (const std::size_t cornersOfOther : { 7, 8 })
  {
    isopoint::RawArray<SplatCell> cells;
    cells.resize(4);
    std::fill_n(cells.data(), cells.size(), SplatCell{});
    SplatCell& cell = cells[0];
    cell.corners = { { { -1, -1, SplatCell::none }, { 1, -1, 2 }, { 1, 1, 1 }, { -1, 1, 3 } } };
    cell.count = 4;
    SplatCell& other = cells[1];
    other.count = cornersOfOther;
    for (std::size_t i = 0; i < other.count; ++i)
    {
      other.corners[i].beyond = i == 4 ? 3 : i == 5 ? 2 : SplatCell::none;
    }
    for (const std::size_t beside : { 2, 3 })
    {
      cells[beside].corners[0].beyond = 0;
      cells[beside].count = 1;
    }
    const SplatCell mutual = isopoint::withMutualSides(cells, 0);
    const bool isDropped = cornersOfOther == isopoint::mostCorners;
    EXPECT_EQ(mutual.count, isDropped ? 3 : 4);
    EXPECT_EQ(std::count_if(mutual.begin(), mutual.end(),
                [](const SplatCell::Corner& corner) { return corner.overlaps; }),
      isDropped ? 0 : 1);
    EXPECT_EQ(std::count_if(mutual.begin(), mutual.end(),
                [](const SplatCell::Corner& corner)
                { return corner.x == 0.0 && corner.y == 1.0 && corner.beyond == 3; }),
      isDropped ? 1 : 0);
  }
}

// Each of four cells around a corner has a short side for the one across it.
TEST(Splats, SidesThatCrossBecomeOneCorner)
{
  using isopoint::SplatCell;
  isopoint::RawArray<SplatCell> cells;
  cells.resize(4);
  for (std::size_t i = 0; i < 4; ++i)
  {
    // Counterclockwise around the corner: the cells i + 1, i + 2 and i + 3.
    cells[i] = {};
    cells[i].corners = { { { 0.0, 0.0, (i + 1) % 4 }, { 2.0, 1.9, (i + 2) % 4 },
      { 1.9, 2.0, (i + 3) % 4 }, { 0.0, 1.0, SplatCell::none } } };
    cells[i].count = 4;
  }
  for (std::size_t i = 0; i < 4; ++i)
  {
    const SplatCell cell = isopoint::withMutualSides(cells, i);
    ASSERT_EQ(cell.count, 3);
    EXPECT_EQ(cell.corners[1].beyond, (i + 3) % 4);
    EXPECT_EQ(cell.corners[1].x, 1.95);
    EXPECT_FALSE(cell.corners[0].overlaps || cell.corners[1].overlaps);
  }
}

TEST(Splats, NormalsOfTooFewOrCollinearPointsAreThoseOfTheirEdges)
{
  const Vector edge{ 0.0, 2.0, 0.0 };
  for (const std::vector<Vector>& positions :
    { std::vector<Vector>{ { 1, 1, 1 } }, std::vector<Vector>{ { 1, 1, 1 }, { 1, 1, 1 } },
      std::vector<Vector>{ { 0, 0, 0 }, { 1, 0, 0 } },
      std::vector<Vector>{ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 5, 0, 0 } } })
  {
    const std::vector<Splat> splats =
      splatsOf(positions, std::vector<Vector>(positions.size(), edge));
    for (std::size_t i = 0; i < splats.size(); ++i)
    {
      EXPECT_EQ(splats[i].normal, (Vector{ 0.0, 1.0, 0.0 }));
      if (i > 0 && positions[i] == positions[0])
      {
        EXPECT_EQ(splats[i].radius, 0.0);
      }
      else
      {
        EXPECT_GE(splats[i].radius, 0.9);
      }
    }
  }
  EXPECT_TRUE(splatsOf({}, {}).empty());
}

// Two sheets that decrease to opposite sides, closer to each other than the points of one.
TEST(Splats, NormalsOfSheetsCloseByPointToTheirOwnDecreasingSide)
{
  clouds::Random random(5);
  std::vector<Vector> positions;
  std::vector<Vector> edges;
  for (int i = 0; i < 4000; ++i)
  {
    const double side = i % 2 ? 1.0 : -1.0;
    positions.push_back({ random(), random(), 0.004 * side });
    edges.push_back({ 0.02 * (random() - 0.5), 0.02 * (random() - 0.5), 0.02 * side });
  }
  const std::vector<Splat> splats = splatsOf(positions, edges);
  int wrong = 0;
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    wrong += dot(splats[i].normal, edges[i]) > 0.0 ? 0 : 1;
  }
  EXPECT_EQ(wrong, 0);
}
