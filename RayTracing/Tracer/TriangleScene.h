// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef raytracing_TriangleScene_h
#define raytracing_TriangleScene_h

#include "Tracer/Embree.h"
#include "Tracer/Hit.h"
#include "Tracer/Surfaces.h"

#include <memory>
#include <vector>

namespace raytracing
{

/// Surfaces of triangles that rays are traced to, with interpolated normals and colors.
class TriangleScene
{
public:
  /// Builds the hierarchy; the surfaces are kept. Those without triangles are allowed.
  /// @throws std::bad_alloc, std::runtime_error
  TriangleScene(RTCDevice device, std::vector<std::shared_ptr<const Triangles>> surfaces);

  bool isEmpty() const { return this->Surfaces.empty(); }

  /// The nearest triangle along a ray; from any thread.
  /// @param mask of the surfaces, see embree::masks
  Hit closest(const Ray& ray, unsigned int mask) const;

  /// Whether the ray meets any triangle.
  bool isOccluded(const Ray& ray, unsigned int mask) const;

private:
  embree::SceneOwner Scene;
  std::vector<std::shared_ptr<const Triangles>> Surfaces; // by Embree's ids
};

} // namespace raytracing

#endif
