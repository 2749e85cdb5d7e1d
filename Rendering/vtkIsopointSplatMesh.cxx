// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatMesh.h"

#include "vtkIsopointMeetingCorners.h"

#include "vtkSMPTools.h"

#include <cstddef>
#include <numeric>

namespace
{

std::size_t indexOf(vtkIdType id)
{
  return static_cast<std::size_t>(id);
}

vtkVector3f asFloat(const vtkVector3d& vector)
{
  return { static_cast<float>(vector[0]), static_cast<float>(vector[1]),
    static_cast<float>(vector[2]) };
}

/// The vertices of each splat, before those that meet become one.
struct SeparateVertices
{
  SeparateVertices(
    const vtkIsopointSplatShapes& shapes, vtkIdType points, std::vector<vtkIdType>& firstTriangles)
  {
    this->First.resize(indexOf(points) + 1, 0);
    firstTriangles.assign(indexOf(points) + 1, 0);
    vtkSMPTools::For(0, points,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType point = begin; point < end; ++point)
        {
          const vtkIsopointSplatFan fan = shapes.Fan(point);
          this->First[indexOf(point) + 1] = fan.Vertices;
          firstTriangles[indexOf(point) + 1] = fan.Triangles;
        }
      });
    std::partial_sum(this->First.begin(), this->First.end(), this->First.begin());
    std::partial_sum(firstTriangles.begin(), firstTriangles.end(), firstTriangles.begin());
    this->Corners.resize(indexOf(this->First.back()));
    vtkSMPTools::For(0, points,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType point = begin; point < end; ++point)
        {
          this->Set(point, shapes.Fan(point));
        }
      });
  }

  void Set(vtkIdType point, const vtkIsopointSplatFan& fan)
  {
    for (int i = 0; i < fan.Vertices; ++i)
    {
      vtkIsopointCorner& corner = this->Corners[indexOf(this->First[indexOf(point)] + i)];
      corner.Place = fan.Places[indexOf(i)];
      corner.Normal = asFloat(fan.Normals[indexOf(i)]);
      corner.Tolerance = i == 0 ? 0.0f : fan.Tolerance;
    }
  }

  std::vector<vtkIdType> First; // vertex of each point
  std::vector<vtkIsopointCorner> Corners;
};

} // namespace

//------------------------------------------------------------------------------
vtkIsopointSplatMesh::vtkIsopointSplatMesh(const vtkIsopointSplatShapes& shapes, vtkIdType points)
{
  const SeparateVertices separate(shapes, points, this->FirstTriangles);
  const std::vector<vtkIdType> meeting = vtkIsopointMeetingCorners(separate.Corners);

  // Vertices in the order in which points have them first.
  std::vector<vtkIdType> vertices(meeting.size());
  for (std::size_t i = 0; i < meeting.size(); ++i)
  {
    const bool isFirst = meeting[i] == static_cast<vtkIdType>(i);
    vertices[i] = isFirst ? this->NumberOfVertices() : vertices[indexOf(meeting[i])];
    if (isFirst)
    {
      this->Places.push_back(separate.Corners[i].Place);
      this->Normals.push_back(separate.Corners[i].Normal);
    }
  }

  // A counting sort of the points by vertex.
  this->FirstMeeting.assign(this->Places.size() + 1, 0);
  for (const vtkIdType vertex : vertices)
  {
    ++this->FirstMeeting[indexOf(vertex) + 1];
  }
  std::partial_sum(this->FirstMeeting.begin(), this->FirstMeeting.end(), this->FirstMeeting.begin());
  this->MeetingPoints.resize(vertices.size());
  std::vector<vtkIdType> next(this->FirstMeeting.begin(), this->FirstMeeting.end() - 1);
  for (vtkIdType point = 0; point < points; ++point)
  {
    for (vtkIdType i = separate.First[indexOf(point)]; i < separate.First[indexOf(point) + 1]; ++i)
    {
      this->MeetingPoints[indexOf(next[indexOf(vertices[indexOf(i)])]++)] = point;
    }
  }

  this->Corners.resize(indexOf(3 * this->NumberOfTriangles()));
  vtkSMPTools::For(0, points,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType point = begin; point < end; ++point)
      {
        const vtkIdType first = separate.First[indexOf(point)];
        const auto count = static_cast<int>(separate.First[indexOf(point) + 1] - first);
        const vtkIdType firstTriangle = this->FirstTriangles[indexOf(point)];
        const auto triangles =
          static_cast<int>(this->FirstTriangles[indexOf(point) + 1] - firstTriangle);
        for (int i = 0; i < 3 * triangles; ++i)
        {
          const int corner = vtkIsopointSplatCorner(count, triangles, i / 3, i % 3);
          this->Corners[indexOf(3 * firstTriangle + i)] = vertices[indexOf(first + corner)];
        }
      }
    });
}
