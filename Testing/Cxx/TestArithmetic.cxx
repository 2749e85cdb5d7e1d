// SPDX-License-Identifier: GPL-3.0-or-later
// Arithmetic that is the same to the last bit for all compilers and libraries.
#include "Clouds.h"

#include "Core/Base/Cosine.h"
#include "Core/Base/Hash.h"
#include "Core/Base/Vector.h"
#include "Core/Fit/Lanes.h"

#include <gtest/gtest.h>

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double pi = 3.14159265358979323846;

} // namespace

// The order of additions decides the last bits.
TEST(Arithmetic, LanesAddUpBeforeTheirSums)
{
  clouds::Random random(1);
  isopoint::Pack<8> numbers;
  std::generate(numbers.begin(), numbers.end(), [&]() { return random() - 0.5; });
  const auto ofLane = [&](int lane)
  { return numbers[lane] * numbers[lane] + numbers[4 + lane] * numbers[4 + lane]; };
  EXPECT_EQ(isopoint::sumOfSquares(numbers), (ofLane(0) + ofLane(1)) + (ofLane(2) + ofLane(3)));
}

// The last part is padded with zeros.
TEST(Arithmetic, HashesOfBytesDependOnTheirNumber)
{
  const std::vector<unsigned char> bytes(70000, 0);
  std::set<std::uint64_t> hashes;
  for (const std::size_t count : { 0, 1, 2, 8, 9, 65535, 65536, 65537, 70000 })
  {
    hashes.insert(isopoint::hashOf({}, bytes.data(), count));
  }
  EXPECT_EQ(hashes.size(), 9u);
}

TEST(Arithmetic, LengthsHaveAnyScale)
{
  using isopoint::lengthOf;
  for (const int exponent : { -1072, -600, 0, 600, 1020 })
  {
    const double unit = std::ldexp(1.0, exponent);
    EXPECT_EQ(lengthOf({ 2.0 * unit, -3.0 * unit, 6.0 * unit }), 7.0 * unit) << exponent;
    EXPECT_EQ(lengthOf({ 0.0, -unit, 0.0 }), unit) << exponent;
  }
  EXPECT_EQ(lengthOf({ 0.0, -0.0, 0.0 }), 0.0);
  EXPECT_TRUE(std::isnan(lengthOf({ 1.0, notANumber, 2.0 })));
  EXPECT_TRUE(std::isnan(lengthOf({ notANumber, 0.0, 0.0 })));
  EXPECT_TRUE(std::isnan(lengthOf({ 0.0, -infinity, 1.0 })));
}

TEST(Arithmetic, CosinesAreRoundedToNearest)
{
  using isopoint::cosineOf;
  EXPECT_EQ(cosineOf(0.0), 1.0);
  EXPECT_EQ(cosineOf(pi), -1.0);
  // By exact rational numbers: within 0.0003 units of the last place of the middle of two doubles.
  for (const auto& [degrees, cosine] :
    { std::pair(10.084, 0.9845521132153076), std::pair(16.352, 0.9595501716964175),
      std::pair(17.235, 0.9550975461310681), std::pair(18.463, 0.9485283638628962) })
  {
    EXPECT_EQ(cosineOf(degrees * pi / 180.0), cosine);
  }
  EXPECT_NEAR(cosineOf(pi / 2.0), 6.123233995736766e-17, 0x1p-99);
  for (int tenths = 0; tenths <= 1800; ++tenths)
  {
    const double angle = tenths * pi / 1800.0;
    EXPECT_NEAR(cosineOf(angle), std::cos(angle), 0x1p-53) << tenths;
  }
}

TEST(Arithmetic, AHashTellsTwoChangesFromNone)
{
  constexpr std::size_t count = 512; // bytes
  const isopoint::Execution execution;
  std::vector<unsigned char> flags(count, 0);
  std::set<std::uint64_t> hashes{ isopoint::hashOf(execution, flags.data(), count) };
  std::size_t expected = 1;
  for (const unsigned char flag : { 1, 2, 32, 128 })
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      for (std::size_t j = i; j < count; j += 8) // pairs at one place of words, the least safe ones
      {
        flags[i] = flag;
        flags[j] = flag;
        hashes.insert(isopoint::hashOf(execution, flags.data(), count));
        ++expected;
        flags[i] = 0;
        flags[j] = 0;
      }
    }
  }
  EXPECT_EQ(hashes.size(), expected);
}
