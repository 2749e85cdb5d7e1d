// SPDX-License-Identifier: GPL-3.0-or-later
#include "Tracer/Picture.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

namespace raytracing
{

namespace
{

bool isFinite(const Radiance& radiance)
{
  return std::isfinite(radiance.color.x) && std::isfinite(radiance.color.y) &&
         std::isfinite(radiance.color.z) && std::isfinite(radiance.alpha);
}

} // namespace

Ray Camera::through(double x, double y, float& skipped) const
{
  const isopoint::Vector origin = this->nearWindow.at(x, y);
  isopoint::Vector offset = isopoint::operator-(this->farWindow.at(x, y), origin);
  const double length = isopoint::lengthOf(offset);
  // Starts at the unit sphere, which contains the scene.
  double along = -1.0;
  for (std::size_t axis = 0; axis < origin.size(); ++axis)
  {
    offset[axis] /= length;
    along -= origin[axis] * offset[axis];
  }
  const double skip = std::max(along, 0.0);
  skipped = static_cast<float>(skip);
  const auto at = [&](std::size_t axis)
  { return static_cast<float>(origin[axis] + skip * offset[axis]); };
  Ray ray;
  ray.origin = { at(0), at(1), at(2) };
  ray.direction = { static_cast<float>(offset[0]), static_cast<float>(offset[1]),
    static_cast<float>(offset[2]) };
  return ray;
}

Picture::Picture(std::uint32_t width, std::uint32_t height, std::uint32_t samples)
  : Width(width)
  , Height(height)
  , Samples(samples)
  , Sums(static_cast<std::size_t>(width) * height)
  , Distances(this->Sums.size(), std::numeric_limits<float>::infinity())
{
}

void Picture::addSample(
  const Camera& camera, const PathTracer& tracer, std::uint32_t sample, std::size_t row)
{
  for (std::uint32_t x = 0; x < this->Width; ++x)
  {
    const std::size_t index = row * this->Width + x;
    Sum& sum = this->Sums[index];
    if (sum.count > sample)
    {
      continue; // added before an abort
    }
    const Sampler sampler(static_cast<std::uint32_t>(index), sample, this->Samples);
    const Pair place = sampler.pair(0);
    float skipped = 0.0f;
    const Ray ray =
      camera.through((static_cast<double>(x) + static_cast<double>(place.first)) / this->Width,
        (static_cast<double>(row) + static_cast<double>(place.second)) / this->Height, skipped);
    Radiance radiance = tracer.along(ray, sampler);
    if (!isFinite(radiance))
    {
      radiance = {}; // a single one would spoil the pixel
    }
    // Clamped as for display: otherwise one path to a highlight would dominate the pixel.
    sum.color += { std::min(radiance.color.x, 1.0f), std::min(radiance.color.y, 1.0f),
      std::min(radiance.color.z, 1.0f) };
    sum.alpha += radiance.alpha;
    ++sum.count;
  }
}

bool Picture::addSamples(const isopoint::Execution& execution, const Camera& camera,
  const PathTracer& tracer, std::uint32_t samples)
{
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds interval(50);
  const std::uint32_t first = this->Done;
  const std::uint32_t last = std::min(samples, this->Samples);
  const std::thread::id caller = std::this_thread::get_id();
  Clock::time_point asked = Clock::now();
  std::atomic<bool> isAborted{ false };
  for (std::uint32_t sample = first; sample < last; ++sample)
  {
    const auto rows = [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t row = begin; row < end && !isAborted; ++row)
      {
        this->addSample(camera, tracer, sample, row);
        if (std::this_thread::get_id() == caller && Clock::now() >= asked + interval)
        {
          asked = Clock::now();
          const double share = static_cast<double>(row + 1) / this->Height;
          execution.progress((sample - first + share) / (last - first));
          isAborted = execution.isAborted();
        }
      }
    };
    isopoint::forRanges(execution, this->Height, 1, rows);
    if (isAborted)
    {
      return false;
    }
    this->Done = sample + 1;
  }
  return true;
}

void Picture::findDistances(
  const isopoint::Execution& execution, const Camera& camera, const Scene& scene)
{
  const auto rows = [&](std::size_t begin, std::size_t end)
  {
    for (std::size_t index = begin * this->Width; index < end * this->Width; ++index)
    {
      const double column = 0.5 + static_cast<double>(index % this->Width);
      const std::size_t line = index / this->Width;
      const double row = 0.5 + static_cast<double>(line);
      float skipped = 0.0f;
      const Ray ray = camera.through(column / this->Width, row / this->Height, skipped);
      this->Distances[index] = skipped + scene.closest(ray).distance;
    }
  };
  isopoint::forRanges(execution, this->Height, 1, rows);
}

Radiance Picture::pixel(std::size_t index) const
{
  const Sum& sum = this->Sums[index];
  const float weight = sum.count > 0 ? 1.0f / static_cast<float>(sum.count) : 0.0f;
  return { weight * sum.color, weight * sum.alpha };
}

} // namespace raytracing
