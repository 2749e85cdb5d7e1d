// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Fit/CreaseFit.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace isopoint
{
namespace
{

/// Fits pieces to samples that are known to belong to them.
class Alternation
{
public:
  explicit Alternation(const std::vector<FrameSample>& samples)
    : Samples(&samples)
    , Labels(samples.size(), 0)
  {
    this->Fit.sampleCount = samples.size();
  }

  /// Starts with a single piece. @returns whether the samples determine it
  bool start()
  {
    this->Fit.pieces.resize(1);
    return this->refit(1);
  }

  /// The same, whose pieces are to be the largest (1) or the smallest (-1) of functions.
  Alternation withSense(double sense) const
  {
    Alternation other = *this;
    other.Fit.sense = sense;
    return other;
  }

  /// Parts the piece of the largest residuals in two, `share` of its samples staying.
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

  /// Lets pieces bend. @returns whether one does
  bool bend()
  {
    return this->settle(2) && std::any_of(this->Fit.pieces.begin(), this->Fit.pieces.end(),
                                [](const Polynomial& piece) { return piece.degree > 1; });
  }

  const CreaseFit& result() const { return this->Fit; }

private:
  /// Fits pieces of at most a degree, and alternates until no sample changes its piece.
  bool settle(int degree)
  {
    constexpr int mostRounds = 6;
    bool changed = true;
    for (int round = 0; round <= mostRounds && changed; ++round)
    {
      if (!this->refit(degree))
      {
        return false;
      }
      changed = false;
      for (std::size_t i = 0; i < this->Samples->size(); ++i)
      {
        const std::uint8_t piece = this->pieceAt((*this->Samples)[i].position);
        changed = changed || piece != this->Labels[i];
        this->Labels[i] = piece;
      }
    }
    this->Fit.meanSquare = meanSquaredResidual(
      *this->Samples, [this](const Eigen::Vector3d& p) { return this->Fit.value(p); });
    return true;
  }

  std::uint8_t pieceCount() const { return static_cast<std::uint8_t>(this->Fit.pieces.size()); }

  std::uint8_t pieceAt(const Eigen::Vector3d& p) const
  {
    std::uint8_t best = 0;
    double bestValue = this->Fit.sense * this->Fit.pieces[best].value(p);
    for (std::uint8_t piece = 1; piece < this->pieceCount(); ++piece)
    {
      const double value = this->Fit.sense * this->Fit.pieces[piece].value(p);
      if (value > bestValue)
      {
        best = piece;
        bestValue = value;
      }
    }
    return best;
  }

  /// Fits each piece to its samples. @returns whether they determine all
  bool refit(int degree)
  {
    for (std::uint8_t piece = 0; piece < this->pieceCount(); ++piece)
    {
      std::optional<Polynomial> polynomial;
      for (int tried = degree; tried > 0 && !polynomial; --tried)
      {
        polynomial = fitPolynomial(*this->Samples, this->Labels, piece, tried);
      }
      if (!polynomial)
      {
        return false;
      }
      this->Fit.pieces[piece] = *polynomial;
    }
    return true;
  }

  double residual(std::size_t sample) const
  {
    return (*this->Samples)[sample].value -
           this->Fit.pieces[this->Labels[sample]].value((*this->Samples)[sample].position);
  }

  std::size_t worstPiece() const
  {
    std::vector<double> sums(this->Fit.pieces.size(), 0.0);
    for (std::size_t i = 0; i < this->Samples->size(); ++i)
    {
      sums[this->Labels[i]] += (*this->Samples)[i].weight * this->residual(i) * this->residual(i);
    }
    return static_cast<std::size_t>(std::max_element(sums.begin(), sums.end()) - sums.begin());
  }

  /// The samples of a piece, by their place in the direction in which residuals increase on both
  /// sides (decrease, for the smallest of functions).
  std::vector<std::pair<double, std::size_t>> alongBend(std::size_t piece) const
  {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    double weights = 0.0;
    for (std::size_t i = 0; i < this->Samples->size(); ++i)
    {
      if (this->Labels[i] == piece)
      {
        center += (*this->Samples)[i].weight * (*this->Samples)[i].position;
        weights += (*this->Samples)[i].weight;
      }
    }
    center /= weights;
    Eigen::Matrix3d bend = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < this->Samples->size(); ++i)
    {
      if (this->Labels[i] == piece)
      {
        const Eigen::Vector3d offset = (*this->Samples)[i].position - center;
        bend += this->Fit.sense * (*this->Samples)[i].weight * this->residual(i) * offset *
                offset.transpose();
      }
    }
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(bend);
    const Eigen::Vector3d direction = solver.eigenvectors().col(2);
    std::vector<std::pair<double, std::size_t>> along;
    for (std::size_t i = 0; i < this->Samples->size(); ++i)
    {
      if (this->Labels[i] == piece)
      {
        along.emplace_back(direction.dot((*this->Samples)[i].position), i);
      }
    }
    return along;
  }

  const std::vector<FrameSample>* Samples;
  std::vector<std::uint8_t> Labels; // the piece of each sample
  CreaseFit Fit;
};

bool isBetter(const Alternation& a, const Alternation& b)
{
  return a.result().meanSquare < b.result().meanSquare;
}

/// Fits of two affine pieces, from several starts; none where there is no crease to be found.
std::vector<Alternation> startAlternations(
  const std::vector<FrameSample>& samples, const CreaseSearch& search)
{
  Alternation single(samples);
  if (!single.start())
  {
    return {};
  }
  std::vector<Alternation> starts;
  const auto start = [&](double sense, double share)
  {
    Alternation parts = single.withSense(sense);
    if (parts.split(share))
    {
      starts.push_back(std::move(parts));
    }
  };
  start(1.0, 0.5);
  start(-1.0, 0.5);
  if (starts.empty())
  {
    return {};
  }
  starts = { *std::min_element(starts.begin(), starts.end(), isBetter) };
  const CreaseFit& two = starts.front().result();
  if (two.relativeResidual() > search.mostRelativeResidualOfTwo ||
      two.meanSquare > search.mostMeanSquareOfTwo)
  {
    return {};
  }
  const double sense = two.sense;
  start(sense, 0.3);
  start(sense, 0.7);
  return starts;
}

} // namespace

double CreaseFit::value(const Eigen::Vector3d& p) const
{
  double best = this->sense * this->pieces[0].value(p);
  for (std::size_t piece = 1; piece < this->pieces.size(); ++piece)
  {
    best = std::max(best, this->sense * this->pieces[piece].value(p));
  }
  return this->sense * best;
}

std::size_t CreaseFit::coefficients() const
{
  return std::accumulate(this->pieces.begin(), this->pieces.end(), std::size_t{ 0 },
    [](std::size_t sum, const Polynomial& piece) { return sum + coefficientCount(piece.degree); });
}

double CreaseFit::relativeResidual() const
{
  double gentlest = std::numeric_limits<double>::infinity();
  for (const Polynomial& piece : this->pieces)
  {
    gentlest = std::min(gentlest, piece.gradient(Eigen::Vector3d::Zero()).norm());
  }
  return std::sqrt(residualFreedom(this->sampleCount, this->coefficients()) * this->meanSquare) /
         gentlest;
}

bool CreaseFit::isOnSurface(std::size_t piece, const Eigen::Vector3d& p, double tolerance) const
{
  for (std::size_t other = 0; other < this->pieces.size(); ++other)
  {
    if (other != piece && this->sense * this->pieces[other].value(p) > tolerance)
    {
      return false;
    }
  }
  return true;
}

std::vector<CreaseFit> fitCreases(
  const std::vector<FrameSample>& samples, const CreaseSearch& search)
{
  std::vector<CreaseFit> results;
  const auto take = [&](const CreaseFit& fit)
  {
    if (fit.relativeResidual() <= search.mostRelativeResidual)
    {
      results.push_back(fit);
    }
  };
  std::vector<Alternation> starts = startAlternations(samples, search);
  constexpr std::size_t mostPieces = 4;
  constexpr double exact = 1e-6;
  while (!starts.empty())
  {
    Alternation best = *std::min_element(starts.begin(), starts.end(), isBetter);
    take(best.result());
    if (best.result().pieces.size() == mostPieces || best.result().relativeResidual() < exact)
    {
      break;
    }
    if (search.mayBeCurved && best.bend())
    {
      take(best.result());
    }
    std::vector<Alternation> split;
    for (Alternation& start : starts)
    {
      if (start.split(0.5))
      {
        split.push_back(std::move(start));
      }
    }
    starts = std::move(split);
  }
  return results;
}

} // namespace isopoint
