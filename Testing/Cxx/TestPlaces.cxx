// SPDX-License-Identifier: GPL-3.0-or-later
// Values at places: equal to their definition, the same however they are computed, and true.
#include "PlaceDefinition.h"

#include <gtest/gtest.h>

namespace
{

using clouds::Cloud;
using namespace places;

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

ProbeOptions optionsOf(PlaceMethod method, OutsideStrategy outside = OutsideStrategy::Extrapolate)
{
  return { method, outside, notANumber };
}

/// Layers with random positions in each.
Cloud layers(std::size_t count, int layerCount, std::uint64_t seed)
{
  return clouds::withValuesOf(clouds::moved(clouds::uniform(count, seed), [=](double* p)
                                { p[2] = std::floor(layerCount * p[2]) / layerCount; }),
    clouds::waves);
}

double affine(const Vector& p)
{
  return 1.7 * p[0] - p[1] + 0.3 * p[2] + 5.0;
}

std::vector<Cloud> variousClouds()
{
  return { clouds::uniform(1500, 1), clouds::clustered(1500, 2), clouds::lattice(9, 9, 9),
    clouds::coincident(clouds::uniform(900, 3), 0.3), layers(1200, 8, 4),
    clouds::moved(clouds::flattened(clouds::uniform(700, 5), 2), clouds::turn),
    clouds::moved(clouds::flattened(clouds::uniform(200, 6), 1), clouds::turn),
    clouds::uniform(70, 7), clouds::uniform(26, 8), clouds::uniform(9, 9), clouds::uniform(3, 10),
    clouds::uniform(1, 11), clouds::nestedCoincident(60) };
}

/// The largest jump of values between neighbors, and of gradients, over the range of values.
std::pair<double, double> largestJumps(
  isopoint::IsosurfaceExtractor& extractor, const Array& array, PlaceMethod method, double step)
{
  std::vector<Vector> line;
  constexpr double length = 0.25;
  for (double along = 0.0; along < length; along += step)
  {
    line.push_back(Vector{ 0.35, 0.4, 0.3 } + along * Vector{ 0.8, 0.36, 0.48 });
  }
  const Probed found = probe(extractor, line, optionsOf(method), { array });
  std::pair<double, double> largest{ 0.0, 0.0 };
  for (std::size_t i = 1; i < line.size(); ++i)
  {
    largest.first = std::max(largest.first, std::abs(found.values[0][i] - found.values[0][i - 1]));
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      largest.second = std::max(largest.second,
        std::abs(found.gradients[0][3 * i + axis] - found.gradients[0][3 * (i - 1) + axis]));
    }
  }
  return largest;
}

} // namespace

TEST(Places, EqualTheDefinition)
{
  const std::vector<Cloud> clouds = variousClouds();
  for (std::size_t number = 0; number < clouds.size(); ++number)
  {
    const Cloud& cloud = clouds[number];
    const std::vector<Array> arrays = variousArrays(cloud);
    std::vector<Vector> all = randomPlaces(cloud, 40, 0.1, 0.9, 12);
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      // Lattices are larger; clusters are around the origin, at all scales.
      all[i] = number == 2 ? 8.0 * all[i] : number == 1 ? 1.03 * cloud.at(i) : all[i];
    }
    for (const PlaceMethod method : allMethods)
    {
      SCOPED_TRACE(testing::Message() << "cloud " << number << ", method " << int(method));
      const ProbeOptions options = optionsOf(method);
      const Probed found = probe(cloud, all, options, arrays);
      for (std::size_t a = 0; a < arrays.size(); ++a)
      {
        const auto components = static_cast<std::size_t>(arrays[a].components);
        for (std::size_t i = 0; i < all.size(); ++i)
        {
          const auto expected =
            placedefinition::at(cloud, arrays[a], all[i], method, placedefinition::countOf(method));
          for (std::size_t c = 0; c < components; ++c)
          {
            const double value = found.values[a][components * i + c];
            ASSERT_EQ(std::isnan(value), expected.isNothing) << a << " " << i;
            for (std::size_t k = 0; k < 4 && !expected.isNothing; ++k)
            {
              const double number =
                k == 0 ? value : found.gradients[a][3 * (components * i + c) + k - 1];
              const double right =
                expected.numbers(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(c));
              // Coefficients that are hardly determined have half of the digits.
              ASSERT_NEAR(number, right, 1e-6 * (k == 0 ? 1.0 : 10.0) * (1.0 + std::abs(right)))
                << "array " << a << ", place " << i << ", number " << k;
            }
          }
        }
      }
    }
  }
}

TEST(Places, AreTheSameHoweverTheyAreComputed)
{
  for (const Cloud& cloud : { clouds::coincident(clouds::uniform(4000, 1), 0.2),
         clouds::clustered(4000, 2), clouds::lattice(16, 16, 16), layers(3000, 9, 3) })
  {
    const std::vector<Array> arrays = variousArrays(cloud);
    const std::vector<Vector> all = randomPlaces(cloud, 500, -0.2, 1.2, 4);
    const std::vector<Vector> reversed(all.rbegin(), all.rend());
    for (const PlaceMethod method : allMethods)
    {
      for (const OutsideStrategy outside :
        { OutsideStrategy::Number, OutsideStrategy::Nearest, OutsideStrategy::Extrapolate })
      {
        const ProbeOptions options = optionsOf(method, outside);
        auto extractor = clouds::loaded(cloud);
        const Probed expected = probe(extractor, all, options, arrays);
        EXPECT_EQ(probe(extractor, all, options, arrays, 4).bytes(), expected.bytes());
        auto refined = clouds::loaded<double, double>(cloud, 3);
        refined.extract({}, clouds::requestOf(0.4, isopoint::FitOrder::Cubic));
        EXPECT_EQ(probe(refined, all, options, arrays).bytes(), expected.bytes());
        Probed again;
        again.kinds = expected.kinds;
        const Neighborhoods kept = extractor.findNeighborhoods({}, all, options);
        EXPECT_EQ(kept.kinds, expected.kinds);
        extractor.probe({}, kept, probedArrays(arrays, all.size(), again));
        EXPECT_EQ(again.bytes(), expected.bytes());
        const Probed backwards = probe(extractor, reversed, options, arrays);
        for (std::size_t i = 0; i < all.size(); ++i)
        {
          ASSERT_EQ(backwards.kinds[all.size() - 1 - i], expected.kinds[i]);
          const double other = backwards.values[0][all.size() - 1 - i];
          ASSERT_TRUE(other == expected.values[0][i] || std::isnan(other));
        }
      }
    }
    auto probed = clouds::loaded(cloud);
    probe(probed, all, optionsOf(PlaceMethod::Blend), arrays);
    for (const auto& request : { clouds::requestOf(0.4, FitOrder::Cubic),
           clouds::withTriangles(clouds::requestOf(0.4), false) })
    {
      const auto unprobed = clouds::loaded(cloud).extract({}, request).surface;
      const auto after = probed.extract({}, request).surface;
      EXPECT_TRUE(after.positions == unprobed.positions && after.edges == unprobed.edges);
    }
  }
}

TEST(Places, ReproduceConstantsAndAffineFunctionsAndIgnoreTheOrderOfSamples)
{
  const Cloud cloud = clouds::withValuesOf(clouds::uniform(5000, 3), affine);
  const std::vector<std::size_t> order = clouds::randomOrder(cloud.size(), 5);
  const Cloud other = clouds::permuted(cloud, order);
  const std::vector<Vector> all = randomPlaces(cloud, 500, 0.0, 1.0, 4);
  for (const PlaceMethod method : allMethods)
  {
    if (method == PlaceMethod::Nearest)
    {
      continue;
    }
    const ProbeOptions options = optionsOf(method, OutsideStrategy::Number);
    const Probed found =
      probe(cloud, all, options, { { cloud.values }, { Numbers(cloud.size(), 3.7) } });
    const Probed permuted = probe(other, all, options, { { other.values } });
    std::size_t inside = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      if (found.isOutside(i))
      {
        continue;
      }
      ++inside;
      ASSERT_NEAR(found.values[0][i], affine(all[i]), 1e-12);
      ASSERT_EQ(found.values[1][i], 3.7);
      ASSERT_EQ(found.gradients[1][3 * i], 0.0);
      ASSERT_NEAR(permuted.values[0][i], found.values[0][i], 1e-12);
    }
    EXPECT_GT(inside, 300u);
  }
}

TEST(Places, SamplesAtOneDistanceHaveWeights)
{
  // All permutations and signs of (1, 2, 3): more than most methods fit to.
  Cloud shell;
  Vector place{ 1.0, 2.0, 3.0 };
  do
  {
    for (int signs = 0; signs < 8; ++signs)
    {
      shell.add({ (signs & 1) != 0 ? -place[0] : place[0], (signs & 2) != 0 ? -place[1] : place[1],
                  (signs & 4) != 0 ? -place[2] : place[2] },
        0.0);
    }
  } while (std::next_permutation(place.begin(), place.end()));
  // A cubic close packing: twelve nearest samples around each.
  Cloud packing = clouds::filtered(clouds::lattice(9, 9, 9),
    [](const Vector& p) { return std::lround(8.0 * (p[0] + p[1] + p[2])) % 2 == 0; });
  for (Cloud* const cloud : { &shell, &packing })
  {
    *cloud = clouds::withValuesOf(*cloud, affine);
    const Vector middle = cloud == &shell ? Vector{ 0.0, 0.0, 0.0 } : Vector{ 0.5, 0.5, 0.5 };
    for (const PlaceMethod method :
      { PlaceMethod::Blend, PlaceMethod::Cubic, PlaceMethod::Quadratic, PlaceMethod::Affine })
    {
      const Probed found = probe(*cloud, { middle }, optionsOf(method), { { cloud->values } });
      EXPECT_NEAR(found.values[0][0], affine(middle), 1e-12);
      EXPECT_NEAR(found.gradients[0][0], 1.7, 1e-10);
    }
  }
}

TEST(Places, FlatCloudsGiveTheValuesThatTheyDetermine)
{
  const auto field = [](const Vector& p) { return std::sin(2.0 * p[0]) + p[1] * p[1]; };
  for (const int dimensions : { 2, 1 })
  {
    Cloud cloud = clouds::flattened(clouds::uniform(dimensions == 2 ? 20000 : 500, 6), dimensions);
    cloud = clouds::withValuesOf(cloud, field);
    std::vector<Vector> inside;
    for (int i = 0; i < 50; ++i)
    {
      inside.push_back({ 0.1 + 0.016 * i, dimensions > 1 ? 0.9 - 0.015 * i : 0.25, 0.25 });
    }
    for (const PlaceMethod method : { PlaceMethod::Blend, PlaceMethod::Cubic })
    {
      // Turned out of the planes of the axes, where rounding makes it nearly flat.
      Cloud turned = clouds::moved(cloud, clouds::turn);
      std::vector<Vector> moved = inside;
      for (Vector& place : moved)
      {
        clouds::turn(place.data());
      }
      const Probed found =
        probe(turned, moved, optionsOf(method, OutsideStrategy::Number), { { turned.values } });
      Vector normal{ 0.0, 0.0, 1.0 };
      clouds::turn(normal.data());
      std::size_t outside = 0; // in gaps
      for (std::size_t i = 0; i < inside.size(); ++i)
      {
        ASSERT_NE(found.kinds[i] & PlaceFlat, 0);
        if (found.isOutside(i))
        {
          ++outside;
          continue;
        }
        ASSERT_NEAR(found.values[0][i], field(inside[i]), 1e-4);
        const double* const g = found.gradients[0].data() + 3 * i;
        ASSERT_NEAR(dot(Vector{ g[0], g[1], g[2] }, normal), 0.0, 1e-9);
      }
      EXPECT_LE(outside, 5u);
    }
  }
}

TEST(Places, ColumnsAndSlabsGiveNothingAbsurd)
{
  const auto smooth = [](const Vector& p)
  { return std::sin(3.0 * p[0]) + std::cos(2.0 * p[1]) + p[2]; };
  Cloud columns;
  const Cloud heads = clouds::uniform(300, 12);
  for (std::size_t i = 0; i < 12 * heads.size(); ++i)
  {
    const Vector head = heads.at(i / 12);
    columns.add({ head[0], head[1], 5e-4 * static_cast<double>(i % 12) }, 0.0);
  }
  columns = clouds::withValuesOf(columns, smooth);
  std::vector<Vector> between;
  between.reserve(5000);
  for (const Vector& place : randomPlaces(Cloud(), 5000, 0.1, 0.9, 13))
  {
    between.push_back({ place[0], place[1], 0.006 * place[2] });
  }
  const Probed found =
    probe(columns, between, optionsOf(PlaceMethod::Blend), { { columns.values } });
  for (std::size_t i = 0; i < between.size(); ++i)
  {
    ASSERT_NEAR(found.values[0][i], smooth(between[i]), 0.5);
  }
  // A plane, rounded to float, is flat: gradients have no part across.
  const Cloud rough = clouds::moved(clouds::flattened(clouds::uniform(20000, 14), 2),
    [](double* p)
    {
      p[0] *= 0.02;
      p[1] *= 0.02;
      clouds::turn(p);
      std::transform(
        p, p + 3, p, [](double x) { return static_cast<double>(static_cast<float>(x + 8.0)); });
    });
  Vector normal{ 0.0, 0.0, 1.0 };
  clouds::turn(normal.data());
  std::vector<Vector> within;
  for (std::size_t i = 0; i < 500; ++i)
  {
    within.push_back(0.5 * (rough.at(i) + rough.at(i + 1)));
  }
  for (const PlaceMethod method : { PlaceMethod::Blend, PlaceMethod::Cubic, PlaceMethod::Affine })
  {
    const Probed slopes = probe(rough, within, optionsOf(method), { { rough.values } });
    for (std::size_t i = 0; i < within.size(); ++i)
    {
      ASSERT_NE(slopes.kinds[i] & PlaceFlat, 0);
      const double* const g = slopes.gradients[0].data() + 3 * i;
      const Vector gradient{ g[0], g[1], g[2] };
      ASSERT_LE(std::abs(dot(gradient, normal)), 0.05 * lengthOf(gradient) + 1.0);
    }
  }
  // In a thin slab values are those of a plane, with no jump where that is decided.
  Cloud slab = clouds::scaled(clouds::uniform(3000, 15), 1.0, 1.0, 3e-5);
  clouds::Random random(16);
  for (double& value : slab.values)
  {
    value = random();
  }
  auto loaded = clouds::loaded(slab);
  std::vector<Vector> line;
  for (int i = 0; i <= 20000; ++i)
  {
    line.push_back({ 0.1 + 4e-5 * i, 0.2 + 3e-5 * i, 1.5e-5 });
  }
  const Probed along = probe(loaded, line, optionsOf(PlaceMethod::Cubic), { { slab.values } });
  for (std::size_t i = 1; i < line.size(); ++i)
  {
    ASSERT_NEAR(along.values[0][i], along.values[0][i - 1], 0.05);
  }
}

TEST(Places, OutsideIsTheSameForAllMethodsAndLargeValuesStayFinite)
{
  // Two planes that cross.
  const Cloud cross = clouds::moved(clouds::uniform(2000, 17),
    [](double* p) { p[static_cast<int>(1e6 * p[1]) % 2 == 0 ? 2 : 0] = 0.5; });
  const std::vector<Vector> all = randomPlaces(cross, 2000, 0.0, 1.0, 18);
  const ProbeOptions options = optionsOf(PlaceMethod::Blend, OutsideStrategy::Number);
  const Probed first = probe(cross, all, options, { { cross.values } });
  for (const PlaceMethod method : allMethods)
  {
    const Probed other =
      probe(cross, all, optionsOf(method, OutsideStrategy::Number), { { cross.values } });
    EXPECT_EQ(other.kinds, first.kinds);
  }
  Cloud large = clouds::uniform(2000, 19);
  for (std::size_t i = 0; i < large.size(); ++i)
  {
    large.values[i] = large.at(i)[0] > 0.5 ? 1.7e308 : -1.7e308;
  }
  const Probed extreme = probe(large, all, optionsOf(PlaceMethod::Blend), { { large.values } });
  EXPECT_EQ(
    clouds::countOf(extreme.values[0], [](double value) { return !std::isfinite(value); }), 0u);
}

TEST(Places, FewSamplesGiveNothingBeyondTheirRange)
{
  for (const std::size_t count : { 1, 2, 3, 4, 5, 8, 20 })
  {
    const Cloud cloud = clouds::uniform(count, 30 + count); // four that are not nearly in a plane
    const auto [least, greatest] = std::minmax_element(cloud.values.begin(), cloud.values.end());
    std::vector<Vector> all = randomPlaces(cloud, 100, -0.5, 1.5, 4);
    all.push_back(cloud.at(0));
    all.push_back(0.5 * (cloud.at(0) + cloud.at(count - 1)));
    for (const OutsideStrategy outside : { OutsideStrategy::Extrapolate, OutsideStrategy::Nearest })
    {
      const Probed found =
        probe(cloud, all, optionsOf(PlaceMethod::Blend, outside), { { cloud.values } });
      for (const double value : found.values[0])
      {
        ASSERT_GE(value, *least);
        ASSERT_LE(value, *greatest);
      }
    }
    const Probed found = probe(cloud, all, optionsOf(PlaceMethod::Affine), { { cloud.values } });
    if (count <= 4) // as many as coefficients
    {
      EXPECT_NEAR(found.values[0][100], cloud.values[0], 1e-9);
      EXPECT_NEAR(found.values[0][101], 0.5 * (cloud.values[0] + cloud.values[count - 1]), 1e-9);
    }
  }
  const Vector place{ 0.5, 0.5, 0.5 };
  const Probed empty = probe(Cloud(), { place }, optionsOf(PlaceMethod::Blend), { Array() });
  EXPECT_TRUE(std::isnan(empty.values[0][0]) && empty.isOutside(0));
}

TEST(Places, OutsideIsWhereThereAreNoSamples)
{
  const double spacing = 1.0 / std::cbrt(40000.0);
  const auto depth = [](const Vector& p) // in a hollow ball
  {
    const double r = clouds::fromMiddle(p);
    return std::min(0.45 - r, r - 0.2);
  };
  const Cloud cloud =
    clouds::filtered(clouds::uniform(40000, 7), [&](const Vector& p) { return depth(p) > 0.0; });
  const std::vector<Vector> all = randomPlaces(Cloud(), 20000, 0.0, 1.0, 8);
  for (const PlaceMethod method : allMethods)
  {
    const Probed found =
      probe(cloud, all, optionsOf(method, OutsideStrategy::Number), { { cloud.values } });
    double outside[2] = { 0.0, 0.0 };
    double count[2] = { 0.0, 0.0 };
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      if (std::abs(depth(all[i])) > spacing)
      {
        const int isInside = depth(all[i]) > 0.0 ? 1 : 0;
        outside[isInside] += found.isOutside(i) ? 1.0 : 0.0;
        count[isInside] += 1.0;
      }
      ASSERT_EQ(std::isnan(found.values[0][i]), found.isOutside(i));
    }
    EXPECT_GE(outside[0], 0.97 * count[0]);
    EXPECT_LE(outside[1], 0.004 * count[1]);
    const Probed atSamples = probe(cloud, { cloud.at(0), cloud.at(1) },
      optionsOf(method, OutsideStrategy::Number), { { cloud.values } });
    EXPECT_FALSE(atSamples.isOutside(0) || atSamples.isOutside(1));
  }
  const Probed strange = probe(cloud, { { notANumber, 0.0, 0.0 }, { 1e200, 0.0, 0.0 } },
    { PlaceMethod::Blend, OutsideStrategy::Number, 7.0 }, { { cloud.values } });
  EXPECT_EQ(strange.values[0], Numbers({ 7.0, 7.0 }));
}

TEST(Places, AreContinuousAndStayInTheRange)
{
  clouds::Random random(9);
  Cloud cloud = clouds::uniform(20000, 9);
  std::vector<Array> arrays{ { cloud.values }, { cloud.values }, { cloud.values } };
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    arrays[1].numbers[i] += random();                                                // noise
    arrays[2].numbers[i] = cloud.at(i)[0] + 0.3 * cloud.at(i)[1] > 0.62 ? 1.0 : 0.0; // a step
  }
  const double spacing = 1.0 / std::cbrt(20000.0);
  auto extractor = clouds::loaded(cloud);
  for (const Array& array : arrays)
  {
    for (const PlaceMethod method :
      { PlaceMethod::Blend, PlaceMethod::Cubic, PlaceMethod::Quadratic, PlaceMethod::Affine })
    {
      const auto coarse = largestJumps(extractor, array, method, 0.01 * spacing);
      const auto fine = largestJumps(extractor, array, method, 0.001 * spacing);
      EXPECT_LE(fine.first, 0.2 * coarse.first) << int(method);
      EXPECT_LE(fine.second, 0.2 * coarse.second) << int(method);
    }
  }
  // Between layers results are steep, but a sample of the next one never enters with full weight.
  const Cloud inLayers = layers(20000, 10, 11);
  auto ofLayers = clouds::loaded(inLayers);
  EXPECT_LE(
    largestJumps(ofLayers, { inLayers.values }, PlaceMethod::Cubic, 0.001 * spacing).first, 0.05);
  const std::vector<Vector> all = randomPlaces(cloud, 5000, 0.05, 0.95, 4);
  const Probed found = probe(extractor, all, optionsOf(PlaceMethod::Blend), { arrays[2] });
  const auto [least, greatest] =
    std::minmax_element(found.values[0].begin(), found.values[0].end());
  EXPECT_GE(*least, 0.0);
  EXPECT_LE(*greatest, 1.0);
}

TEST(Places, TurnedVectorsGiveTurnedResults)
{
  const Cloud cloud = clouds::uniform(3000, 10);
  const std::vector<Vector> all = randomPlaces(cloud, 200, 0.0, 1.0, 4);
  clouds::Random random(3);
  Array vectors{ {}, 3 };
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const double jump = cloud.at(i)[0] > 0.5 ? 1.0 : 0.0;
    vectors.numbers.insert(vectors.numbers.end(), { jump, cloud.values[i], random() });
  }
  Array turned = vectors;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    clouds::turn(turned.numbers.data() + 3 * i);
  }
  for (const PlaceMethod method : allMethods)
  {
    Probed found = probe(cloud, all, optionsOf(method), { vectors, turned });
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      clouds::turn(found.values[0].data() + 3 * i);
    }
    for (std::size_t i = 0; i < found.values[0].size(); ++i)
    {
      ASSERT_NEAR(found.values[0][i], found.values[1][i], 1e-10);
    }
  }
}
