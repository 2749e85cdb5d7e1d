// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Tracer/PathTracer.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace raytracing
{

struct Window
{
  isopoint::Vector corner{}; // lower left
  isopoint::Vector right{};  // from there to the lower right corner
  isopoint::Vector up{};     // from there to the upper left corner

  /// The position at window coordinates, 0 to 1 from left to right and from bottom to top.
  isopoint::Vector at(double x, double y) const
  {
    using isopoint::operator+;
    using isopoint::operator*;
    return this->corner + x * this->right + y * this->up;
  }
};

/// The window's rectangles on the near and the far plane; rays pass from the first to the second.
struct Camera
{
  Window nearWindow; // Windows headers define "near" and "far"
  Window farWindow;

  /// The ray through window coordinates, 0 to 1 from left to right and bottom to top, from near the
  /// scene.
  /// @param skipped receives the distance of its origin from the near plane
  Ray through(double x, double y, float& skipped) const;
};

/// A picture refined by samples. Its content depends neither on threads nor on the split into
/// calls.
class Picture
{
public:
  /// @param width, height in pixels, 1 or more
  /// @param samples per pixel in the end, 1 or more
  /// @throws std::bad_alloc
  Picture(std::uint32_t width, std::uint32_t height, std::uint32_t samples);

  /// Adds samples until all pixels have this many. Reports progress and checks for an abort several
  /// times a second. After an abort, a later call continues.
  /// @returns whether all were added
  bool addSamples(const isopoint::Execution& execution, const Camera& camera,
    const PathTracer& tracer, std::uint32_t samples);

  /// Finds the distances from the near plane to the first surface through pixel centers, or
  /// infinity.
  void findDistances(
    const isopoint::Execution& execution, const Camera& camera, const Scene& scene);

  std::uint32_t getWidth() const { return this->Width; }
  std::uint32_t getHeight() const { return this->Height; }

  /// The number of samples that all pixels have.
  std::uint32_t getSamples() const { return this->Done; }

  /// By rows from the bottom.
  Radiance pixel(std::size_t index) const;

  float distance(std::size_t index) const { return this->Distances[index]; }

private:
  struct Sum
  {
    Color color;
    float alpha = 0.0f;
    std::uint32_t count = 0;
  };

  void addSample(
    const Camera& camera, const PathTracer& tracer, std::uint32_t sample, std::size_t row);

  std::uint32_t Width;
  std::uint32_t Height;
  std::uint32_t Samples;
  std::uint32_t Done = 0;
  std::vector<Sum> Sums;
  std::vector<float> Distances;
};

} // namespace raytracing
