// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef raytracing_Scene_h
#define raytracing_Scene_h

#include "Tracer/Hit.h"
#include "Tracer/Surfaces.h"

#include <memory>
#include <vector>

namespace raytracing
{

/**
 * All surfaces, in coordinates in which they together are of about unit size around the origin, so
 * that single precision resolves them.
 */
class Scene
{
public:
  /// @throws std::bad_alloc, std::runtime_error
  Scene(std::vector<std::shared_ptr<const Splats>> splats,
    std::vector<std::shared_ptr<const Triangles>> triangles);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// The nearest surface along a ray; from any thread.
  Hit closest(const Ray& ray, const Departure& departure) const;

  /// The share of light in each color that passes along a ray: not through opaque surfaces,
  /// straight through transparent ones, without what these reflect and absorb.
  Color transmittance(const Ray& ray, const Departure& departure) const;

private:
  struct Parts;

  Hit closest(const Ray& ray, const Departure& departure, unsigned int mask) const;

  std::unique_ptr<Parts> Content;
};

} // namespace raytracing

#endif
