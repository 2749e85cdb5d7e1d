// SPDX-License-Identifier: GPL-3.0-or-later
#include "Tracer/Picture.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>

namespace raytracing
{

namespace
{

/// Calls a task for each of a number of items, on several threads or as many as the system grants.
/// @param goesOn called from the calling thread between its items; false ends the work early
/// @returns whether all was done
/// @throws what the task and goesOn throw
bool forEach(std::size_t count, std::size_t threads, const std::function<void(std::size_t)>& task,
  const std::function<bool(double)>& goesOn)
{
  std::atomic<std::size_t> next{ 0 };
  std::atomic<bool> isStopped{ false };
  std::exception_ptr failure;
  std::mutex mutex;
  const auto work = [&](const std::function<bool(double)>& mayGoOn)
  {
    try
    {
      for (std::size_t item = next++; item < count && !isStopped; item = next++)
      {
        task(item);
        if (!mayGoOn(static_cast<double>(item + 1) / static_cast<double>(count)))
        {
          isStopped = true;
        }
      }
    }
    catch (...)
    {
      const std::lock_guard<std::mutex> lock(mutex);
      failure = std::current_exception();
      isStopped = true;
    }
  };
  std::vector<std::thread> workers;
  try
  {
    workers.reserve(threads);
    while (workers.size() + 1 < std::min(threads, count))
    {
      workers.emplace_back(work, [](double) { return true; });
    }
  }
  catch (const std::system_error&)
  {
    // The system grants no more threads: those that were started do the work.
  }
  catch (const std::bad_alloc&)
  {
    // The same for a lack of memory.
  }
  work(goesOn);
  for (std::thread& worker : workers)
  {
    worker.join();
  }
  if (failure)
  {
    std::rethrow_exception(failure);
  }
  return !isStopped;
}

bool isFinite(const Radiance& radiance)
{
  return std::isfinite(radiance.color.x) && std::isfinite(radiance.color.y) &&
         std::isfinite(radiance.color.z) && std::isfinite(radiance.alpha);
}

} // namespace

//------------------------------------------------------------------------------
Ray Camera::through(double x, double y, float& skipped) const
{
  Position origin;
  Position offset;
  double length = 0.0;
  for (std::size_t axis = 0; axis < origin.size(); ++axis)
  {
    origin[axis] = this->nearCorner[axis] + x * this->nearRight[axis] + y * this->nearUp[axis];
    offset[axis] =
      this->farCorner[axis] + x * this->farRight[axis] + y * this->farUp[axis] - origin[axis];
    length = std::hypot(length, offset[axis]);
  }
  // The scene lies within a unit sphere around the origin: before that nothing is met.
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

//------------------------------------------------------------------------------
Picture::Picture(std::uint32_t width, std::uint32_t height, std::uint32_t samples)
  : Width(width)
  , Height(height)
  , Samples(samples)
  , Sums(static_cast<std::size_t>(width) * height)
  , Distances(this->Sums.size(), std::numeric_limits<float>::infinity())
{
}

//------------------------------------------------------------------------------
bool Picture::addSamples(const Camera& camera, const PathTracer& tracer, std::uint32_t samples,
  std::size_t threads, const std::function<bool(double share)>& goesOn)
{
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds interval(50);
  const std::uint32_t first = this->Done;
  const std::uint32_t last = std::min(samples, this->Samples);
  Clock::time_point asked = Clock::now();
  for (std::uint32_t sample = first; sample < last; ++sample)
  {
    const auto row = [&](std::size_t y)
    {
      for (std::uint32_t x = 0; x < this->Width; ++x)
      {
        const std::size_t index = y * this->Width + x;
        Sum& sum = this->Sums[index];
        if (sum.count > sample)
        {
          continue; // has been added by a call that was ended
        }
        const Sampler sampler(static_cast<std::uint32_t>(index), sample, this->Samples);
        const Pair place = sampler.pair(0);
        float skipped = 0.0f;
        const Ray ray =
          camera.through((static_cast<double>(x) + static_cast<double>(place.first)) / this->Width,
            (static_cast<double>(y) + static_cast<double>(place.second)) / this->Height, skipped);
        Radiance radiance = tracer.along(ray, sampler);
        if (!isFinite(radiance))
        {
          radiance = {}; // one such path would spoil the pixel
        }
        // As it is displayed: one path to a light's highlight would outshine all others of a pixel.
        sum.color += { std::min(radiance.color.x, 1.0f), std::min(radiance.color.y, 1.0f),
          std::min(radiance.color.z, 1.0f) };
        sum.alpha += radiance.alpha;
        ++sum.count;
      }
    };
    const auto rowDone = [&](double share)
    {
      if (Clock::now() < asked + interval)
      {
        return true;
      }
      asked = Clock::now();
      return goesOn((sample - first + share) / (last - first));
    };
    if (!forEach(this->Height, threads, row, rowDone))
    {
      return false;
    }
    this->Done = sample + 1;
  }
  return true;
}

//------------------------------------------------------------------------------
void Picture::findDistances(const Camera& camera, const Scene& scene, std::size_t threads)
{
  constexpr double half = 0.5;
  const auto row = [&](std::size_t y)
  {
    for (std::uint32_t x = 0; x < this->Width; ++x)
    {
      float skipped = 0.0f;
      const Ray ray = camera.through(
        (x + half) / this->Width, (static_cast<double>(y) + half) / this->Height, skipped);
      const Hit hit = scene.closest(ray);
      this->Distances[y * this->Width + x] = skipped + hit.distance;
    }
  };
  forEach(this->Height, threads, row, [](double) { return true; });
}

//------------------------------------------------------------------------------
Radiance Picture::pixel(std::size_t index) const
{
  const Sum& sum = this->Sums[index];
  const float weight = sum.count > 0 ? 1.0f / static_cast<float>(sum.count) : 0.0f;
  return { weight * sum.color, weight * sum.alpha };
}

} // namespace raytracing
