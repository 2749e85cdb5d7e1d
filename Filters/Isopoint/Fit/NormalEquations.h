// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_NormalEquations_h
#define isopoint_NormalEquations_h

#include "Isopoint/Fit/FrameSamples.h"
#include "Isopoint/Fit/Polynomial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace isopoint
{

/// A smaller share of a diagonal element left as the pivot means that the samples do not determine
/// the coefficient: about half of the digits of a double remain.
constexpr double leastPivot = 1e-7;

/// The product of coordinates that a coefficient belongs to: that of an earlier one, times a
/// coordinate. In the order of Polynomial, the first one, 1, apart.
struct CoordinateProduct
{
  std::size_t former;
  std::size_t axis;
};
constexpr std::array<CoordinateProduct, 20> coordinateProducts{ { {}, { 0, 0 }, { 0, 1 }, { 0, 2 },
  { 1, 0 }, { 2, 1 }, { 3, 2 }, { 1, 1 }, { 1, 2 }, { 2, 2 }, { 4, 0 }, { 5, 1 }, { 6, 2 },
  { 4, 1 }, { 4, 2 }, { 5, 0 }, { 5, 2 }, { 6, 0 }, { 6, 1 }, { 7, 2 } } };

/// The powers of x, y, z in a coefficient's product.
constexpr std::array<std::size_t, 3> exponentsOf(std::size_t coefficient)
{
  std::array<std::size_t, 3> exponents{};
  for (; coefficient > 0; coefficient = coordinateProducts[coefficient].former)
  {
    ++exponents[coordinateProducts[coefficient].axis];
  }
  return exponents;
}

/// The sums of x^a y^b z^c over weighted samples, for all a + b + c up to an order:
/// coefficientCount (order) of them instead of one for each pair of coefficients.
template <int Order>
class Moments
{
public:
  /// @param weights by which the products are multiplied
  Moments(const FrameSamples& samples, const FrameWeights& weights)
  {
    Products products;
    this->addPlane<0>(samples, weights, products);
  }

  double at(std::size_t a, std::size_t b, std::size_t c) const { return this->Sums[a][b][c]; }

  /// The sum of the products that two coefficients belong to.
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
    FrameSamples::Numbers ofPlane; // weight x^a
    FrameSamples::Numbers ofRow;   // weight x^a y^b
  };

  /// All sums with x^a, and then those with higher powers of x.
  /// @param powers weight x^a
  template <int A>
  void addPlane(
    const FrameSamples& samples, const FrameSamples::Numbers& powers, Products& products)
  {
    this->addRow<A, 0>(samples, powers, products);
    if constexpr (A < Order)
    {
      for (std::size_t i = 0; i < samples.groupCount(); ++i)
      {
        products.ofPlane[i] = powers[i] * samples.x[i];
      }
      this->addPlane<A + 1>(samples, products.ofPlane, products);
    }
  }

  /// All sums with x^a y^b, and then those with higher powers of y.
  /// @param powers weight x^a y^b
  template <int A, int B>
  void addRow(const FrameSamples& samples, const FrameSamples::Numbers& powers, Products& products)
  {
    constexpr std::size_t count = Order - A - B + 1;
    std::array<Lanes, count> sums;
    sums.fill(Lanes::Zero());
    for (std::size_t i = 0; i < samples.groupCount(); ++i)
    {
      Lanes product = powers[i];
      if constexpr (A + B < Order)
      {
        products.ofRow[i] = product * samples.y[i];
      }
      sums[0] += product;
#pragma GCC unroll 8
      for (std::size_t c = 1; c < count; ++c)
      {
        product *= samples.z[i];
        sums[c] += product;
      }
    }
    for (std::size_t c = 0; c < count; ++c)
    {
      this->Sums[A][B][c] = sumOf(sums[c]);
    }
    if constexpr (A + B < Order)
    {
      this->addRow<A, B + 1>(samples, products.ofRow, products);
    }
  }

  double Sums[size][size][size];
};

/// The normal equations of the weighted least-squares polynomial of a degree through samples, and
/// their Cholesky factors L, whose leading blocks are those of lower degrees.
template <int Degree>
class NormalEquations
{
public:
  static constexpr std::size_t size = coefficientCount(Degree);

  /// Complexity: O(samples)
  NormalEquations(const FrameSamples& samples, const FrameWeights& weights)
  {
    const Moments<2 * Degree> moments(samples, weights);
    FrameSamples::Numbers weightedValues;
    for (std::size_t i = 0; i < samples.groupCount(); ++i)
    {
      weightedValues[i] = weights[i] * samples.value[i];
    }
    const Moments<Degree> ofValues(samples, weightedValues);
    this->factor(moments, std::make_index_sequence<size>());
    for (std::size_t i = 0; i < size; ++i)
    {
      const auto [a, b, c] = exponentsOf(i);
      this->RightSide[i] = ofValues.at(a, b, c);
    }
  }

  /// The highest degree whose coefficients the samples determine; 0 if none.
  int determinedDegree() const { return this->Determined; }

  /// The polynomial of a degree up to determinedDegree() of least squares.
  Polynomial solution(int degree) const
  {
    const std::size_t count = coefficientCount(degree);
    Polynomial polynomial;
    polynomial.degree = degree;
    auto& x = polynomial.coefficients;
    std::copy_n(this->RightSide.begin(), count, x.begin());
    this->reduce(degree, x);
    for (std::size_t i = count; i-- > 0;)
    {
      for (std::size_t j = i + 1; j < count; ++j)
      {
        x[i] -= this->below(i, j) * x[j];
      }
      x[i] *= this->Reciprocals[i];
    }
    return polynomial;
  }

  /// Replaces p by L^-1 p, p being the products of coordinates at a place (or at several side by
  /// side) that coefficients belong to, or the unit vector of a coefficient. With two such vectors
  /// u and v, u . v is the effect of a value of weight 1 at the place of v on the polynomial at
  /// that of u, or on the coefficient.
  template <class Vectors>
  void reduce(int degree, Vectors& p) const
  {
    const std::size_t count = coefficientCount(degree);
    for (std::size_t i = 0; i < count; ++i)
    {
      p[i] *= this->Reciprocals[i];
      for (std::size_t j = i + 1; j < count; ++j)
      {
        p[j] -= this->below(i, j) * p[i];
      }
    }
  }

  /// The products of coordinates that coefficients belong to.
  template <class Number>
  static std::array<Number, size> products(const Number& x, const Number& y, const Number& z)
  {
    const std::array<const Number*, 3> coordinates{ &x, &y, &z };
    std::array<Number, size> result;
    result[0] = Number::Ones();
    for (std::size_t i = 1; i < size; ++i)
    {
      const auto& [former, axis] = coordinateProducts[i];
      result[i] = result[former] * *coordinates[axis];
    }
    return result;
  }

private:
  static constexpr std::size_t groups = (size + laneCount - 1) / laneCount;
  using Column = std::array<Lanes, groups>;

  double below(std::size_t column, std::size_t row) const
  {
    return this->Columns[column][row / laneCount][static_cast<Eigen::Index>(row % laneCount)];
  }

  /// One column of L after the other, with zeros on and above the diagonal.
  template <std::size_t... Indices>
  void factor(const Moments<2 * Degree>& moments, std::index_sequence<Indices...>)
  {
    this->Determined = 0;
    // Stops at the first column that is not determined.
    static_cast<void>(
      (this->factorColumn<Indices>(moments, std::make_index_sequence<size>()) && ...));
  }

  /// @returns whether the samples determine the coefficient
  template <std::size_t Index, std::size_t... Rows>
  bool factorColumn(const Moments<2 * Degree>& moments, std::index_sequence<Rows...>)
  {
    constexpr std::size_t first = Index / laneCount; // groups before that are not needed
    constexpr auto lane = static_cast<Eigen::Index>(Index % laneCount);
    Column rest;
    rest[groups - 1] = Lanes::Zero();
    ((rest[Rows / laneCount][static_cast<Eigen::Index>(Rows % laneCount)] =
         Rows / laneCount < first ? 0.0 : moments.template product<Index, Rows>()),
      ...);
    const double diagonal = rest[first][lane];
    for (std::size_t former = 0; former < Index; ++former)
    {
      const double factor = this->below(former, Index);
      for (std::size_t group = first; group < groups; ++group)
      {
        rest[group] -= factor * this->Columns[former][group];
      }
    }
    const double pivot = rest[first][lane];
    if (!(pivot > leastPivot * diagonal) || !std::isfinite(pivot))
    {
      return false;
    }
    this->Reciprocals[Index] = 1.0 / std::sqrt(pivot);
    for (std::size_t group = first; group < groups; ++group)
    {
      this->Columns[Index][group] = rest[group] * this->Reciprocals[Index];
    }
    for (Eigen::Index row = 0; row <= lane; ++row)
    {
      this->Columns[Index][first][row] = 0.0;
    }
    for (int degree = 1; degree <= Degree; ++degree)
    {
      this->Determined = Index + 1 == coefficientCount(degree) ? degree : this->Determined;
    }
    return true;
  }

  std::array<Column, size> Columns;     // of L, below the diagonal
  std::array<double, size> Reciprocals; // of the diagonal of L
  std::array<double, size> RightSide;
  int Determined = 0;
};

} // namespace isopoint

#endif
