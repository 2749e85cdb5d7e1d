// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Clouds.h"

/// Results as text to compare, without members of structures that are not set.
namespace ranks
{

using Extracted = isopoint::ExtractedIsosurface;

/// All that is known of one isopoint, as text to compare: every number by its bits.
inline std::string described(const Extracted& extracted, std::size_t i)
{
  std::string text;
  const auto put = [&text](const auto&... values)
  { (text.append(reinterpret_cast<const char*>(&values), sizeof(values)), ...); };
  const isopoint::Isosurface& surface = extracted.surface;
  put(surface.positions[i], surface.decreasingEdges[i]);
  for (std::size_t k = surface.edgeBegin(i); k < surface.edgeBegin(i + 1); ++k)
  {
    const isopoint::IsopointEdge& edge = surface.edges[k];
    put(edge.first, edge.second, edge.parameter);
    for (const std::uint64_t id : { edge.first, edge.second })
    {
      if (const isopoint::CoincidentSamples* const group = surface.coincidentAt(id))
      {
        text.append("coincident");
        std::for_each(group->ids.begin(), group->ids.end(), put);
      }
    }
  }
  if (!surface.fits.empty())
  {
    const isopoint::LocalFit& fit = surface.fits[i];
    put(fit.position, fit.gradient, fit.isGradientFitted, fit.hessian, fit.isSmooth, fit.spacing,
      fit.order ? static_cast<int>(*fit.order) : 0);
    for (const isopoint::CreasePlane& plane : fit.creases)
    {
      put(plane.inward, plane.distance, plane.turn);
    }
  }
  if (!extracted.splats.empty())
  {
    const isopoint::Splat& splat = extracted.splats[i];
    put(splat.normal, splat.radius, splat.axis, splat.corners);
  }
  if (!extracted.normals.empty())
  {
    put(extracted.normals[i]);
  }
  return text;
}

using Description = std::vector<std::string>;

inline Description described(const Extracted& extracted)
{
  Description all;
  for (std::size_t i = 0; i < extracted.surface.size(); ++i)
  {
    all.push_back(described(extracted, i));
  }
  return all;
}

/// Each triangle by all that is known of it and its vertices, in order.
inline Description describedTriangles(const Extracted& extracted)
{
  const Description vertices = described(extracted);
  Description all;
  for (const auto& [a, b, c] : extracted.triangles)
  {
    const bool isCap = !extracted.areCaps.empty() && extracted.areCaps[all.size()] != 0;
    all.push_back(vertices[a] + vertices[b] + vertices[c] + (isCap ? "cap" : ""));
  }
  return all;
}

} // namespace ranks
