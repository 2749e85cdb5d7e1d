// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "PlaceTesting.h"

#include <Eigen/Dense>

/// The definition of values at places, which docs/algorithm.md outlines in section 13, independent
/// of the core: all samples sorted by distance, and normal equations in long double. Equal to the
/// core's except for rounding.
namespace placedefinition
{

using namespace places;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// The samples at one position: their offset from the place, and the mean of each component.
struct Site
{
  Vector3d offset;
  double squaredDistance;
  std::uint64_t id; // the lowest
  VectorXd values;
};

inline std::size_t countOf(PlaceMethod method)
{
  return std::array<std::size_t, 5>{ 64, 48, 27, 13, 1 }[static_cast<std::size_t>(method)];
}

/// All sites, nearest first. Values that are not finite count as missing.
inline std::vector<Site> sitesAround(
  const clouds::Cloud& cloud, const Array& array, const Vector& place)
{
  std::map<Vector, std::vector<std::size_t>> samples;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    samples[cloud.at(i)].push_back(i);
  }
  std::vector<Site> sites;
  for (const auto& [position, ids] : samples)
  {
    const Vector offset = position - place;
    Site site{ { offset[0], offset[1], offset[2] }, dot(offset, offset), ids.front(),
      VectorXd(array.components) };
    for (int c = 0; c < array.components; ++c)
    {
      Numbers finite;
      for (const std::size_t id : ids)
      {
        const double number =
          array
            .numbers[static_cast<std::size_t>(array.components) * id + static_cast<std::size_t>(c)];
        if (std::isfinite(number))
        {
          finite.push_back(number);
        }
      }
      site.values[c] =
        std::accumulate(finite.begin(), finite.end(), 0.0) / static_cast<double>(finite.size());
    }
    sites.push_back(site);
  }
  std::sort(sites.begin(), sites.end(),
    [](const Site& a, const Site& b)
    { return std::make_pair(a.squaredDistance, a.id) < std::make_pair(b.squaredDistance, b.id); });
  return sites;
}

/// The samples that are fitted, in units (13.1).
struct Around
{
  std::vector<Site> sites;
  std::size_t count; // to fit to
  double unit = 1.0;
  double squaredReach;

  Around(std::vector<Site> all, std::size_t most, double reach)
    : sites(std::move(all))
    , count(most)
  {
    this->sites.resize(this->count);
    this->unit = reach > 0.0 ? std::exp2(std::floor(std::log2(reach))) : 1.0;
    for (Site& site : this->sites)
    {
      site.offset /= this->unit;
      site.squaredDistance = site.offset.squaredNorm();
    }
    this->squaredReach = std::pow(reach / this->unit, 2);
    if (this->sites[0].squaredDistance >= (1.0 - 1e-9) * this->squaredReach)
    {
      this->squaredReach *= 1.21;
    }
  }

  VectorXd weights(double squared, bool isSteep) const
  {
    double h = 0.0;
    for (const Site& site : this->sites)
    {
      h += std::sqrt(site.squaredDistance) / static_cast<double>(this->sites.size());
    }
    VectorXd w(this->sites.size());
    for (std::size_t i = 0; i < this->sites.size(); ++i)
    {
      const double d = this->sites[i].squaredDistance;
      const double taper = std::pow(std::max(0.0, 1.0 - (squared > 0.0 ? d / squared : 0.0)), 2);
      w[static_cast<Index>(i)] =
        isSteep ? taper / std::pow(0.1 + (h > 0.0 ? d / (h * h) : 0.0), 3) : taper;
    }
    return w;
  }
};

/// A fit of a degree (13.2) for all components.
struct Fit
{
  MatrixXd atPlace; // value and gradient, by component
  VectorXd mean;
  MatrixXd residuals; // of samples left out, by component
  double variance;
  double gradientVariance;

  Fit(const Around& around, const VectorXd& w, int degree, double valueError)
  {
    const auto n = static_cast<Index>(around.sites.size());
    const Index components = around.sites[0].values.size();
    constexpr std::array<std::array<int, 3>, 20> powers{ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 },
      { 0, 0, 1 }, { 2, 0, 0 }, { 0, 2, 0 }, { 0, 0, 2 }, { 1, 1, 0 }, { 1, 0, 1 }, { 0, 1, 1 },
      { 3, 0, 0 }, { 0, 3, 0 }, { 0, 0, 3 }, { 2, 1, 0 }, { 2, 0, 1 }, { 1, 2, 0 }, { 0, 2, 1 },
      { 1, 0, 2 }, { 0, 1, 2 }, { 1, 1, 1 } } };
    const Index size = degree == 1 ? 4 : degree == 2 ? 10 : 20;
    // Thin samples are turned to their axes.
    Vector3d mean3 = Vector3d::Zero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (Index i = 0; i < n; ++i)
    {
      mean3 += w[i] / w.sum() * around.sites[static_cast<std::size_t>(i)].offset;
    }
    for (Index i = 0; i < n; ++i)
    {
      const Vector3d offset = around.sites[static_cast<std::size_t>(i)].offset - mean3;
      covariance += w[i] * offset * offset.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    const Vector3d& variances = solver.eigenvalues();
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    std::array<long double, 3> extents{ 1.0L, 1.0L, 1.0L };
    if (!(variances[0] > 0.02 * variances[2]))
    {
      axes = solver.eigenvectors().rowwise().reverse();
      for (int axis = 0; axis < 3; ++axis)
      {
        const double share = variances[2] > 0.0 ? variances[2 - axis] / variances[2] : 0.0;
        extents[static_cast<std::size_t>(axis)] =
          std::clamp((share - 1e-4) / (1e-3 - 1e-4), 0.0, 1.0);
      }
    }
    using Wide = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
    Wide monomials(n, size);
    for (Index i = 0; i < n; ++i)
    {
      const Vector3d own = axes.transpose() * around.sites[static_cast<std::size_t>(i)].offset;
      for (Index j = 0; j < size; ++j)
      {
        monomials(i, j) = 1.0L;
        for (int axis = 0; axis < 3; ++axis)
        {
          monomials(i, j) *= std::pow(static_cast<long double>(own[axis]),
            powers[static_cast<std::size_t>(j)][static_cast<std::size_t>(axis)]);
        }
      }
    }
    const Wide normal =
      monomials.transpose() * w.cast<long double>().asDiagonal() * monomials; // equations
    Wide factor = Wide::Zero(size, size);
    Wide inverse = Wide::Zero(size, size); // of the factor
    for (Index j = 0; j < size; ++j)
    {
      const long double pivot = normal(j, j) - factor.row(j).squaredNorm();
      if (pivot > 1e-7 * normal(j, j))
      {
        long double share = std::min(1.0L, (pivot / normal(j, j) - 1e-7L) / (1e-4L - 1e-7L));
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          share =
            powers[static_cast<std::size_t>(j)][axis] > 0 ? std::min(share, extents[axis]) : share;
        }
        if (share == 0.0L)
        {
          continue;
        }
        const long double root = std::sqrt(pivot / share);
        for (Index k = j + 1; k < size; ++k)
        {
          factor(k, j) = (normal(k, j) - factor.row(k).dot(factor.row(j))) / root;
        }
        inverse.row(j) = -factor.row(j) * inverse / root;
        inverse(j, j) += 1.0L / root;
      }
    }
    const MatrixXd q = (monomials * inverse.transpose()).cast<double>();
    const MatrixXd p = inverse.transpose().cast<double>();
    MatrixXd values(n, components);
    for (Index i = 0; i < n; ++i)
    {
      values.row(i) = around.sites[static_cast<std::size_t>(i)].values.transpose();
    }
    const MatrixXd products = q.transpose() * w.asDiagonal() * values;
    MatrixXd effects = p.topRows(4); // on value and gradient
    effects.bottomRows(3) = (axes * p.middleRows(1, 3)).eval();
    this->atPlace = effects * products;
    this->mean = products.row(0).transpose() * q(0, 0);
    const VectorXd rests = 1.0 - w.array() * q.array().square().rowwise().sum();
    this->residuals = values - q * products;
    double squares = 0.0;
    for (Index i = 0; i < n; ++i)
    {
      this->residuals.row(i) +=
        std::max(0.0, 1e-3 - rests[i]) * (values.row(i) - this->mean.transpose());
      this->residuals.row(i) /= std::max(rests[i], 1e-3);
      squares += w[i] * this->residuals.row(i).squaredNorm();
    }
    const MatrixXd ofSamples = effects * q.transpose() * w.asDiagonal();
    const double sigma =
      std::max(squares / w.sum(), static_cast<double>(components) * valueError * valueError);
    this->variance = sigma * ofSamples.row(0).norm();
    this->gradientVariance = sigma * ofSamples.bottomRows(3).squaredNorm();
  }
};

/// Value and gradient (columns 1 to 3) of each component.
struct Result
{
  MatrixXd numbers;
  bool isNothing = false;
};

inline bool isEnough(std::size_t count, int degree)
{
  return count >= (degree == 2 ? 13u : 25u); // 5/4 of the coefficients
}

inline MatrixXd blended(const Around& around, double valueError)
{
  const auto squaredReach = [&](std::size_t few)
  { return few < around.count ? around.sites[few].squaredDistance : around.squaredReach; };
  std::vector<Fit> fits;
  fits.emplace_back(around, around.weights(squaredReach(24), false), 1, valueError);
  if (isEnough(std::min<std::size_t>(around.count, 40), 2))
  {
    fits.emplace_back(around, around.weights(around.squaredReach, false), 2, valueError);
    fits.emplace_back(around, around.weights(squaredReach(40), true), 2, valueError);
  }
  const bool hasCubic = isEnough(around.count, 3);
  if (hasCubic)
  {
    fits.emplace_back(around, around.weights(around.squaredReach, true), 3, valueError);
  }
  const auto share = [](double variance, double least)
  { return variance > least ? std::pow(least / variance, 2) : 1.0; };
  double least = fits[0].variance;
  double leastGradient = fits[0].gradientVariance;
  for (const Fit& fit : fits)
  {
    least = std::min(least, fit.variance);
    leastGradient = std::min(leastGradient, fit.gradientVariance);
  }
  MatrixXd result = MatrixXd::Zero(fits[0].atPlace.rows(), fits[0].atPlace.cols());
  Eigen::Vector4d totals = Eigen::Vector4d::Zero();
  for (const Fit& fit : fits)
  {
    const double ofGradient = share(fit.gradientVariance, leastGradient);
    const Eigen::Vector4d shares(share(fit.variance, least), ofGradient, ofGradient, ofGradient);
    result += shares.asDiagonal() * fit.atPlace;
    totals += shares;
  }
  result = totals.cwiseInverse().asDiagonal() * result;

  // The limit (13.3).
  const VectorXd mean = fits.back().mean;
  double spread = 0.0;
  double lowest = 0.0;
  double highest = 0.0;
  double worst = 0.0;
  for (std::size_t i = 0; i < around.count; ++i)
  {
    const double d = around.sites[i].squaredDistance;
    const double limit = std::min(
      1.0, 4.0 * std::max(0.0, 1.0 - (around.squaredReach > 0.0 ? d / around.squaredReach : 0.0)));
    const VectorXd difference = limit * (around.sites[i].values - mean);
    spread = std::max(spread, difference.norm());
    lowest = std::min(lowest, difference[0]);
    highest = std::max(highest, difference[0]);
    worst = std::max(worst, limit * fits.back().residuals.row(static_cast<Index>(i)).norm());
  }
  const VectorXd difference = result.row(0).transpose() - mean;
  const double most = difference.size() > 1 ? spread : (difference[0] > 0.0 ? highest : -lowest);
  if (difference.norm() > most)
  {
    const double resolution = hasCubic ? std::clamp((0.1 - worst / spread) / 0.05, 0.0, 1.0) : 0.0;
    const double ofCubic =
      hasCubic ? (fits.back().atPlace.row(0).transpose() - mean).dot(difference.normalized()) : 0.0;
    const double limited =
      std::min(difference.norm(), most + resolution * std::max(0.0, ofCubic - most));
    result.row(0) = (mean + limited / difference.norm() * difference).transpose();
  }
  return result;
}

/// The numbers of the nearest sample with finite ones, among the 27 nearest positions.
inline Result nearest(const clouds::Cloud& cloud, const Array& array, const Vector& place)
{
  std::vector<Site> sites = sitesAround(cloud, array, place);
  sites.resize(std::min<std::size_t>(27, sites.size()));
  for (const Site& site : sites)
  {
    for (std::size_t id = 0; id < cloud.size(); ++id)
    {
      const double* const numbers =
        array.numbers.data() + static_cast<std::size_t>(array.components) * id;
      const Eigen::Map<const VectorXd> values(numbers, array.components);
      if (cloud.at(id) == cloud.at(site.id) && values.allFinite())
      {
        MatrixXd result = MatrixXd::Zero(4, array.components);
        result.row(0) = values.transpose();
        return { result };
      }
    }
  }
  return { {}, true };
}

/// The value and gradient of an array at a place, without regard to whether it is outside.
inline Result at(const clouds::Cloud& cloud, const Array& array, const Vector& place,
  PlaceMethod method, std::size_t needed)
{
  if (method == PlaceMethod::Nearest)
  {
    return nearest(cloud, array, place);
  }
  std::vector<Site> sites = sitesAround(cloud, array, place);
  const std::size_t most = std::min(countOf(method), sites.size());
  const double reach =
    sites.size() > most ? sites[most].offset.norm() : 1.1 * sites.back().offset.norm();
  sites.resize(std::min(needed, sites.size()));
  std::size_t count = 0;
  std::vector<Site> with;
  for (std::size_t i = 0; i < sites.size(); ++i)
  {
    if (sites[i].values.allFinite())
    {
      with.push_back(sites[i]);
      count += i < most ? 1 : 0;
    }
  }
  if (count == 0)
  {
    return { {}, true };
  }
  const Around around(with, count, reach);
  const int degree = method == PlaceMethod::Affine || !isEnough(count, 2)      ? 1
                     : method == PlaceMethod::Quadratic || !isEnough(count, 3) ? 2
                                                                               : 3;
  MatrixXd numbers =
    method == PlaceMethod::Blend
      ? blended(around, array.valueError)
      : Fit(around, around.weights(around.squaredReach, method != PlaceMethod::Affine), degree, 0.0)
          .atPlace;
  numbers.bottomRows(3) /= around.unit;
  return { numbers };
}

} // namespace placedefinition
