// SPDX-License-Identifier: GPL-3.0-or-later
#include "CreaseFit.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace isopoint
{
namespace
{

/// One more than a piece has coefficients.
constexpr std::size_t leastSamples = 5;

/// As in polynomial fits; pieces of few samples are worse off.
constexpr double leastCondition = 1e-9;

/// Fits pieces to samples that are known to belong to them.
class Alternation
{
public:
  Alternation(const std::vector<FrameSample>& samples, double sense)
    : Samples(samples)
    , Labels(samples.size(), 0)
  {
    this->Fit.sense = sense;
  }

  /// Starts with a single piece. @returns whether the samples determine it
  bool start()
  {
    this->Fit.pieces.resize(1);
    return this->refit();
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
      this->Labels[along[i].second] = this->Fit.pieces.size();
    }
    this->Fit.pieces.emplace_back();
    return this->refit() && this->settle();
  }

  const CreaseFit& result() const { return this->Fit; }

private:
  /// Alternates until no sample changes its piece.
  bool settle()
  {
    constexpr int mostRounds = 6;
    for (int round = 0; round < mostRounds; ++round)
    {
      bool changed = false;
      for (std::size_t i = 0; i < this->Samples.size(); ++i)
      {
        const std::size_t piece = this->pieceAt(this->Samples[i].position);
        changed = changed || piece != this->Labels[i];
        this->Labels[i] = piece;
      }
      if (!changed)
      {
        break;
      }
      if (!this->refit())
      {
        return false;
      }
    }
    this->Fit.meanSquare = meanSquaredResidual(
      this->Samples, [this](const Eigen::Vector3d& p) { return this->Fit.value(p); });
    return true;
  }

  std::size_t pieceAt(const Eigen::Vector3d& p) const
  {
    std::size_t best = 0;
    for (std::size_t piece = 1; piece < this->Fit.pieces.size(); ++piece)
    {
      if (this->Fit.sense * this->Fit.pieceValue(piece, p) >
          this->Fit.sense * this->Fit.pieceValue(best, p))
      {
        best = piece;
      }
    }
    return best;
  }

  bool refit()
  {
    for (std::size_t piece = 0; piece < this->Fit.pieces.size(); ++piece)
    {
      Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
      Eigen::Vector4d rightSide = Eigen::Vector4d::Zero();
      std::size_t count = 0;
      for (std::size_t i = 0; i < this->Samples.size(); ++i)
      {
        if (this->Labels[i] == piece)
        {
          Eigen::Vector4d basis;
          basis << 1.0, this->Samples[i].position;
          matrix += this->Samples[i].weight * basis * basis.transpose();
          rightSide += this->Samples[i].weight * this->Samples[i].value * basis;
          ++count;
        }
      }
      const Eigen::LDLT<Eigen::Matrix4d> factors(matrix);
      if (count < leastSamples || !(factors.vectorD().minCoeff() > 0.0) ||
          !(factors.rcond() > leastCondition))
      {
        return false;
      }
      this->Fit.pieces[piece] = factors.solve(rightSide);
    }
    return true;
  }

  double residual(std::size_t sample) const
  {
    return this->Samples[sample].value -
           this->Fit.pieceValue(this->Labels[sample], this->Samples[sample].position);
  }

  std::size_t worstPiece() const
  {
    std::vector<double> sums(this->Fit.pieces.size(), 0.0);
    for (std::size_t i = 0; i < this->Samples.size(); ++i)
    {
      sums[this->Labels[i]] += this->Samples[i].weight * this->residual(i) * this->residual(i);
    }
    return static_cast<std::size_t>(std::max_element(sums.begin(), sums.end()) - sums.begin());
  }

  /// The samples of a piece, by their place in the direction in which residuals rise on both sides
  /// (fall, for the smallest of functions).
  std::vector<std::pair<double, std::size_t>> alongBend(std::size_t piece) const
  {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    double weights = 0.0;
    for (std::size_t i = 0; i < this->Samples.size(); ++i)
    {
      if (this->Labels[i] == piece)
      {
        center += this->Samples[i].weight * this->Samples[i].position;
        weights += this->Samples[i].weight;
      }
    }
    center /= weights;
    Eigen::Matrix3d bend = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < this->Samples.size(); ++i)
    {
      if (this->Labels[i] == piece)
      {
        const Eigen::Vector3d offset = this->Samples[i].position - center;
        bend += this->Fit.sense * this->Samples[i].weight * this->residual(i) * offset *
                offset.transpose();
      }
    }
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(bend);
    const Eigen::Vector3d direction = solver.eigenvectors().col(2);
    std::vector<std::pair<double, std::size_t>> along;
    for (std::size_t i = 0; i < this->Samples.size(); ++i)
    {
      if (this->Labels[i] == piece)
      {
        along.emplace_back(direction.dot(this->Samples[i].position), i);
      }
    }
    return along;
  }

  const std::vector<FrameSample>& Samples;
  std::vector<std::size_t> Labels; // the piece of each sample
  CreaseFit Fit;
};

} // namespace

double CreaseFit::value(const Eigen::Vector3d& p) const
{
  double best = this->sense * this->pieceValue(0, p);
  for (std::size_t piece = 1; piece < this->pieces.size(); ++piece)
  {
    best = std::max(best, this->sense * this->pieceValue(piece, p));
  }
  return this->sense * best;
}

double CreaseFit::relativeResidual() const
{
  double gentlest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector4d& piece : this->pieces)
  {
    gentlest = std::min(gentlest, piece.tail<3>().norm());
  }
  return std::sqrt(this->meanSquare) / gentlest;
}

bool CreaseFit::isOnSurface(std::size_t piece, const Eigen::Vector3d& p, double tolerance) const
{
  for (std::size_t other = 0; other < this->pieces.size(); ++other)
  {
    if (other != piece && this->sense * this->pieceValue(other, p) > tolerance)
    {
      return false;
    }
  }
  return true;
}

std::vector<CreaseFit> fitCreases(
  const std::vector<FrameSample>& samples, double mostRelativeResidual, double rivalMeanSquare)
{
  const auto better = [](const CreaseFit& a, const CreaseFit& b)
  { return b.pieces.empty() || (!a.pieces.empty() && a.meanSquare < b.meanSquare); };
  std::vector<CreaseFit> results;
  std::vector<Alternation> starts;
  CreaseFit two;
  double sense = 1.0;
  for (const double tried : { 1.0, -1.0 })
  {
    Alternation halves(samples, tried);
    if (halves.start() && halves.split(0.5) && better(halves.result(), two))
    {
      two = halves.result();
      sense = tried;
      starts.clear();
      starts.push_back(halves);
    }
  }
  // Halves of the start still have samples of the other side, and of a third piece.
  constexpr double promising = 6.0;
  if (two.pieces.empty() || two.relativeResidual() > promising * mostRelativeResidual ||
      two.meanSquare > rivalMeanSquare)
  {
    return results;
  }
  for (const double share : { 0.3, 0.7 })
  {
    Alternation parts(samples, sense);
    if (parts.start() && parts.split(share))
    {
      starts.push_back(parts);
      two = better(parts.result(), two) ? parts.result() : two;
    }
  }
  results.push_back(two);
  constexpr double exact = 1e-6;
  if (two.relativeResidual() < exact)
  {
    return results;
  }
  CreaseFit three;
  for (Alternation& start : starts)
  {
    if (start.split(0.5) && better(start.result(), three))
    {
      three = start.result();
    }
  }
  results.push_back(three);
  results.erase(std::remove_if(results.begin(), results.end(),
                  [=](const CreaseFit& fit) {
                    return fit.pieces.empty() || !(fit.relativeResidual() <= mostRelativeResidual);
                  }),
    results.end());
  return results;
}

} // namespace isopoint
