// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef raytracing_SplatScene_h
#define raytracing_SplatScene_h

#include "Tracer/Embree.h"
#include "Tracer/Hit.h"
#include "Tracer/Surfaces.h"

#include <memory>
#include <vector>

namespace raytracing
{

/**
 * Surfaces of splats that rays are traced to. A ray meets a surface where vtkIsopointSplatMapper
 * draws it: of all splats along the ray, those up to the blend depth behind the nearest are blended
 * with the same weights. Other than there, splats whose normals are more than 90 degrees from the
 * nearest one's are left out, so that the two sides of a thin wall stay apart.
 *
 * Embree's oriented discs find the candidates; ellipses and clips are tested for each of them.
 */
class SplatScene
{
public:
  /// Builds the hierarchy; the surfaces are kept. Those without splats are allowed.
  /// @throws std::bad_alloc, std::runtime_error
  SplatScene(RTCDevice device, std::vector<std::shared_ptr<const Splats>> surfaces);
  ~SplatScene();
  SplatScene(const SplatScene&) = delete;
  SplatScene& operator=(const SplatScene&) = delete;

  bool isEmpty() const { return this->Geometries.empty(); }

  /// The nearest surface along a ray; from any thread.
  /// @param mask of the surfaces, see embree::masks
  Hit closest(const Ray& ray, const Departure& departure, unsigned int mask) const;

  /// Whether the ray meets any splat.
  bool isOccluded(const Ray& ray, const Departure& departure, unsigned int mask) const;

private:
  struct Query;
  struct Candidates;
  struct Attached;

  static bool covers(const Attached& attached, unsigned int splat, Query& query, const RTCRay& ray);
  static void gather(const RTCFilterFunctionNArguments* arguments);
  static void occlude(const RTCFilterFunctionNArguments* arguments);
  static Hit blended(const Candidates& candidates, const Ray& ray);

  embree::SceneOwner Scene;
  std::vector<std::unique_ptr<Attached>> Geometries;
  float LargestDepth = 0.0f; // of several surfaces, else 0
};

} // namespace raytracing

#endif
