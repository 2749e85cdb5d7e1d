// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Fit/FrameSamples.h"
#include "Core/Fit/Polynomial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace isopoint
{

/// The least pivot, over its diagonal element, of a coefficient that the samples determine: about
/// half of the digits of a double remain.
constexpr double minPivot = 1e-7;

/// The monomial of a coefficient: that of a former one times a coordinate. In the order of
/// Polynomial; the first, 1, is an exception.
struct CoordinateProduct
{
  std::size_t former;
  std::size_t axis;
};
constexpr std::array<CoordinateProduct, 20> coordinateProducts{ { {}, { 0, 0 }, { 0, 1 }, { 0, 2 },
  { 1, 0 }, { 2, 1 }, { 3, 2 }, { 1, 1 }, { 1, 2 }, { 2, 2 }, { 4, 0 }, { 5, 1 }, { 6, 2 },
  { 4, 1 }, { 4, 2 }, { 5, 0 }, { 5, 2 }, { 6, 0 }, { 6, 1 }, { 7, 2 } } };

/// The powers of x, y, z in a coefficient's monomial.
constexpr std::array<std::size_t, 3> exponentsOf(std::size_t coefficient)
{
  std::array<std::size_t, 3> exponents{};
  for (; coefficient > 0; coefficient = coordinateProducts[coefficient].former)
  {
    ++exponents[coordinateProducts[coefficient].axis];
  }
  return exponents;
}

/// The sums of x^a y^b z^c over weighted samples for a + b + c <= Order: coefficientCount(Order)
/// sums instead of one for each pair of coefficients.
template <int Order>
class Moments
{
public:
  Moments(const FrameSamples& samples, const FrameWeights& weights)
  {
    Products products;
    this->addPlane<0>(samples, weights, products);
  }

  double at(std::size_t a, std::size_t b, std::size_t c) const { return this->Sums[a][b][c]; }

  /// The sum of the product of two coefficients' monomials.
  template <std::size_t First, std::size_t Second>
  double product() const
  {
    constexpr auto first = exponentsOf(First);
    constexpr auto second = exponentsOf(Second);
    return this->Sums[first[0] + second[0]][first[1] + second[1]][first[2] + second[2]];
  }

private:
  static constexpr std::size_t size = Order + 1;

  struct Products
  {
    SampleNumbers ofPlane; // weight x^a
    SampleNumbers ofRow;   // weight x^a y^b
  };

  // Each pass over the samples takes as many sums as fit in registers.

  /// All sums with x^a, then those with higher powers of x.
  /// @param powers weight x^a
  template <int A>
  void addPlane(const FrameSamples& samples, const SampleNumbers& powers, Products& products)
  {
    if constexpr (A + 1 < Order)
    {
      this->addRows<A, 0>(samples, powers, products);
      this->addPlane<A + 1>(samples, products.ofPlane, products);
    }
    else
    {
      this->addLastPlanes<A>(samples, powers);
    }
  }

  /// All sums with x^a y^b, then those with higher powers of y. Rows with b = 0 replace weight x^a
  /// in products.ofPlane by weight x^(a + 1), each group after it is read.
  /// @param powers weight x^a y^b
  template <int A, int B>
  void addRows(const FrameSamples& samples, const SampleNumbers& powers, Products& products)
  {
    if constexpr (A + B + 2 < Order)
    {
      this->addRow<A, B>(samples, powers, products);
      this->addRows<A, B + 1>(samples, products.ofRow, products);
    }
    else
    {
      this->addLastRows<A, B>(samples, powers, products);
    }
  }

  template <int A, int B>
  void addRow(const FrameSamples& samples, const SampleNumbers& powers, Products& products)
  {
    constexpr std::size_t count = Order - A - B + 1;
    std::array<Lanes, count> sums;
    sums.fill(Lanes::Zero());
    const std::size_t groups = samples.groupCount();
    for (std::size_t i = 0; i < groups; ++i)
    {
      const Lanes product = powers.group(i);
      products.ofRow.setGroup(i, product * samples.y.group(i));
      if constexpr (B == 0)
      {
        products.ofPlane.setGroup(i, product * samples.x.group(i));
      }
      sums[0] += product;
      addPowers(product, samples.z.group(i), sums, std::make_index_sequence<count - 1>());
    }
    for (std::size_t c = 0; c < count; ++c)
    {
      this->Sums[A][B][c] = sumOf(sums[c]);
    }
  }

  /// Adds product z, product z^2 and so on to all sums but the first. Unrolled for registers.
  template <std::size_t Count, std::size_t... Indices>
  static void addPowers(
    Lanes product, const Lanes& z, std::array<Lanes, Count>& sums, std::index_sequence<Indices...>)
  {
    ((product *= z, sums[Indices + 1] += product), ...);
  }

  /// The sums of the last three rows of a plane, a + b = Order - 2.
  template <int A, int B>
  void addLastRows(const FrameSamples& samples, const SampleNumbers& powers, Products& products)
  {
    Lanes one = Lanes::Zero();
    Lanes ofZ = Lanes::Zero();
    Lanes ofZZ = Lanes::Zero();
    Lanes ofY = Lanes::Zero();
    Lanes ofYZ = Lanes::Zero();
    Lanes ofYY = Lanes::Zero();
    const std::size_t groups = samples.groupCount();
    for (std::size_t i = 0; i < groups; ++i)
    {
      const Lanes power = powers.group(i);
      if constexpr (B == 0)
      {
        products.ofPlane.setGroup(i, power * samples.x.group(i));
      }
      const Lanes withY = power * samples.y.group(i);
      const Lanes withZ = power * samples.z.group(i);
      one += power;
      ofZ += withZ;
      ofZZ += withZ * samples.z.group(i);
      ofY += withY;
      ofYZ += withY * samples.z.group(i);
      ofYY += withY * samples.y.group(i);
    }
    this->Sums[A][B][0] = sumOf(one);
    this->Sums[A][B][1] = sumOf(ofZ);
    this->Sums[A][B][2] = sumOf(ofZZ);
    this->Sums[A][B + 1][0] = sumOf(ofY);
    this->Sums[A][B + 1][1] = sumOf(ofYZ);
    this->Sums[A][B + 2][0] = sumOf(ofYY);
  }

  /// The sums of the last two planes, a = Order - 1.
  template <int A>
  void addLastPlanes(const FrameSamples& samples, const SampleNumbers& powers)
  {
    Lanes one = Lanes::Zero();
    Lanes ofZ = Lanes::Zero();
    Lanes ofY = Lanes::Zero();
    Lanes ofX = Lanes::Zero();
    const std::size_t groups = samples.groupCount();
    for (std::size_t i = 0; i < groups; ++i)
    {
      const Lanes power = powers.group(i);
      one += power;
      ofZ += power * samples.z.group(i);
      ofY += power * samples.y.group(i);
      ofX += power * samples.x.group(i);
    }
    this->Sums[A][0][0] = sumOf(one);
    this->Sums[A][0][1] = sumOf(ofZ);
    this->Sums[A][1][0] = sumOf(ofY);
    this->Sums[A + 1][0][0] = sumOf(ofX);
  }

  double Sums[size][size][size];
};

/// Fades out coefficients that the samples barely determine. Weak pivots are enlarged (a ridge), so
/// the coefficients go to 0 continuously.
struct Fading
{
  double determined; // from this share of its diagonal element on, a pivot counts in full
  Vector extents{};  // how far monomials of each coordinate count, 0 to 1

  double of(std::size_t coefficient, double pivotShare) const
  {
    double factor = std::min(1.0, (pivotShare - minPivot) / (this->determined - minPivot));
    for (; coefficient > 0; coefficient = coordinateProducts[coefficient].former)
    {
      factor = std::min(factor, this->extents[coordinateProducts[coefficient].axis]);
    }
    return factor;
  }
};

/// The Cholesky factor L of the normal equations of weighted least-squares polynomials, which
/// depends on positions and weights alone. Its leading blocks are those of lower degrees. A
/// coefficient that the samples do not determine is left out, as if it were 0.
template <int Degree>
class CholeskyFactor
{
public:
  static constexpr std::size_t size = coefficientCount(Degree);

  /// O(samples)
  CholeskyFactor(const FrameSamples& samples, const FrameWeights& weights)
    : CholeskyFactor(Moments<2 * Degree>(samples, weights), nullptr)
  {
  }

  /// @param fading null: all coefficients that are not left out count in full
  CholeskyFactor(const Moments<2 * Degree>& moments, const Fading* fading)
  {
    this->factor(moments, fading, std::make_index_sequence<size>());
  }

  /// The highest degree whose coefficients the samples determine; 0 if none.
  int determinedDegree() const { return this->Determined; }

  /// Replaces p by L^-1 p. p has the monomials at a place (or several, side by side), or is the
  /// unit vector of a coefficient. For two such vectors, u . v is the effect of a value of weight 1
  /// at the place of v on the polynomial at the place of u, or on the coefficient.
  template <class Vectors>
  void reduce(int degree, Vectors& p) const
  {
    const std::size_t count = coefficientCount(degree);
    for (std::size_t i = 0; i < count; ++i)
    {
      auto rest = p[i];
      for (std::size_t j = 0; j < i; ++j)
      {
        rest -= this->below(j, i) * p[j];
      }
      p[i] = rest * this->Reciprocals[i];
    }
  }

  /// Replaces p by L^-T p; after reduce(), by A^-1 p.
  template <class Vectors>
  void substituteBack(int degree, Vectors& p) const
  {
    const std::size_t count = coefficientCount(degree);
    for (std::size_t i = count; i-- > 0;)
    {
      for (std::size_t j = i + 1; j < count; ++j)
      {
        p[i] -= this->below(i, j) * p[j];
      }
      p[i] *= this->Reciprocals[i];
    }
  }

  /// The monomials at several places side by side.
  template <class Numbers>
  static std::array<Numbers, size> products(const Numbers& x, const Numbers& y, const Numbers& z)
  {
    const std::array<const Numbers*, 3> coordinates{ &x, &y, &z };
    std::array<Numbers, size> result;
    result[0].setOnes();
    for (std::size_t i = 1; i < size; ++i)
    {
      const auto& [former, axis] = coordinateProducts[i];
      result[i] = result[former] * *coordinates[axis];
    }
    return result;
  }

private:
  using Column = std::array<double, size>; // of even size

  double below(std::size_t column, std::size_t row) const { return this->Columns[column][row]; }

  /// The columns of L, with zeros on and above the diagonal.
  template <std::size_t... Indices>
  void factor(
    const Moments<2 * Degree>& moments, const Fading* fading, std::index_sequence<Indices...>)
  {
    (this->factorColumn<Indices>(moments, fading, std::make_index_sequence<size>()), ...);
    std::size_t determined = 0;
    while (determined<size&& this->Reciprocals[determined]> 0.0)
    {
      ++determined;
    }
    for (int degree = 1; degree <= Degree; ++degree)
    {
      this->Determined = determined >= coefficientCount(degree) ? degree : this->Determined;
    }
  }

  template <std::size_t Index, std::size_t... Rows>
  void factorColumn(
    const Moments<2 * Degree>& moments, const Fading* fading, std::index_sequence<Rows...>)
  {
    constexpr std::size_t first = Index / 2 * 2; // whole pairs
    alignas(16) Column rest;
    ((rest[Rows] = Rows < first ? 0.0 : moments.template product<Index, Rows>()), ...);
    const double diagonal = rest[Index];
    for (std::size_t former = 0; former < Index; ++former)
    {
      const double factor = this->below(former, Index);
      for (std::size_t row = first; row < rest.size(); ++row)
      {
        rest[row] -= factor * this->Columns[former][row];
      }
    }
    const double pivot = rest[Index];
    if (!(pivot > minPivot * diagonal) || !std::isfinite(pivot))
    {
      this->Reciprocals[Index] = 0.0;
      this->Columns[Index].fill(0.0);
      return;
    }
    this->Reciprocals[Index] = 1.0 / std::sqrt(pivot);
    if (fading)
    {
      this->Reciprocals[Index] *= std::sqrt(fading->of(Index, pivot / diagonal));
    }
    for (std::size_t row = first; row < rest.size(); ++row)
    {
      this->Columns[Index][row] = rest[row] * this->Reciprocals[Index];
    }
    for (std::size_t row = first; row <= Index; ++row)
    {
      this->Columns[Index][row] = 0.0;
    }
  }

  alignas(16) std::array<Column, size> Columns; // of L, below the diagonal
  std::array<double, size> Reciprocals;         // of the diagonal of L; 0 if left out
  int Determined = 0;
};

/// The normal equations of the weighted least-squares polynomial of a degree.
template <int Degree>
class NormalEquations : public CholeskyFactor<Degree>
{
public:
  using CholeskyFactor<Degree>::size;

  /// O(samples)
  NormalEquations(const FrameSamples& samples, const FrameWeights& weights)
    : CholeskyFactor<Degree>(samples, weights)
  {
    SampleNumbers weightedValues;
    const std::size_t groups = samples.groupCount();
    for (std::size_t i = 0; i < groups; ++i)
    {
      weightedValues.setGroup(i, weights.group(i) * samples.value.group(i));
    }
    const Moments<Degree> ofValues(samples, weightedValues);
    for (std::size_t i = 0; i < size; ++i)
    {
      const auto [a, b, c] = exponentsOf(i);
      this->RightSide[i] = ofValues.at(a, b, c);
    }
  }

  /// The least-squares polynomial. @param degree up to determinedDegree()
  Polynomial solution(int degree) const
  {
    Polynomial polynomial;
    polynomial.degree = degree;
    std::copy_n(this->RightSide.begin(), coefficientCount(degree), polynomial.coefficients.begin());
    this->reduce(degree, polynomial.coefficients);
    this->substituteBack(degree, polynomial.coefficients);
    return polynomial;
  }

private:
  std::array<double, size> RightSide;
};

} // namespace isopoint
