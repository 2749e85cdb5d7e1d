// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The differences between Embree 3 and 4. CMake sets RAYTRACING_EMBREE_VERSION.
#if RAYTRACING_EMBREE_VERSION >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace raytracing::embree
{

#if RAYTRACING_EMBREE_VERSION >= 4
using Context = RTCRayQueryContext;

inline void initialize(Context& context)
{
  rtcInitRayQueryContext(&context);
}

inline void intersect(RTCScene scene, Context& context, RTCRayHit& ray)
{
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  rtcIntersect1(scene, &ray, &arguments);
}

inline void occlude(RTCScene scene, Context& context, RTCRay& ray)
{
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  rtcOccluded1(scene, &ray, &arguments);
}
#else
using Context = RTCIntersectContext;

inline void initialize(Context& context)
{
  rtcInitIntersectContext(&context);
}

inline void intersect(RTCScene scene, Context& context, RTCRayHit& ray)
{
  rtcIntersect1(scene, &context, &ray);
}

inline void occlude(RTCScene scene, Context& context, RTCRay& ray)
{
  rtcOccluded1(scene, &context, &ray);
}
#endif

/// Throws the last error of a device, if any.
/// @throws std::bad_alloc, std::runtime_error
inline void check(RTCDevice device)
{
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_OUT_OF_MEMORY)
  {
    throw std::bad_alloc();
  }
  if (error != RTC_ERROR_NONE)
  {
    throw std::runtime_error("Embree reports error " + std::to_string(static_cast<int>(error)));
  }
}

/// Releases an Embree handle by rtcRelease...
template <auto Release>
struct Releaser
{
  template <class Handle>
  void operator()(Handle* handle) const
  {
    Release(handle);
  }
};

using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Releaser<rtcReleaseDevice>>;
using SceneOwner = std::unique_ptr<std::remove_pointer_t<RTCScene>, Releaser<rtcReleaseScene>>;
using Geometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, Releaser<rtcReleaseGeometry>>;

} // namespace raytracing::embree
