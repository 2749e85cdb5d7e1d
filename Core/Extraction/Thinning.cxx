// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Extraction/Thinning.h"

#include "Core/Base/Hash.h"
#include "Core/Base/Vector.h"
#include "Core/Fit/LocalFit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace isopoint
{
namespace
{

/// The greatest height of a close point above the tangent plane, in units of the thinning distance.
constexpr double maxHeight = 0.25;

/// Coordinates plus a distance up to this limit stay finite.
constexpr double largestSpacing = 1e290;

/// Whether a fit determines the sheet of a point; other points are not close to any.
bool hasSheet(const LocalFit& fit, double minimumSpacing)
{
  const double slope = lengthOf(fit.gradient);
  return fit.isSmooth && slope > 0.0 && std::isfinite(slope) && fit.spacing <= largestSpacing &&
         minimumSpacing * fit.spacing > 0.0 &&
         std::all_of(fit.position.begin(), fit.position.end(),
           [](double coordinate) { return std::isfinite(coordinate); });
}

/// Whether two points, both with a sheet, are close.
bool areClose(const LocalFit& one, const LocalFit& other, double minimumSpacing)
{
  const double reach = minimumSpacing * std::min(one.spacing, other.spacing);
  const Vector offset = other.position - one.position;
  if (!(lengthOf(offset) < reach))
  {
    return false;
  }
  const Vector normal = directionOf(one.gradient);
  const Vector otherNormal = directionOf(other.gradient);
  return dot(normal, otherNormal) >= maxCreaseCosine &&
         std::abs(dot(normal, offset)) <= maxHeight * reach &&
         std::abs(dot(otherNormal, offset)) <= maxHeight * reach;
}

/// The kept isopoints in hash grids, one per power of two of the thinning distance.
class KeptPoints
{
public:
  KeptPoints(const std::vector<LocalFit>& fits, double minimumSpacing)
    : Fits(fits)
    , MinimumSpacing(minimumSpacing)
  {
  }

  bool hasCloseTo(const LocalFit& fit) const
  {
    const double reach = this->MinimumSpacing * fit.spacing;
    return std::any_of(this->Exponents.begin(), this->Exponents.end(),
      [&](int exponent)
      { return this->hasCloseTo(fit, exponent, std::min(reach, std::ldexp(1.0, exponent))); });
  }

  void add(std::size_t point)
  {
    const LocalFit& fit = this->Fits[point];
    const int exponent = this->exponentOf(fit);
    const double size = cellSize(exponent);
    const auto isAt = std::lower_bound(this->Exponents.begin(), this->Exponents.end(), exponent);
    if (isAt == this->Exponents.end() || *isAt != exponent)
    {
      this->Exponents.insert(isAt, exponent);
    }
    const Cell cell{ exponent,
      { std::floor(fit.position[0] / size), std::floor(fit.position[1] / size),
        std::floor(fit.position[2] / size) } };
    this->PointsInCell[cell].push_back(point);
  }

private:
  /// The exponent of a grid, and the place of a cell in it: integers, or infinite for points too
  /// far away for their grid.
  using Cell = std::pair<int, Vector>;

  struct HashOfCell
  {
    std::size_t operator()(const Cell& cell) const
    {
      return static_cast<std::size_t>(hashOfCell(cell.first, cell.second));
    }
  };

  /// Twice the largest distance: a point's ball touches at most two cells per axis.
  static double cellSize(int exponent) { return std::ldexp(1.0, exponent + 1); }

  /// The binary exponent of an upper bound on the distance, limited by the coordinates' resolution.
  int exponentOf(const LocalFit& fit) const
  {
    const auto [lowest, highest] = std::minmax_element(fit.position.begin(), fit.position.end());
    const double farthest = std::max(-*lowest, *highest);
    constexpr int digits = std::numeric_limits<double>::digits;
    const int ofReach = std::ilogb(this->MinimumSpacing * fit.spacing) + 1;
    return farthest > 0.0 ? std::max(ofReach, std::ilogb(farthest) - digits) : ofReach;
  }

  /// Whether a close point was kept in one grid.
  bool hasCloseTo(const LocalFit& fit, int exponent, double reach) const
  {
    const double size = cellSize(exponent);
    std::array<Vector, 3> places; // by axis: of the lower end, the point and the upper end
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double own = fit.position[axis];
      places[axis] = { std::floor((own - reach) / size), std::floor(own / size),
        std::floor((own + reach) / size) };
    }
    const auto isRepeated = [&places](std::size_t axis, std::size_t i)
    { return i > 0 && places[axis][i] == places[axis][i - 1]; };
    for (std::size_t i = 0; i < 27; ++i)
    {
      const std::array<std::size_t, 3> end{ i % 3, i / 3 % 3, i / 9 };
      if (!isRepeated(0, end[0]) && !isRepeated(1, end[1]) && !isRepeated(2, end[2]) &&
          this->hasCloseIn(
            { exponent, { places[0][end[0]], places[1][end[1]], places[2][end[2]] } }, fit))
      {
        return true;
      }
    }
    return false;
  }

  bool hasCloseIn(const Cell& cell, const LocalFit& fit) const
  {
    const auto found = this->PointsInCell.find(cell);
    return found != this->PointsInCell.end() &&
           std::any_of(found->second.begin(), found->second.end(),
             [&](std::size_t point)
             { return areClose(this->Fits[point], fit, this->MinimumSpacing); });
  }

  const std::vector<LocalFit>& Fits;
  const double MinimumSpacing;
  std::vector<int> Exponents; // of the grids, ascending
  std::unordered_map<Cell, std::vector<std::size_t>, HashOfCell> PointsInCell;
};

} // namespace

std::vector<std::size_t> keptPoints(
  const Execution& execution, double minimumSpacing, const std::vector<LocalFit>& fits)
{
  constexpr std::size_t batch = 8192;
  KeptPoints keptSheets(fits, minimumSpacing);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < fits.size(); ++i)
  {
    if (i % batch == 0)
    {
      throwIfAborted(execution);
    }
    if (!hasSheet(fits[i], minimumSpacing))
    {
      kept.push_back(i);
    }
    else if (!keptSheets.hasCloseTo(fits[i]))
    {
      kept.push_back(i);
      keptSheets.add(i);
    }
  }
  return kept;
}

void thin(const Execution& execution, double minimumSpacing, Isosurface& surface)
{
  if (minimumSpacing > 0.0 && !surface.fits.empty())
  {
    surface =
      chosenIsopoints(execution, surface, keptPoints(execution, minimumSpacing, surface.fits));
  }
}

} // namespace isopoint
