// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef raytracing_Picture_h
#define raytracing_Picture_h

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Tracer/PathTracer.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace raytracing
{

/// A rectangle in a scene.
struct Window
{
  isopoint::Vector corner{}; // the lower left one
  isopoint::Vector right{};  // from there to the lower right one
  isopoint::Vector up{};     // from there to the upper left one

  /// A place on it, 0 to 1 from left to right and from bottom to top.
  isopoint::Vector at(double x, double y) const
  {
    return isopoint::sum(isopoint::sum(this->corner, x, this->right), y, this->up);
  }
};

/// Where the rays of a picture begin, and where they pass: what the window shows of the near and of
/// the far plane.
struct Camera
{
  Window nearWindow; // not "near" and "far": headers of Windows define these
  Window farWindow;

  /// The ray through a place of the window, 0 to 1 from left to right and from bottom to top. It
  /// begins where it comes near the scene.
  /// @param skipped the distance of its origin from the near plane
  Ray through(double x, double y, float& skipped) const;
};

/**
 * A picture that gets better with each sample of its pixels. Its content depends neither on threads
 * nor on how the samples are divided among calls.
 */
class Picture
{
public:
  /// @param width, height in pixels, 1 or more
  /// @param samples of each pixel in the end, 1 or more
  /// @throws std::bad_alloc
  Picture(std::uint32_t width, std::uint32_t height, std::uint32_t samples);

  /// Adds samples, until all pixels have this many. Progress is reported, and an abort asked for,
  /// several times a second. An abort ends the call at once, and a later one goes on.
  /// @returns whether all were added
  bool addSamples(const isopoint::Execution& execution, const Camera& camera,
    const PathTracer& tracer, std::uint32_t samples);

  /// Finds the distance from the near plane at which rays through the pixels' centers meet the
  /// first surface; infinity where they meet none.
  void findDistances(
    const isopoint::Execution& execution, const Camera& camera, const Scene& scene);

  std::uint32_t getWidth() const { return this->Width; }
  std::uint32_t getHeight() const { return this->Height; }

  /// How many samples all pixels have.
  std::uint32_t getSamples() const { return this->Done; }

  /// Color times coverage, and coverage, by rows from the bottom.
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

#endif
