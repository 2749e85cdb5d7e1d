// SPDX-License-Identifier: GPL-3.0-or-later
// Splats of points whose surface is known: normals, shapes, coverage, creases.
#include "Clouds.h"

#include "Core/Extraction/WholeSurface.h"
#include "Core/Splat/CellTips.h"
#include "Core/Splat/SharedSides.h"
#include "Core/Splat/SplatGeometry.h"

#include <gtest/gtest.h>

namespace
{

using namespace isopoint;
using clouds::countOf;
using clouds::largestOf;

constexpr Vector up{ 0.0, 0.0, 1.0 };
constexpr Vector down{ 0.0, 0.0, -1.0 };

/// Samples that end at the plane x = 0.
struct HalfSpace
{
  double at(const ExtentQuery& query) const
  {
    const double along = query.direction[0];
    return along > 0.1 ? std::min(query.enough, -query.position[0] / along) : query.enough;
  }
  const WideSample* nearest(const ExtentQuery&) const { return nullptr; }
  const WideSample* nearestTo(const Vector&, double) const { return nullptr; }
};

/// Isopoints, one entry each. Without fits that list is empty.
struct Points
{
  std::vector<Vector> positions;
  std::vector<Vector> decreasingEdges;
  std::vector<LocalFit> fits;

  void addUnfitted(const Vector& position, const Vector& edge)
  {
    this->positions.push_back(position);
    this->decreasingEdges.push_back(edge);
  }

  LocalFit& add(const Vector& position, std::optional<FitOrder> order, const Vector& gradient,
    double spacing = 1.0)
  {
    this->addUnfitted(position, -gradient);
    LocalFit& fit = this->fits.emplace_back();
    fit.order = order;
    fit.isGradientFitted = true;
    fit.isSmooth = order >= FitOrder::Quadratic;
    fit.gradient = gradient;
    fit.spacing = spacing;
    return fit;
  }

  /// Adds a point on one of two planes that meet at the y axis at a right angle. A crease fit
  /// also has the plane of the other side.
  void addOnWedge(bool top, double along, double off, FitOrder order, const Vector& tilt = {})
  {
    const Vector place = top ? Vector{ off, along, 0.0 } : Vector{ 0.0, along, off };
    LocalFit& fit = this->add(place, order, (top ? down : Vector{ -1.0, 0.0, 0.0 }) + tilt);
    if (order == FitOrder::Crease)
    {
      fit.creases = { { top ? Vector{ -1.0, 0.0, 0.0 } : down, -off, -1.0 } };
    }
  }

  /// Negates the field.
  void negate()
  {
    for (std::size_t i = 0; i < this->positions.size(); ++i)
    {
      this->fits[i].gradient = -this->fits[i].gradient;
      this->decreasingEdges[i] = -this->decreasingEdges[i];
      for (CreasePlane& crease : this->fits[i].creases)
      {
        crease.turn = -crease.turn;
      }
    }
  }
};

/// Lists the points at the 48 nearest positions or, in two rings, at the 192 nearest.
struct NearestAround
{
  using Finder = NearestAround;

  explicit NearestAround(const std::vector<Vector>& all)
    : positions(all)
  {
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      this->pointsAt[all[i]].push_back(i);
    }
  }

  bool isAcrossGap(std::size_t, const WideSample&, double) const { return false; }

  std::vector<std::size_t> find(std::size_t point, int rings) const
  {
    std::vector<std::pair<double, const std::vector<std::size_t>*>> near;
    for (const auto& [position, points] : this->pointsAt)
    {
      near.emplace_back(lengthOf(position - this->positions[point]), &points);
    }
    const std::size_t count = std::min<std::size_t>(near.size(), rings > 1 ? 193 : 49);
    std::nth_element(
      near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count) - 1, near.end());
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < count; ++i)
    {
      found.insert(found.end(), near[i].second->begin(), near[i].second->end());
    }
    return found;
  }

  const std::vector<Vector>& positions;
  std::map<Vector, std::vector<std::size_t>> pointsAt;
};

/// A splat at its point.
struct PlacedSplat : Splat
{
  Vector point;
  Vector edge; // of the point, decreasing
};

std::vector<PlacedSplat> splatsOf(
  const Points& points, const HalfSpace* extents = nullptr, const SplatOptions& options = {})
{
  AllPoints all(points.positions.size());
  const std::vector<Splat> splats =
    computeSplats(clouds::executionOn(2), { points.positions, points.decreasingEdges, points.fits },
      NearestAround(points.positions), extents, options, all);
  EXPECT_EQ(splats.size(), points.positions.size());
  std::vector<PlacedSplat> placed;
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    placed.push_back({ splats[i], points.positions[i], points.decreasingEdges[i] });
  }
  return placed;
}

/// The corners of a splat, each once: those that repeat the last one are left out.
std::vector<SplatCorner> cornersOf(const Splat& splat)
{
  std::vector<SplatCorner> corners(splat.corners.begin(), splat.corners.end());
  corners.erase(std::unique(corners.begin(), corners.end(),
                  [](const SplatCorner& a, const SplatCorner& b)
                  { return a.along == b.along && a.across == b.across && a.height == b.height; }),
    corners.end());
  return corners;
}

/// The offset of a corner from its splat's point.
Vector offsetOf(const Splat& splat, const SplatCorner& corner)
{
  const Vector across = cross(splat.normal, splat.axis);
  const Vector inPlane = corner.along * splat.axis + corner.across * across;
  return inPlane + corner.height * splat.radius * splat.normal;
}

/// The area of a splat's triangles.
double areaOf(const Splat& splat)
{
  Vector before = offsetOf(splat, splat.corners.back());
  return clouds::sumOf(splat.corners,
    [&](const SplatCorner& corner)
    {
      const Vector last = std::exchange(before, offsetOf(splat, corner));
      return 0.5 * lengthOf(cross(last, before));
    });
}

/// Whether a place lies within one of the splats, seen along its normal.
/// @param step only one of so many splats is looked at, from the first one on
bool isCovered(const Vector& place, const std::vector<PlacedSplat>& splats, std::size_t step)
{
  constexpr double tolerance = 1e-6;
  for (std::size_t i = 0; i < splats.size(); i += step)
  {
    const PlacedSplat& splat = splats[i];
    const Vector offset = 1.0 / splat.radius / splat.radius * (place - splat.point);
    const double x = dot(offset, splat.axis);
    const double y = dot(offset, cross(splat.normal, splat.axis));
    const std::vector<SplatCorner> corners = cornersOf(splat);
    SplatCorner a = corners.back();
    for (const SplatCorner& b : corners)
    {
      if (a.along * y - a.across * x >= -tolerance && x * b.across - y * b.along >= -tolerance &&
          (b.along - a.along) * (y - a.across) - (b.across - a.across) * (x - a.along) >=
            -tolerance)
      {
        return true;
      }
      a = b;
    }
  }
  return false;
}

/// The largest coordinate of a splat's corners along an axis.
double reachAlong(const PlacedSplat& splat, std::size_t axis)
{
  return largestOf(splat.corners,
    [&](const SplatCorner& corner) { return splat.point[axis] + offsetOf(splat, corner)[axis]; });
}

/// Random points of the unit sphere, scaled and moved, with oblique edges that decrease outwards.
Points sphere(std::size_t count, double scale = 1.0, double offset = 0.0)
{
  clouds::Random random(3);
  Points points;
  while (points.positions.size() < count)
  {
    const Vector v = random.inCube(2.0);
    const double length = std::sqrt(dot(v, v));
    if (length > 0.1 && length < 1.0)
    {
      const Vector n = scale / length * v;
      const double oblique = 1.2 * scale * (random() - 0.5);
      points.addUnfitted(
        Vector{ offset, offset, offset } + n, 0.1 * Vector{ n[0] + oblique, n[1], n[2] - oblique });
    }
  }
  return points;
}

Points fittedSphere(std::size_t count, double spacing)
{
  const Hessian hessian{ -1.0, -1.0, -1.0, 0.0, 0.0, 0.0 };
  Points points;
  for (const Vector& p : sphere(count).positions)
  {
    points.add(p, FitOrder::Quadratic, -p, spacing).hessian = hessian;
  }
  return points;
}

/// Points of two planes that meet at the y axis at a right angle, in turn, with fits of one order
/// on each.
Points wedge(FitOrder topOrder, FitOrder sideOrder, int count = 800)
{
  Points points;
  clouds::Random random(7);
  for (int i = 0; i < count; ++i)
  {
    const double along = 10.0 * random();
    points.addOnWedge(i % 2 == 0, along, -4.0 * random(), i % 2 == 0 ? topOrder : sideOrder);
  }
  return points;
}

VoronoiCell cellOf(const std::vector<VoronoiCell::Corner>& corners)
{
  VoronoiCell cell{};
  std::copy(corners.begin(), corners.end(), cell.corners.begin());
  cell.count = corners.size();
  cell.unit = 1.0;
  return cell;
}

RawArray<VoronoiCell> arrayOf(const std::vector<VoronoiCell>& all)
{
  RawArray<VoronoiCell> cells;
  cells.resize(all.size());
  std::copy(all.begin(), all.end(), cells.data());
  return cells;
}

} // namespace

TEST(Splats, NormalsPointToDecreasingValues)
{
  for (const double scale : { 1.0, 1e-20, 1e20 })
  {
    for (const PlacedSplat& splat : splatsOf(sphere(5000, scale, scale)))
    {
      ASSERT_NEAR(dot(splat.normal, splat.normal), 1.0, 1e-12);
      const Vector outwards = splat.point - Vector{ scale, scale, scale };
      ASSERT_GT(dot(splat.normal, outwards), 0.98 * scale);
    }
  }
}

// The corners lie on the sphere, have its normals, and are those of neighboring splats.
TEST(Splats, AreClosedAndBentAsTheSurfaceIs)
{
  const std::vector<PlacedSplat> splats = splatsOf(fittedSphere(800, 0.12));
  double heights = 0.0;
  std::vector<Vector> corners;
  for (const PlacedSplat& splat : splats)
  {
    if (!(splat.radius > 0.0))
    {
      continue; // another one represents it
    }
    const Vector along = 1.0 / splat.radius * splat.axis;
    for (const SplatCorner& corner : cornersOf(splat))
    {
      const Vector place = splat.point + offsetOf(splat, corner);
      ASSERT_NEAR(lengthOf(place), 1.0, 0.002);
      const Vector normal =
        splat.normal + corner.slopeAlong * along + corner.slopeAcross * cross(splat.normal, along);
      ASSERT_GT(dot(directionOf(normal), place), 0.9995);
      heights = std::max(heights, std::abs(static_cast<double>(corner.height)));
      corners.push_back(place);
    }
  }
  EXPECT_GT(heights, 0.04);
  const double sphereArea = 4.0 * std::acos(-1.0);
  EXPECT_NEAR(clouds::sumOf(splats, areaOf), sphereArea, 0.02 * sphereArea);
  const auto splatsAt = [&](const Vector& a)
  { return countOf(corners, [&](const Vector& b) { return lengthOf(a - b) < 1e-6; }); };
  EXPECT_GT(countOf(corners, [&](const Vector& corner) { return splatsAt(corner) >= 3; }),
    corners.size() * 97 / 100);
}

// Cells with more than eight corners lose sides that others keep. Where several of these are
// consecutive, the corners around them become one.
TEST(Splats, MeetAtAllCornersOfASphere)
{
  constexpr std::size_t count = 4000;
  std::size_t inner = 0;
  std::size_t apart = 0;
  for (const PlacedSplat& splat : splatsOf(fittedSphere(count, 0.055)))
  {
    inner += splat.counts.inner;
    apart += splat.counts.apart;
  }
  EXPECT_GT(inner, 5 * count);
  EXPECT_EQ(apart, 0u);
}

// Rows ten times farther apart than points in a row: the nearest points all lie in one row.
TEST(Splats, CoverTheGapsBetweenRows)
{
  Points points;
  for (int i = 0; i < 20 * 200; ++i)
  {
    points.add({ 0.1 * (i % 200), static_cast<double>(i / 200), 0.0 }, FitOrder::Linear, down);
  }
  const Splat inside = splatsOf(points)[10 * 200 + 100];
  EXPECT_EQ(inside.normal, up);
  EXPECT_GT(inside.radius, 0.5);
  EXPECT_LT(inside.radius, 0.7);
}

TEST(Splats, OfAnIsolatedPointStaySmall)
{
  Points points = sphere(800);
  points.addUnfitted({ 50.0, 0.0, 0.0 }, { 0.1, 0.0, 0.0 });
  EXPECT_LT(splatsOf(points).back().radius, 0.12);
}

// Where a coarse lattice meets a fine one, many isopoints crowd at one coarse sample. Their splats
// cover what lies between that and the next.
TEST(Splats, CoverTheGapsBetweenCrowds)
{
  Points points;
  for (int i = 0; i < 9 * 9 * 14; ++i)
  {
    const int n = i % 14;
    points.add({ i / 14 / 9 - 4 + 0.001 * std::cos(n), i / 14 % 9 - 4 + 0.001 * std::sin(n), 0.0 },
      std::nullopt, down);
  }
  double farthest = 0.0; // of the splats at the middle
  for (const PlacedSplat& splat : splatsOf(points))
  {
    farthest = std::max(farthest, lengthOf(splat.point) < 0.1 ? splat.radius : 0.0);
  }
  EXPECT_GT(farthest, 0.7);
  EXPECT_LT(farthest, 1.5);
}

// A wavy sheet: planes through more points are flatter.
TEST(Splats, PlanesAreFittedToAsManyPointsAsRequested)
{
  Points points;
  for (int i = 0; i < 41 * 41; ++i)
  {
    const int x = i / 41;
    const int y = i % 41;
    points.addUnfitted({ 1.0 * x, 1.0 * y, (x + y) % 2 == 0 ? 0.2 * (y % 3) : 0.0 }, up);
  }
  const auto worstSlope = [&](int count)
  {
    SplatOptions options;
    options.neighborCount = count;
    options.fieldNormals = false;
    const std::vector<PlacedSplat> splats = splatsOf(points, nullptr, options);
    double slope = 0.0;
    for (std::size_t i = 0; i < 11 * 11; ++i)
    {
      const Vector& normal = splats[41 * (15 + i / 11) + 15 + i % 11].normal;
      slope = std::max(slope, std::hypot(normal[0], normal[1]));
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
    EXPECT_LT(largestOf(splatsOf(fittedSphere(count, 2.0)),
                [](const Splat& splat) { return splat.radius; }),
      1.8);
  }
}

// At the border of a sheet cells are bounded far outside, by other points of the border only.
TEST(Splats, EndSoonBeyondTheSamples)
{
  Points points;
  clouds::Random random(5);
  for (int i = 0; i < 1000; ++i)
  {
    points.add({ -10.0 * random(), 40.0 * random(), 0.0 }, FitOrder::Quadratic, down);
  }
  const HalfSpace samples;
  const double farthest = largestOf(
    splatsOf(points, &samples), [](const PlacedSplat& splat) { return reachAlong(splat, 0); });
  EXPECT_GT(farthest, 0.1);
  EXPECT_LT(farthest, 1.5);
}

// A point whose edge leads far across a void, and one whose normal is wrong though its edge is not.
TEST(Splats, OfStrayPointsAreHidden)
{
  Points points;
  points.add({ 5.0, 5.0, 3.0 }, std::nullopt, { 1.0, 0.0, 1.0 });
  points.decreasingEdges.back() = { -4.5, 0.0, 0.0 };
  points.add({ 0.1, 0.0, 0.0 }, std::nullopt, { 0.5, 0.0, 0.9 });
  points.decreasingEdges.back() = up;
  for (int i = 0; i < 21 * 21; ++i)
  {
    points.add(
      { 0.7 * (i / 21 - 10) + 0.35, 0.7 * (i % 21 - 10) + 0.35, 0.0 }, FitOrder::Quadratic, down);
  }
  const std::vector<PlacedSplat> splats = splatsOf(points);
  EXPECT_EQ(splats[0].radius, 0.0);
  EXPECT_EQ(splats[1].radius, 0.0);
  EXPECT_TRUE(isCovered({ 0.1, 0.0, 0.0 }, splats, 1)) << "by others";
  points.decreasingEdges[0] = { -3.5, 0.0, 0.0 };
  EXPECT_GT(splatsOf(points)[0].radius, 0.5);
}

// The first cell sticks out between two that end at a border before they reach its corner.
TEST(Splats, EndBetweenOthersWhereTheseEnd)
{
  const std::vector<Vector> positions{ { 0, 0, 0 }, { 2, 2, 0 }, { -2, 2, 0 } };
  const std::vector<Vector> planes(3, up);
  const std::vector<LocalFit> noFits;
  const SurfacePoints points{ positions, positions, noFits };
  constexpr std::size_t none = VoronoiCell::none;
  const auto cellAt = [](const std::vector<std::pair<Vector, std::size_t>>& corners)
  {
    LoweredCell cell{};
    for (const auto& [position, beyond] : corners)
    {
      cell.sides[cell.count] = { beyond, false };
      cell.corners[cell.count++] = { position, up, 1.0 };
    }
    return cell;
  };
  RawArray<LoweredCell> cells;
  cells.resize(3);
  cells[0] = cellAt({ { { -1, 0, 0 }, none }, { { 1, 0, 0 }, 1 }, { { 0, 3, 0 }, 2 } });
  cells[1] = cellAt({ { { 1, 0, 0 }, none }, { { 3, 1, 0 }, none }, { { 0.9, 0.3, 0 }, 0 } });
  cells[2] = cellAt({ { { -0.9, 0.3, 0 }, none }, { { -3, 1, 0 }, none }, { { -1, 0, 0 }, 0 } });
  cells[0].corners[2].distance = 3.0;
  cutOffTips({}, points, planes, cells);
  ASSERT_EQ(cells[0].count, 4u);
  EXPECT_EQ(cells[0].corners[2].position, (Vector{ 0.9, 0.3, 0.0 }));
  EXPECT_EQ(cells[0].sides[2].beyond, none);
  EXPECT_EQ(cells[0].corners[3].position, (Vector{ -0.9, 0.3, 0.0 }));
  EXPECT_EQ(cells[0].sides[3].beyond, 2u);
  EXPECT_EQ(cells[1].count + cells[2].count, 6u);
}

// The splats of a plane cover it once, wherever fits held.
TEST(Splats, OfPointsWithAndWithoutSmoothFitsDoNotOverlap)
{
  constexpr int half = 12;
  constexpr double distance = 0.4;
  clouds::Random random(3);
  Points points;
  for (int i = 0; i < 25 * 25; ++i)
  {
    const double x = distance * (i / 25 - half + 0.4 * random());
    const double y = distance * (i % 25 - half + 0.4 * random());
    points.add(
      { x, y, 0.0 }, random() < 0.5 ? std::optional(FitOrder::Quadratic) : std::nullopt, down);
  }
  double area = 0.0;
  double inner = 0.0; // of Voronoi cells, which are one of the lattice's on average
  for (const PlacedSplat& splat : splatsOf(points))
  {
    if (std::max(std::abs(splat.point[0]), std::abs(splat.point[1])) < distance * (half - 2))
    {
      area += areaOf(splat);
      inner += distance * distance;
    }
  }
  EXPECT_NEAR(area / inner, 1.0, 0.03);
}

// In a lattice the planes halfway to diagonal neighbors pass through the corners that the others
// leave: rounding decides which of them cut. Shapes do not depend on that.
TEST(Splats, ShapesDoNotDependOnRounding)
{
  const auto middleTurnedBy = [](double angle, double noise)
  {
    clouds::Random random(2);
    Points points;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    for (int i = 0; i < 13 * 13; ++i)
    {
      const double x = 0.8 * (i / 13 - 6) + noise * random();
      const double y = 0.5 * (i % 13 - 6) + noise * random();
      points.add({ c * x - s * y, s * x + c * y, noise * random() }, FitOrder::Quadratic, down)
        .hessian = { 0.1 * c * c, 0.1 * s * s, 0.0, 0.1 * c * s, 0.0, 0.0 };
    }
    return splatsOf(points)[84];
  };
  const Splat expected = middleTurnedBy(0.0, 0.0);
  for (int i = 0; i < 50; ++i)
  {
    const Splat splat = middleTurnedBy(0.1 * i, i % 2 == 0 ? 0.0 : 1e-12);
    EXPECT_NEAR(splat.radius, expected.radius, 1e-9) << i;
    EXPECT_NEAR(areaOf(splat), areaOf(expected), 1e-6) << i;
  }
}

// A corner is listed once, however many cuts pass through it, and cuts that miss the cell leave it.
TEST(Splats, CellsListEachCornerOnce)
{
  TangentPolygon cell(up, 4.0);
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
  TangentPolygon cell(up, 1.0);
  cell.cut(1.0, 0.0, 0.99, 7);
  cell.cut(0.0, 1.0, 0.999, 8);
  EXPECT_EQ(cell.end() - cell.begin(), 10);
  for (int i = 0; i < 2; ++i)
  {
    cell.reduceTo(8);
    EXPECT_EQ(cell.end() - cell.begin(), 8);
  }
  for (const TangentPolygon::Corner& corner : cell)
  {
    EXPECT_EQ(corner.side, TangentPolygon::limit);
    EXPECT_NEAR(std::hypot(corner.x, corner.y), 1.0, 0.011);
  }
}

// Samples whose value equals the isovalue have many isopoints at their own position.
TEST(Splats, CoincidentPointsCountOnceAmongTheNearest)
{
  const Points points = sphere(800);
  const std::vector<PlacedSplat> expected = splatsOf(points);
  Points repeated;
  for (std::size_t i = 0; i < 30 * expected.size(); ++i)
  {
    repeated.addUnfitted(points.positions[i / 30], points.decreasingEdges[i / 30]);
  }
  const std::vector<PlacedSplat> splats = splatsOf(repeated);
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
  constexpr double closeness = 0.05; // see HiddenPoints
  clouds::Random random(7);
  Points points;
  for (int i = 0; i < 600; ++i)
  {
    points.addUnfitted(
      { 0.02 * (i % 100 + 0.4 * random()), static_cast<double>(i / 100), 0.0 }, 2.0 * up);
  }
  const std::vector<PlacedSplat> splats = splatsOf(points);
  for (const PlacedSplat& splat : splats)
  {
    const auto isVisibleNear = [&](const PlacedSplat& other)
    { return other.radius > 0.0 && lengthOf(splat.point - other.point) < closeness; };
    EXPECT_GT(countOf(splats, isVisibleNear), 0u);
  }
  const std::size_t hidden =
    countOf(splats, [](const Splat& splat) { return splat.radius == 0.0; });
  EXPECT_GT(hidden, splats.size() / 3);
  EXPECT_LT(hidden, splats.size() * 3 / 4);
}

// The second cell reaches over the side of the first one, the third one does not.
TEST(Splats, CellsThatReachOverSidesOfOthersHaveMissedTheirPoints)
{
  const std::vector<Vector> positions{ { 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 } };
  const std::vector<Vector> planes(3, up);
  const std::vector<LocalFit> noFits;
  const TangentFrame frame(up);
  constexpr std::size_t none = VoronoiCell::none;
  const auto square = [&](double reach, std::size_t right, std::size_t top)
  {
    const auto corner = [&](double x, double y, std::size_t beyond) -> VoronoiCell::Corner {
      return { dot({ x, y, 0.0 }, frame.first), dot({ x, y, 0.0 }, frame.second), beyond };
    };
    // Counterclockwise from the corner before the side on the right.
    return cellOf({ corner(reach, -reach, right), corner(reach, reach, top),
      corner(-reach, reach, none), corner(-reach, -reach, none) });
  };
  const auto cells =
    arrayOf({ square(1.0, 1, 2), square(1.5, none, none), square(0.9, none, none) });
  EXPECT_EQ(missedPoints({}, { positions, positions, noFits }, planes, cells),
    std::vector<MissedPoint>{ MissedPoint(1, 0) });
}

// Each of four cells around a corner has a short side for the one across it.
TEST(Splats, SidesThatCrossBecomeOneCorner)
{
  std::vector<VoronoiCell> all;
  for (std::size_t i = 0; i < 4; ++i)
  {
    // Counterclockwise around the corner: the cells i + 1, i + 2 and i + 3.
    all.push_back(cellOf({ { 0.0, 0.0, (i + 1) % 4 }, { 2.0, 1.9, (i + 2) % 4 },
      { 1.9, 2.0, (i + 3) % 4 }, { 0.0, 1.0, VoronoiCell::none } }));
  }
  const RawArray<VoronoiCell> cells = arrayOf(all);
  for (std::size_t i = 0; i < 4; ++i)
  {
    const VoronoiCell cell = withSharedSides(cells, i);
    ASSERT_EQ(cell.count, 3);
    EXPECT_EQ(cell.corners[1].beyond, (i + 3) % 4);
    EXPECT_EQ(cell.corners[1].x, 1.95);
    EXPECT_FALSE(cell.corners[0].overlaps || cell.corners[1].overlaps);
  }
}

TEST(Splats, NormalsOfTooFewOrCollinearPointsAreThoseOfTheirEdges)
{
  for (const std::vector<Vector>& positions :
    { std::vector<Vector>{}, { { 1, 1, 1 } }, { { 1, 1, 1 }, { 1, 1, 1 } },
      { { 0, 0, 0 }, { 1, 0, 0 } }, { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 5, 0, 0 } } })
  {
    Points points;
    points.positions = positions;
    points.decreasingEdges.assign(positions.size(), { 0.0, 2.0, 0.0 });
    const std::vector<PlacedSplat> splats = splatsOf(points);
    for (std::size_t i = 0; i < splats.size(); ++i)
    {
      EXPECT_EQ(splats[i].normal, (Vector{ 0.0, 1.0, 0.0 }));
      const bool isHidden = i > 0 && positions[i] == positions[0];
      EXPECT_TRUE(isHidden ? splats[i].radius == 0.0 : splats[i].radius >= 0.9);
    }
  }
}

// Two sheets that decrease to opposite sides, closer to each other than the points of one.
TEST(Splats, NormalsOfSheetsCloseByPointToTheirOwnDecreasingSide)
{
  clouds::Random random(5);
  Points points;
  for (int i = 0; i < 4000; ++i)
  {
    const double side = i % 2 ? 1.0 : -1.0;
    points.addUnfitted({ random(), random(), 0.004 * side },
      { 0.02 * (random() - 0.5), 0.02 * (random() - 0.5), 0.02 * side });
  }
  for (const PlacedSplat& splat : splatsOf(points))
  {
    EXPECT_GT(dot(splat.normal, splat.edge), 0.0);
  }
}

// Crease fits on both planes: each splat that reaches the other plane ends there.
TEST(SplatCreases, EndAtTheOtherSide)
{
  const std::vector<PlacedSplat> splats = splatsOf(wedge(FitOrder::Crease, FitOrder::Crease, 2000));
  int ending = 0;
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    const double beyond = reachAlong(splats[i], i % 2 == 0 ? 0 : 2);
    ASSERT_LT(beyond, 1e-6) << i;
    ending += beyond > -1e-6 ? 1 : 0;
  }
  EXPECT_GT(ending, 50);
}

// At a corner the splat ends at both creases.
TEST(SplatCreases, OfOnePointAllCount)
{
  Points points;
  clouds::Random random(4);
  for (int i = 0; i < 500; ++i)
  {
    const Vector place{ -3.0 * random(), -3.0 * random(), 0.0 };
    points.add(place, FitOrder::Crease, down).creases = { { { -1.0, 0.0, 0.0 }, -place[0], -1.0 },
      { { 0.0, -1.0, 0.0 }, -place[1], -1.0 } };
  }
  const std::vector<PlacedSplat> splats = splatsOf(points);
  int ending = 0;
  for (std::size_t i = 0; i < 2 * splats.size(); ++i)
  {
    const double beyond = reachAlong(splats[i / 2], i % 2);
    ASSERT_LT(beyond, 1e-6);
    ending += beyond > -1e-6 ? 1 : 0;
  }
  EXPECT_GT(ending, 40);
}

// Also if there are crease fits on one side only.
TEST(SplatCreases, CoverAFaceUpToItsCrease)
{
  for (const FitOrder order : { FitOrder::Quadratic, FitOrder::Cubic, FitOrder::Crease })
  {
    const std::vector<PlacedSplat> splats = splatsOf(wedge(order, FitOrder::Crease));
    clouds::Random random(8);
    for (int k = 0; k < 4000; ++k)
    {
      const Vector place{ -0.5 * random(), 1.0 + 8.0 * random(), 0.0 };
      ASSERT_TRUE(isCovered(place, splats, 2)) << place[0] << ' ' << place[1];
    }
  }
}

TEST(SplatCreases, OfPointsOnACreaseCoverTheirOwnSide)
{
  for (const bool isNegated : { false, true })
  {
    Points points = wedge(FitOrder::Crease, FitOrder::Crease);
    for (std::size_t i = 0; i < 40; ++i)
    {
      points.positions[i] = { 0.0, 0.25 * static_cast<double>(i), 0.0 };
      points.fits[i].creases[0].distance = 0.0;
    }
    if (isNegated)
    {
      points.negate();
    }
    const std::vector<PlacedSplat> splats = splatsOf(points);
    std::size_t hidden = 0; // behind a point close by
    for (std::size_t i = 0; i < 40; ++i)
    {
      const bool isHidden = splats[i].radius == 0.0;
      hidden += isHidden ? 1 : 0;
      EXPECT_TRUE(isHidden || splats[i].radius > 0.1) << i;
      EXPECT_NEAR(reachAlong(splats[i], i % 2 == 0 ? 0 : 2), 0.0, 1e-6) << i;
    }
    EXPECT_LE(hidden, 2u);
  }
}

// A field and its negative have the same surface; only the directions of normals differ.
TEST(SplatCreases, OfTheNegatedFieldHaveTheSameShape)
{
  Points points;
  clouds::Random random(6);
  for (int i = 0; i < 2000; ++i)
  {
    const bool top = i % 2 == 0;
    const auto [along, off, tilt] = random.place();
    const double turn = 0.05 * (tilt - 0.5);
    points.addOnWedge(top, 10.0 * along, -3.0 * off, FitOrder::Crease,
      top ? Vector{ turn, 0.0, 0.0 } : Vector{ 0.0, 0.0, turn });
  }
  const std::vector<PlacedSplat> splats = splatsOf(points);
  points.negate();
  const std::vector<PlacedSplat> turned = splatsOf(points);
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    ASSERT_EQ(turned[i].normal, -splats[i].normal);
    ASSERT_NEAR(turned[i].radius, splats[i].radius, 1e-9) << i;
    ASSERT_NEAR(areaOf(turned[i]), areaOf(splats[i]), 1e-6) << i;
  }
}

// A single wrong crease fit in a plane leaves no hole there.
TEST(SplatCreases, OfASingleWrongFitHarmNoOthers)
{
  Points points;
  clouds::Random random(4);
  points.add({ 0.0, 0.0, 0.0 }, FitOrder::Crease, { -1.0, 0.0, -1.0 }).creases = { { down, 0.0,
    -1.0 } };
  for (int i = 1; i < 500; ++i)
  {
    points.add({ 10.0 * random() - 5.0, 10.0 * random() - 5.0, 0.0 }, FitOrder::Quadratic, down);
  }
  const std::vector<PlacedSplat> splats = splatsOf(points);
  for (int k = 0; k < 4000; ++k)
  {
    const Vector place{ 4.0 * random() - 2.0, 4.0 * random() - 2.0, 0.0 };
    ASSERT_TRUE(isCovered(place, splats, 1)) << place[0] << ' ' << place[1];
  }
}
