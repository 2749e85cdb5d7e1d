// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Triangles/CreaseMesh.h"

#include <utility>

namespace isopoint
{

CreaseSurface::CreaseSurface(Isosurface& vertices)
  : surface(vertices)
{
  this->normals.reserve(vertices.size());
  for (const LocalFit& fit : vertices.fits)
  {
    this->normals.push_back(scaled(-1.0, directionOf(fit.gradient)));
  }
}

Vector CreaseSurface::normalOf(std::initializer_list<std::size_t> vertices) const
{
  Vector all{};
  for (const std::size_t vertex : vertices)
  {
    all = sum(all, 1.0, this->normals[vertex]);
  }
  return directionOf(all);
}

std::size_t CreaseSurface::addVertex(
  std::size_t like, const Vector& place, std::initializer_list<std::size_t> around)
{
  double slope = 0.0;
  for (const std::size_t each : around)
  {
    slope += lengthOf(this->fitOf(each).gradient) / static_cast<double>(around.size());
  }
  return this->addVertex(like, place, this->normalOf(around), slope);
}

std::size_t CreaseSurface::addVertex(
  std::size_t like, const Vector& place, const Vector& normal, double slope)
{
  const std::size_t vertex = this->surface.size();
  LocalFit fit = this->surface.fits[like];
  fit.position = place;
  fit.gradient = scaled(-slope, normal);
  fit.hessian = {};
  fit.isSmooth = false;
  fit.order = FitOrder::Crease;
  fit.creases.clear();
  this->surface.edges.emplace_back(this->surface.edges[like]);
  this->surface.positions.push_back(place);
  this->surface.decreasingEdges.emplace_back(this->surface.decreasingEdges[like]);
  this->surface.leaves.emplace_back(this->surface.leaves[like]);
  this->surface.fits.push_back(std::move(fit));
  this->normals.push_back(normal);
  this->isInner.push_back(true);
  return vertex;
}

} // namespace isopoint
