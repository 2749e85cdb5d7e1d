// SPDX-License-Identifier: GPL-3.0-or-later
#include "AccuracySplats.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace accuracy
{
namespace
{

using analytic::cross;
using analytic::difference;
using analytic::dot;
using analytic::length;
using analytic::Vector;

/// Two axes of a length, perpendicular to a normal and to each other.
std::array<Vector, 2> axesAcross(const Vector& normal, double radius)
{
  const auto least = std::min_element(
    normal.begin(), normal.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  Vector helper{ 0.0, 0.0, 0.0 };
  helper[static_cast<std::size_t>(least - normal.begin())] = 1.0;
  const Vector first = analytic::scaled(analytic::directionOf(cross(normal, helper)), radius);
  return { first, cross(normal, first) };
}

std::uint64_t keyOf(std::int64_t x, std::int64_t y, std::int64_t z)
{
  constexpr std::int64_t half = 1 << 20;
  return (static_cast<std::uint64_t>(x + half) << 42) |
         (static_cast<std::uint64_t>(y + half) << 21) | static_cast<std::uint64_t>(z + half);
}

} // namespace

Vector tupleOf(vtkDataArray* array, vtkIdType i)
{
  return { array->GetComponent(i, 0), array->GetComponent(i, 1), array->GetComponent(i, 2) };
}

double Splat::radius() const
{
  return std::max(length(this->axis1), length(this->axis2));
}

bool Splat::isClippedAt(const Vector& offset) const
{
  return dot({ this->clip[0], this->clip[1], this->clip[2] }, offset) + this->clip[3] < 0.0;
}

std::array<Vector, 4> Splat::ends() const
{
  std::array<Vector, 4> result{ this->axis1, analytic::scaled(this->axis1, -1.0), this->axis2,
    analytic::scaled(this->axis2, -1.0) };
  for (Vector& end : result)
  {
    const double towardsPlane = -dot({ this->clip[0], this->clip[1], this->clip[2] }, end);
    const double share = this->isClippedAt(end) ? this->clip[3] / towardsPlane : 1.0;
    end = analytic::sum(this->center, analytic::scaled(end, share));
  }
  return result;
}

std::vector<Splat> splatsOf(vtkPolyData* points)
{
  vtkPointData* const data = points->GetPointData();
  vtkDataArray* const normals = data->GetNormals();
  vtkDataArray* const radii = data->GetArray("Radius");
  vtkDataArray* const axes1 = data->GetArray("SplatAxis1");
  vtkDataArray* const axes2 = data->GetArray("SplatAxis2");
  vtkDataArray* const clips = data->GetArray("SplatClip");
  std::vector<Splat> splats;
  if (!normals || !(radii || (axes1 && axes2)))
  {
    return splats;
  }
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    Splat splat;
    points->GetPoint(i, splat.center.data());
    splat.normal = tupleOf(normals, i);
    const std::array<Vector, 2> axes =
      axes1 && axes2 ? std::array<Vector, 2>{ tupleOf(axes1, i), tupleOf(axes2, i) }
                     : axesAcross(splat.normal, radii->GetComponent(i, 0));
    splat.axis1 = axes[0];
    splat.axis2 = axes[1];
    if (clips)
    {
      clips->GetTuple(i, splat.clip.data());
    }
    splats.push_back(splat);
  }
  return splats;
}

Coverage::Coverage(const std::vector<Splat>& splats, double leastTolerance)
  : Splats(splats)
  , LeastTolerance(leastTolerance)
{
  std::map<int, std::vector<std::size_t>> byOctave;
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    const double reach = std::max(2.0 * splats[i].radius(), leastTolerance);
    byOctave[static_cast<int>(std::ceil(std::log2(reach)))].push_back(i);
  }
  for (const auto& [octave, indices] : byOctave)
  {
    Level level;
    level.cellSize = std::exp2(octave);
    for (const std::size_t i : indices)
    {
      const Vector& c = splats[i].center;
      level
        .cells[keyOf(std::llround(std::floor(c[0] / level.cellSize)),
          std::llround(std::floor(c[1] / level.cellSize)),
          std::llround(std::floor(c[2] / level.cellSize)))]
        .push_back(i);
    }
    this->Levels.push_back(std::move(level));
  }
}

bool Coverage::isCoveredBy(const Splat& splat, const Vector& place) const
{
  const Vector way = difference(place, splat.center);
  const double height = std::abs(dot(way, splat.normal));
  if (height > std::max(this->LeastTolerance, 0.5 * splat.radius()) || splat.isClippedAt(way))
  {
    return false;
  }
  const double a = dot(way, splat.axis1) / dot(splat.axis1, splat.axis1);
  const double b = dot(way, splat.axis2) / dot(splat.axis2, splat.axis2);
  return a * a + b * b <= 1.0;
}

bool Coverage::covers(const Vector& place) const
{
  for (const Level& level : this->Levels)
  {
    std::array<std::int64_t, 3> lowest;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      lowest[axis] = std::llround(std::floor(place[axis] / level.cellSize)) - 1;
    }
    for (int i = 0; i < 27; ++i)
    {
      const auto found =
        level.cells.find(keyOf(lowest[0] + i % 3, lowest[1] + i / 3 % 3, lowest[2] + i / 9));
      if (found != level.cells.end() &&
          std::any_of(found->second.begin(), found->second.end(),
            [&](std::size_t splat) { return this->isCoveredBy(this->Splats[splat], place); }))
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace accuracy
