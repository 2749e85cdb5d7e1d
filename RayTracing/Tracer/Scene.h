// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef raytracing_Scene_h
#define raytracing_Scene_h

#include "Tracer/Hit.h"
#include "Tracer/Surface.h"

#include <memory>
#include <vector>

namespace raytracing
{

/**
 * All surfaces, in coordinates in which they together are of about unit size around the origin, so
 * that single precision resolves them. Normals and colors are interpolated in the triangles.
 */
class Scene
{
public:
  /// Builds Embree's hierarchy; the surfaces are kept. Those without triangles are allowed.
  /// @throws std::bad_alloc, std::runtime_error
  explicit Scene(std::vector<std::shared_ptr<const Surface>> surfaces);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// The surfaces that a ray sees.
  enum Mask : unsigned int
  {
    Opaque = 1, // no light passes
    Transparent = 2,
    All = Opaque | Transparent
  };

  /// The nearest surface along a ray; from any thread.
  Hit closest(const Ray& ray, Mask mask = All) const;

  /// The share of light in each color that passes along a ray: not through opaque surfaces,
  /// straight through transparent ones, without what these reflect and absorb.
  Color transmittance(const Ray& ray) const;

private:
  struct Parts;

  bool isOccluded(const Ray& ray) const;

  std::unique_ptr<Parts> Content;
};

} // namespace raytracing

#endif
