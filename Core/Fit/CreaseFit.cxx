// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Fit/CreaseFit.h"

#include "Core/Fit/PolynomialFit.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace isopoint
{
namespace
{

Vector placeOf(const FrameSamples& samples, std::size_t i)
{
  return { samples.x[i], samples.y[i], samples.z[i] };
}

/// K-plane clustering: assigns samples to pieces and fits the pieces.
class PlaneClustering
{
public:
  PlaneClustering(const FrameSamples& samples, const FrameWeights& weights, double sense)
    : Samples(&samples)
    , Weights(&weights)
    , Labels(samples.count(), 0)
  {
    this->Fit.sense = sense;
    this->Fit.pieces.resize(1);
  }

  /// Starts with one piece of at most a degree. @returns whether the samples determine it
  bool start(int degree = 1) { return this->settle(degree); }

  /// Splits the piece with the largest residuals; `share` of its samples stay.
  /// @returns whether the samples determine the parts
  bool split(double share)
  {
    const std::size_t worst = this->worstPiece();
    std::vector<std::pair<double, std::size_t>> along = this->alongBend(worst);
    std::sort(along.begin(), along.end());
    const auto kept = static_cast<std::size_t>(share * static_cast<double>(along.size()));
    for (std::size_t i = kept; i < along.size(); ++i)
    {
      this->Labels[along[i].second] = static_cast<std::uint8_t>(this->Fit.pieces.size());
    }
    this->Fit.pieces.emplace_back();
    return this->settle(1);
  }

  /// Raises the degree of pieces to two. @returns whether the samples determine them
  bool bend() { return this->settle(2); }

  const CreaseFit& result() const { return this->Fit; }

private:
  /// Fits pieces of at most a degree and reassigns samples, until no sample changes its piece.
  bool settle(int degree)
  {
    constexpr int maxRounds = 7;
    bool changed = true;
    for (int round = 0; round < maxRounds && changed; ++round)
    {
      if (!this->refit(degree))
      {
        return false;
      }
      changed = false;
      for (std::size_t i = 0; i < this->Labels.size(); ++i)
      {
        const auto piece = static_cast<std::uint8_t>(this->Fit.pieceAt(placeOf(*this->Samples, i)));
        changed = changed || piece != this->Labels[i];
        this->Labels[i] = piece;
      }
    }
    return this->measure();
  }

  /// Fits each piece to its samples. @returns whether they determine all
  bool refit(int degree)
  {
    for (std::size_t piece = 0; piece < this->Fit.pieces.size(); ++piece)
    {
      FrameWeights own;
      copyWeights(*this->Samples, *this->Weights, own);
      std::size_t count = 0;
      for (std::size_t i = 0; i < this->Labels.size(); ++i)
      {
        const bool isOwn = this->Labels[i] == piece;
        count += isOwn ? 1 : 0;
        own[i] *= isOwn ? 1.0 : 0.0;
      }
      std::optional<Polynomial> polynomial;
      for (int tried = degree; tried > 0 && !polynomial; --tried)
      {
        polynomial =
          areEnough(count, tried) ? leastSquares(*this->Samples, own, tried) : std::nullopt;
      }
      if (!polynomial)
      {
        return false;
      }
      this->Fit.pieces[piece] = *polynomial;
    }
    return true;
  }

  /// Sets the residual. @returns whether there are enough samples
  bool measure()
  {
    std::size_t coefficients = 0;
    for (const Polynomial& piece : this->Fit.pieces)
    {
      coefficients += coefficientCount(piece.degree);
    }
    double squares = 0.0;
    double weights = 0.0;
    for (std::size_t i = 0; i < this->Labels.size(); ++i)
    {
      const double residual = this->residualAt(i);
      squares += (*this->Weights)[i] * residual * residual;
      weights += (*this->Weights)[i];
    }
    const auto count = static_cast<double>(this->Labels.size());
    this->Fit.residual =
      count / (count - static_cast<double>(coefficients)) * std::sqrt(squares / weights);
    return this->Labels.size() > coefficients && std::isfinite(this->Fit.residual);
  }

  double residualAt(std::size_t i) const
  {
    return this->Samples->value[i] -
           this->Fit.pieces[this->Labels[i]].valueAt(placeOf(*this->Samples, i));
  }

  std::size_t worstPiece() const
  {
    std::vector<double> sums(this->Fit.pieces.size(), 0.0);
    for (std::size_t i = 0; i < this->Labels.size(); ++i)
    {
      const double residual = this->residualAt(i);
      sums[this->Labels[i]] += (*this->Weights)[i] * residual * residual;
    }
    return static_cast<std::size_t>(std::max_element(sums.begin(), sums.end()) - sums.begin());
  }

  /// A piece's samples by position along the direction in which `sense` times the residual grows
  /// most toward both ends.
  std::vector<std::pair<double, std::size_t>> alongBend(std::size_t piece) const
  {
    const auto forEachOwn = [&](const auto& use)
    {
      for (std::size_t i = 0; i < this->Labels.size(); ++i)
      {
        if (this->Labels[i] == piece)
        {
          const Vector place = placeOf(*this->Samples, i);
          use(i, (*this->Weights)[i], Eigen::Vector3d(place[0], place[1], place[2]));
        }
      }
    };
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    double weights = 0.0;
    forEachOwn(
      [&](std::size_t, double weight, const Eigen::Vector3d& place)
      {
        center += weight * place;
        weights += weight;
      });
    center /= weights;
    Eigen::Matrix3d bend = Eigen::Matrix3d::Zero();
    forEachOwn(
      [&](std::size_t i, double weight, const Eigen::Vector3d& place)
      {
        const Eigen::Vector3d offset = place - center;
        bend += this->Fit.sense * weight * this->residualAt(i) * offset * offset.transpose();
      });
    // Unlike computeDirect(), whose sines and cosines differ among libraries and processors.
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.compute(bend);
    const Eigen::Vector3d direction = solver.eigenvectors().col(2);
    std::vector<std::pair<double, std::size_t>> along;
    forEachOwn([&](std::size_t i, double, const Eigen::Vector3d& place)
      { along.emplace_back(direction.dot(place), i); });
    return along;
  }

  const FrameSamples* Samples;
  const FrameWeights* Weights;
  std::vector<std::uint8_t> Labels; // the piece of each sample
  CreaseFit Fit;
};

/// The tangent planes of the other pieces at the zeros that Newton's method reaches from `place`.
std::vector<CreasePlane> creasesAround(const CreaseFit& fit, std::size_t piece, const Vector& place)
{
  const Vector normal = directionOf(fit.pieces[piece].gradientAt(place));
  std::vector<std::pair<double, CreasePlane>> found; // by the distance of the crease
  for (std::size_t other = 0; other < fit.pieces.size(); ++other)
  {
    const std::optional<Vector> zero =
      other == piece ? std::nullopt
                     : zeroNear(fit.pieces[other], std::numeric_limits<double>::max(), place);
    if (zero)
    {
      const Vector inward = -fit.sense * directionOf(fit.pieces[other].gradientAt(*zero));
      const double distance = std::max(0.0, dot(inward, place - *zero));
      const double alongPiece = distance / lengthOf(cross(inward, normal));
      if (std::isfinite(alongPiece)) // or else the pieces are parallel
      {
        found.push_back({ alongPiece, { inward, distance, fit.sense } });
      }
    }
  }
  // Stable: on lattices several creases are often at one distance, and the order of pieces decides.
  std::stable_sort(
    found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<CreasePlane> creases;
  creases.reserve(found.size());
  for (const auto& [alongPiece, crease] : found)
  {
    creases.push_back(crease);
  }
  return creases;
}

/// The common zero of two pieces that is nearest to the origin, by Newton's method.
std::optional<Vector> commonZeroNear(
  const Polynomial& first, const Polynomial& second, double farthest)
{
  return followToZero({}, farthest,
    [&](const Vector& place)
    {
      const Vector a = first.gradientAt(place);
      const Vector b = second.gradientAt(place);
      const double determinant = dot(a, a) * dot(b, b) - dot(a, b) * dot(a, b);
      const double f = first.valueAt(place);
      const double g = second.valueAt(place);
      return (dot(a, b) * g - dot(b, b) * f) / determinant * a +
             (dot(a, b) * f - dot(a, a) * g) / determinant * b;
    });
}

} // namespace

std::size_t CreaseFit::pieceAt(const Vector& place) const
{
  std::size_t best = 0;
  double bestValue = this->sense * this->pieces[best].valueAt(place);
  for (std::size_t piece = 1; piece < this->pieces.size(); ++piece)
  {
    const double value = this->sense * this->pieces[piece].valueAt(place);
    if (value > bestValue)
    {
      best = piece;
      bestValue = value;
    }
  }
  return best;
}

double CreaseFit::minSlope() const
{
  double least = std::numeric_limits<double>::infinity();
  for (const Polynomial& piece : this->pieces)
  {
    least = std::min(least, lengthOf(piece.gradientAt({})));
  }
  return least;
}

bool CreaseFit::isSharp() const
{
  for (std::size_t piece = 0; piece < this->pieces.size(); ++piece)
  {
    const Vector normal = directionOf(this->pieces[piece].gradientAt({}));
    for (std::size_t other = 0; other < piece; ++other)
    {
      if (dot(normal, directionOf(this->pieces[other].gradientAt({}))) > maxCreaseCosine)
      {
        return false;
      }
    }
  }
  return true;
}

std::optional<CreaseFit> fitCrease(const FrameSamples& samples, const FrameWeights& weights)
{
  constexpr std::size_t maxPieces = 4; // three at the corner of a box, and one more
  std::optional<CreaseFit> best;
  const auto take = [&best](const CreaseFit& fit)
  {
    if (!best || fit.residual < best->residual)
    {
      best = fit;
    }
  };
  // Several starts, since clustering finds local optima.
  for (const auto& [sense, share] : { std::pair(1.0, 0.5), std::pair(-1.0, 0.5),
         std::pair(1.0, 0.3), std::pair(-1.0, 0.3), std::pair(1.0, 0.7), std::pair(-1.0, 0.7) })
  {
    PlaneClustering parts(samples, weights, sense);
    bool isDetermined = parts.start();
    for (std::size_t pieces = 2; isDetermined && pieces <= maxPieces; ++pieces)
    {
      isDetermined = parts.split(pieces == 2 ? share : 0.5);
      if (isDetermined)
      {
        take(parts.result());
        PlaneClustering bent = parts;
        if (bent.bend())
        {
          take(bent.result());
        }
      }
    }
  }
  return best;
}

double polynomialResidual(const FrameSamples& samples, const FrameWeights& weights)
{
  PlaneClustering single(samples, weights, 1.0);
  return single.start(Polynomial::highestDegree) ? single.result().residual
                                                 : std::numeric_limits<double>::infinity();
}

std::optional<CreasePoint> zeroNear(const CreaseFit& fit, double farthest)
{
  std::optional<CreasePoint> nearest;
  const auto consider = [&](std::size_t piece, const std::optional<Vector>& zero)
  {
    const auto isBeyond = [&](std::size_t other)
    { return other != piece && fit.sense * fit.pieces[other].valueAt(*zero) > zeroAccuracy; };
    if (!zero || (nearest && lengthOf(*zero) >= lengthOf(nearest->zero)))
    {
      return;
    }
    for (std::size_t other = 0; other < fit.pieces.size(); ++other)
    {
      if (isBeyond(other))
      {
        return;
      }
    }
    nearest = CreasePoint{ *zero, fit.pieces[piece].gradientAt(*zero),
      fit.pieces[piece].hessianAt(*zero), creasesAround(fit, piece, *zero) };
  };
  for (std::size_t piece = 0; piece < fit.pieces.size(); ++piece)
  {
    consider(piece, zeroNear(fit.pieces[piece], farthest));
  }
  for (std::size_t piece = 0; piece < fit.pieces.size() && !nearest; ++piece)
  {
    for (std::size_t other = 0; other < piece; ++other)
    {
      consider(piece, commonZeroNear(fit.pieces[piece], fit.pieces[other], farthest));
    }
  }
  return nearest;
}

} // namespace isopoint
