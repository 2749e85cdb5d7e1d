// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatMesh.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace
{

std::size_t indexOf(vtkIdType id)
{
  return static_cast<std::size_t>(id);
}

template <class Function>
void forPoints(vtkIdType points, const Function& of)
{
  vtkSMPTools::For(0, points,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType point = begin; point < end; ++point)
      {
        of(point);
      }
    });
}

/// A corner with its place along a line.
struct Projected
{
  double Along;
  vtkIdType Corner;

  bool operator<(const Projected& other) const
  {
    return this->Along != other.Along ? this->Along < other.Along : this->Corner < other.Corner;
  }
};

/// The direction of the line is askew to lattices of all kinds, so that few corners that are apart
/// are close together along the line.
double project(const vtkVector3d& place)
{
  return 0.5227 * place[0] + 0.6180 * place[1] + 0.5871 * place[2];
}

bool areOne(const vtkIsopointCorner& a, const vtkIsopointCorner& b)
{
  constexpr float turn = 1e-3f;
  const double tolerance = std::min(a.Tolerance, b.Tolerance);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (std::abs(a.Place[axis] - b.Place[axis]) > tolerance ||
        std::abs(a.Normal[axis] - b.Normal[axis]) > turn)
    {
      return false;
    }
  }
  return true;
}

/// Which corners are one, up to rounding: those whose places are no farther apart than both of
/// their tolerances, along each axis, and whose normals differ by less than 0.06 degrees. O(n log
/// n), unless tolerances are large against the distances between corners.
/// @returns for each corner the one that stands for all that it is one with, perhaps itself
std::vector<vtkIdType> meetingCorners(const std::vector<vtkIsopointCorner>& corners)
{
  std::vector<Projected> sorted;
  sorted.reserve(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    if (corners[i].Tolerance > 0.0f)
    {
      sorted.push_back({ project(corners[i].Place), static_cast<vtkIdType>(i) });
    }
  }
  vtkSMPTools::Sort(sorted.begin(), sorted.end());

  std::vector<vtkIdType> meetsAt(corners.size());
  std::iota(meetsAt.begin(), meetsAt.end(), 0);
  for (std::size_t i = 0; i < sorted.size(); ++i)
  {
    const auto own = static_cast<std::size_t>(sorted[i].Corner);
    const double end = sorted[i].Along + 2.0 * corners[own].Tolerance;
    for (std::size_t j = i + 1; j < sorted.size() && sorted[j].Along <= end; ++j)
    {
      const auto other = static_cast<std::size_t>(sorted[j].Corner);
      if (meetsAt[other] == sorted[j].Corner && areOne(corners[own], corners[other]))
      {
        meetsAt[other] = meetsAt[own];
      }
    }
  }
  return meetsAt;
}

} // namespace

//------------------------------------------------------------------------------
vtkIsopointSplatMesh::vtkIsopointSplatMesh(const vtkIsopointSplatShapes& shapes, vtkIdType points)
  : FirstVertices(indexOf(points) + 1, 0)
  , FirstTriangles(indexOf(points) + 1, 0)
{
  forPoints(points,
    [&](vtkIdType point)
    {
      const vtkIsopointSplatFan fan = shapes.Fan(point);
      this->FirstVertices[indexOf(point) + 1] = fan.Vertices;
      this->FirstTriangles[indexOf(point) + 1] = fan.Triangles;
    });
  std::partial_sum(
    this->FirstVertices.begin(), this->FirstVertices.end(), this->FirstVertices.begin());
  std::partial_sum(
    this->FirstTriangles.begin(), this->FirstTriangles.end(), this->FirstTriangles.begin());

  this->Vertices.resize(indexOf(this->NumberOfVertices()));
  this->Corners.resize(indexOf(3 * this->NumberOfTriangles()));
  std::vector<vtkIdType> pointOfVertex(this->Vertices.size());
  forPoints(points,
    [&](vtkIdType point)
    {
      const vtkIsopointSplatFan fan = shapes.Fan(point);
      const vtkIdType first = this->FirstVertices[indexOf(point)];
      for (int i = 0; i < fan.Vertices; ++i)
      {
        const vtkVector3d& normal = fan.Normals[indexOf(i)];
        this->Vertices[indexOf(first + i)] = { fan.Places[indexOf(i)],
          { static_cast<float>(normal[0]), static_cast<float>(normal[1]),
            static_cast<float>(normal[2]) },
          fan.Tolerance };
        pointOfVertex[indexOf(first + i)] = point;
      }
      for (int i = 0; i < fan.Triangles; ++i)
      {
        std::array<int, 3> corners;
        for (int k = 0; k < 3; ++k)
        {
          corners[indexOf(k)] = vtkIsopointSplatCorner(fan, i, k);
        }
        // Where two corners of a splat have passed each other, it would face away and be dark.
        const vtkVector3d& a = fan.Places[indexOf(corners[0])];
        const vtkVector3d side = fan.Places[indexOf(corners[1])] - a;
        const vtkVector3d other = fan.Places[indexOf(corners[2])] - a;
        if (side.Cross(other).Dot(fan.Normals[indexOf(corners[0])]) < 0.0)
        {
          std::swap(corners[1], corners[2]);
        }
        for (int k = 0; k < 3; ++k)
        {
          this->Corners[indexOf(3 * (this->FirstTriangles[indexOf(point)] + i) + k)] =
            first + corners[indexOf(k)];
        }
      }
    });

  // A counting sort of points by the place of their vertices.
  this->MeetsAt = meetingCorners(this->Vertices);
  this->FirstMeeting.assign(this->MeetsAt.size() + 1, 0);
  for (const vtkIdType vertex : this->MeetsAt)
  {
    ++this->FirstMeeting[indexOf(vertex) + 1];
  }
  std::partial_sum(
    this->FirstMeeting.begin(), this->FirstMeeting.end(), this->FirstMeeting.begin());
  this->MeetingPoints.resize(this->MeetsAt.size());
  std::vector<vtkIdType> next(this->FirstMeeting.begin(), this->FirstMeeting.end() - 1);
  for (std::size_t i = 0; i < this->MeetsAt.size(); ++i)
  {
    this->MeetingPoints[indexOf(next[indexOf(this->MeetsAt[i])]++)] = pointOfVertex[i];
  }
}
