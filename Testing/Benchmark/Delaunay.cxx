// SPDX-License-Identifier: GPL-3.0-or-later
#include "Delaunay.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<vtkIdType, Kernel>;
using CellBase = CGAL::Delaunay_triangulation_cell_base_3<Kernel>;
template <class Concurrency>
using Structure = CGAL::Triangulation_data_structure_3<VertexBase, CellBase, Concurrency>;

using Sequential = CGAL::Delaunay_triangulation_3<Kernel, Structure<CGAL::Sequential_tag>>;
using Parallel = CGAL::Delaunay_triangulation_3<Kernel, Structure<CGAL::Parallel_tag>>;
using Edge = std::pair<vtkIdType, vtkIdType>;
using Site = std::pair<Kernel::Point_3, vtkIdType>;

template <class Triangulation>
std::vector<Edge> crossingEdges(
  const Triangulation& triangulation, vtkDataArray* values, double isovalue)
{
  std::vector<Edge> edges;
  for (const auto cell : triangulation.finite_cell_handles())
  {
    vtkIdType ids[4];
    bool below[4];
    for (int i = 0; i < 4; ++i)
    {
      ids[i] = cell->vertex(i)->info();
      below[i] = values->GetComponent(ids[i], 0) < isovalue;
    }
    for (int i = 0; i < 4; ++i)
    {
      for (int j = i + 1; j < 4; ++j)
      {
        if (below[i] != below[j])
        {
          edges.emplace_back(std::min(ids[i], ids[j]), std::max(ids[i], ids[j]));
        }
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::vector<Site> sitesOf(vtkPolyData* cloud)
{
  const vtkIdType count = cloud->GetNumberOfPoints();
  std::vector<Site> points(static_cast<std::size_t>(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    double p[3];
    cloud->GetPoint(i, p);
    points[static_cast<std::size_t>(i)] = { Kernel::Point_3(p[0], p[1], p[2]), i };
  }
  return points;
}

} // namespace

vtkSmartPointer<vtkPolyData> contourDelaunay(vtkPolyData* cloud, double isovalue, bool parallel)
{
  vtkDataArray* const values = cloud->GetPointData()->GetScalars();
  const std::vector<Site> points = sitesOf(cloud);
  std::vector<Edge> edges;
  if (parallel)
  {
    double b[6];
    cloud->GetBounds(b);
    Parallel::Lock_data_structure locks(CGAL::Bbox_3(b[0], b[2], b[4], b[1], b[3], b[5]), 50);
    const Parallel triangulation(points.begin(), points.end(), &locks);
    edges = crossingEdges(triangulation, values, isovalue);
  }
  else
  {
    const Sequential triangulation(points.begin(), points.end());
    edges = crossingEdges(triangulation, values, isovalue);
  }

  vtkNew<vtkPoints> surface;
  surface->SetDataTypeToDouble();
  for (const Edge& edge : edges)
  {
    double p[3];
    double q[3];
    cloud->GetPoint(edge.first, p);
    cloud->GetPoint(edge.second, q);
    const double a = values->GetComponent(edge.first, 0);
    const double t = (isovalue - a) / (values->GetComponent(edge.second, 0) - a);
    surface->InsertNextPoint(
      p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2]));
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(surface);
  return result;
}

std::vector<Tetrahedron> tetrahedra(vtkPolyData* cloud)
{
  const std::vector<Site> points = sitesOf(cloud);
  const Sequential triangulation(points.begin(), points.end());
  std::vector<Tetrahedron> cells;
  for (const auto cell : triangulation.finite_cell_handles())
  {
    cells.push_back({ cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info(),
      cell->vertex(3)->info() });
  }
  return cells;
}
