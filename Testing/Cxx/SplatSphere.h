// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SplatSphere_h
#define SplatSphere_h

#include "Tracer/Surfaces.h"

#include <cmath>
#include <cstddef>
#include <memory>

/// Splats that cover a sphere around the origin about six times, evenly spread.
inline std::shared_ptr<raytracing::Splats> splatSphere(std::size_t count, float sphereRadius)
{
  auto splats = std::make_shared<raytracing::Splats>();
  const double goldenAngle = 3.14159265358979 * (3.0 - std::sqrt(5.0));
  const float radius = 2.0f * sphereRadius * std::sqrt(6.0f / static_cast<float>(count));
  for (std::size_t i = 0; i < count; ++i)
  {
    const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
    const double across = std::sqrt(1.0 - z * z);
    const double angle = goldenAngle * static_cast<double>(i);
    const raytracing::Vector normal{ static_cast<float>(across * std::cos(angle)),
      static_cast<float>(across * std::sin(angle)), static_cast<float>(z) };
    splats->discs.push_back({ sphereRadius * normal, radius });
    splats->planes.push_back(normal);
  }
  return splats;
}

#endif
