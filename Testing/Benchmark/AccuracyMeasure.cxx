// SPDX-License-Identifier: GPL-3.0-or-later
#include "AccuracyMeasure.h"

#include "AccuracySplats.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace accuracy
{
namespace
{

using analytic::dot;
using analytic::Foot;
using analytic::Surface;
using analytic::Vector;

constexpr double quantile = 0.999;

/// Runs f(i) for each i below count, in parallel.
template <class Function>
void forEach(std::size_t count, const Function& function)
{
  vtkSMPTools::For(0, static_cast<vtkIdType>(count), 1000,
    [&function](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        function(static_cast<std::size_t>(i));
      }
    });
}

double meanOf(const std::vector<double>& numbers)
{
  return std::accumulate(numbers.begin(), numbers.end(), 0.0) / static_cast<double>(numbers.size());
}

double quantileOf(std::vector<double> numbers)
{
  const auto place =
    static_cast<std::ptrdiff_t>(std::ceil(quantile * static_cast<double>(numbers.size())) - 1.0);
  std::nth_element(numbers.begin(), numbers.begin() + place, numbers.end());
  return numbers[static_cast<std::size_t>(place)];
}

/// The angle between a normal and the nearest of the true ones, in degrees.
double angleOf(const Vector& normal, const Foot& foot)
{
  double cosine = -1.0;
  for (const Vector& truth : foot.normals)
  {
    cosine = std::max(cosine, dot(normal, truth));
  }
  return std::acos(std::min(cosine, 1.0)) * 180.0 / 3.14159265358979323846;
}

/// The share of the places that no splat covers.
double uncoveredShare(const std::vector<Splat>& splats, const Surface& surface,
  const std::vector<Vector>& places, double meanSpacing)
{
  const Coverage coverage(splats, 0.5 * meanSpacing);
  std::vector<double> misses(places.size());
  forEach(places.size(),
    [&](std::size_t i)
    {
      const Vector normal = surface.footOf(places[i]).normals.front();
      misses[i] = coverage.covers(places[i], normal) ? 0.0 : 1.0;
    });
  return meanOf(misses);
}

bool isWithin(const Vector& p, double halfSide)
{
  return std::max({ std::abs(p[0]), std::abs(p[1]), std::abs(p[2]) }) <= halfSide;
}

std::vector<vtkIdType> pointsWithin(vtkPolyData* points, double halfSide)
{
  std::vector<vtkIdType> inner;
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    Vector p;
    points->GetPoint(i, p.data());
    if (isWithin(p, halfSide))
    {
      inner.push_back(i);
    }
  }
  return inner;
}

double rimDistance(const std::vector<Splat>& splats, const Surface& surface, double halfSide)
{
  std::vector<Vector> ends;
  for (const Splat& splat : splats)
  {
    if (isWithin(splat.center, halfSide))
    {
      ends.insert(ends.end(), splat.corners.begin(), splat.corners.end());
    }
  }
  std::vector<double> distances(ends.size());
  forEach(ends.size(), [&](std::size_t i) { distances[i] = surface.footOf(ends[i]).distance; });
  return ends.empty() ? -1.0 : quantileOf(distances);
}

} // namespace

Measurement measureAccuracy(vtkPolyData* extracted, const Surface& surface,
  const std::vector<Vector>& truePoints, double halfSide, double meanSpacing)
{
  Measurement result;
  result.points = static_cast<std::size_t>(extracted->GetNumberOfPoints());
  const std::vector<Splat> splats = splatsOf(extracted);
  if (!splats.empty())
  {
    result.uncovered = uncoveredShare(splats, surface, truePoints, meanSpacing);
    result.rimDistance = rimDistance(splats, surface, halfSide) / meanSpacing;
  }
  const std::vector<vtkIdType> inner = pointsWithin(extracted, halfSide);
  if (inner.empty())
  {
    return result;
  }
  vtkDataArray* const normals = extracted->GetPointData()->GetNormals();
  std::vector<double> distances(inner.size());
  std::vector<double> angles(inner.size());
  forEach(inner.size(),
    [&](std::size_t i)
    {
      Vector p;
      extracted->GetPoints()->GetPoint(inner[i], p.data());
      const Foot foot = surface.footOf(p);
      distances[i] = foot.distance / meanSpacing;
      if (normals)
      {
        angles[i] = angleOf(analytic::directionOf(tupleOf(normals, inner[i])), foot);
      }
    });
  result.meanDistance = meanOf(distances);
  result.quantileDistance = quantileOf(distances);
  result.largestDistance = *std::max_element(distances.begin(), distances.end());
  if (normals)
  {
    result.meanAngle = meanOf(angles);
    result.largestAngle = *std::max_element(angles.begin(), angles.end());
  }
  return result;
}

} // namespace accuracy
