// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Tracer/Hit.h"
#include "Tracer/Surface.h"

#include <memory>
#include <vector>

namespace raytracing
{

/// All surfaces, scaled to about unit size around the origin, so that single precision suffices.
/// Normals and colors are interpolated within triangles.
class Scene
{
public:
  /// Builds Embree's hierarchy, and keeps the surfaces. They may be empty.
  /// @throws std::bad_alloc, std::runtime_error
  explicit Scene(std::vector<std::shared_ptr<const Surface>> surfaces);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Selects the surfaces that a ray can hit.
  enum Mask : unsigned int
  {
    Opaque = 1, // block all light
    Transparent = 2,
    All = Opaque | Transparent
  };

  /// The nearest surface along a ray. From any thread.
  Hit closest(const Ray& ray, Mask mask = All) const;

  /// The share of light per color that passes along a ray: none through opaque surfaces; straight
  /// through transparent ones, minus reflection and absorption.
  Color transmittance(const Ray& ray) const;

private:
  struct Parts;

  bool isOccluded(const Ray& ray) const;

  std::unique_ptr<Parts> Content;
};

} // namespace raytracing
