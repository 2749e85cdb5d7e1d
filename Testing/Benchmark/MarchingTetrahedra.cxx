// SPDX-License-Identifier: GPL-3.0-or-later
#include "MarchingTetrahedra.h"

#include "AnalyticSurface.h"
#include "Delaunay.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace accuracy
{
namespace
{

using analytic::cross;
using analytic::difference;
using analytic::dot;
using analytic::Vector;

/// Collects the vertices of the surface, cell by cell.
class Marching
{
public:
  Marching(vtkPolyData* cloud, double isovalue)
    : Cloud(cloud)
    , Values(cloud->GetPointData()->GetScalars())
    , Isovalue(isovalue)
  {
  }

  void add(const Tetrahedron& cell)
  {
    std::vector<vtkIdType> below;
    std::vector<vtkIdType> above;
    for (const vtkIdType id : cell)
    {
      (this->valueOf(id) < this->Isovalue ? below : above).push_back(id);
    }
    if (below.empty() || above.empty())
    {
      return;
    }
    // A triangle, or a quadrilateral with its corners in order around it.
    std::vector<std::size_t> corners;
    for (std::size_t a = 0; a < above.size(); ++a)
    {
      for (std::size_t b = 0; b < below.size(); ++b)
      {
        const bool reversed = above.size() == 2 && below.size() == 2 && a == 1;
        corners.push_back(this->vertexOn(above[a], below[reversed ? below.size() - 1 - b : b]));
      }
    }
    const Vector decreasing = difference(this->positionOf(below[0]), this->positionOf(above[0]));
    for (std::size_t i = 2; i < corners.size(); ++i)
    {
      const Vector& origin = this->Positions[corners[0]];
      Vector area = cross(difference(this->Positions[corners[i - 1]], origin),
        difference(this->Positions[corners[i]], origin));
      // All corners of the cell that are above lie on one side of the plane.
      area = dot(area, decreasing) < 0.0 ? analytic::scaled(area, -1.0) : area;
      for (const std::size_t corner : { corners[0], corners[i - 1], corners[i] })
      {
        this->Areas[corner] = analytic::sum(this->Areas[corner], area);
      }
    }
  }

  vtkSmartPointer<vtkPolyData> surface() const
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkDoubleArray> normals;
    normals->SetNumberOfComponents(3);
    for (std::size_t i = 0; i < this->Positions.size(); ++i)
    {
      points->InsertNextPoint(this->Positions[i].data());
      normals->InsertNextTuple(analytic::directionOf(this->Areas[i]).data());
    }
    auto result = vtkSmartPointer<vtkPolyData>::New();
    result->SetPoints(points);
    result->GetPointData()->SetNormals(normals);
    return result;
  }

private:
  double valueOf(vtkIdType id) const { return this->Values->GetComponent(id, 0); }

  Vector positionOf(vtkIdType id) const
  {
    Vector p;
    this->Cloud->GetPoint(id, p.data());
    return p;
  }

  std::size_t vertexOn(vtkIdType a, vtkIdType b)
  {
    const auto [found, isNew] =
      this->Vertices.insert({ std::minmax(a, b), this->Positions.size() });
    if (isNew)
    {
      const Vector p = this->positionOf(a);
      const double t = (this->Isovalue - this->valueOf(a)) / (this->valueOf(b) - this->valueOf(a));
      this->Positions.push_back(
        analytic::sum(p, analytic::scaled(difference(this->positionOf(b), p), t)));
      this->Areas.push_back({ 0.0, 0.0, 0.0 });
    }
    return found->second;
  }

  vtkPolyData* Cloud;
  vtkDataArray* Values;
  double Isovalue;
  std::map<std::pair<vtkIdType, vtkIdType>, std::size_t> Vertices;
  std::vector<Vector> Positions;
  std::vector<Vector> Areas;
};

} // namespace

vtkSmartPointer<vtkPolyData> marchingTetrahedra(vtkPolyData* cloud, double isovalue)
{
  Marching marching(cloud, isovalue);
  for (const Tetrahedron& cell : tetrahedra(cloud))
  {
    marching.add(cell);
  }
  return marching.surface();
}

} // namespace accuracy
