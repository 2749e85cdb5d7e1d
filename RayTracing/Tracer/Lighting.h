// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Tracer/Sampler.h"
#include "Tracer/Vector.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace raytracing
{

/// A light as VTK defines it, but with an extent.
struct Light
{
  bool isPositional = false;
  Vector position;                    // of a positional light
  Vector towards{ 0.0f, 0.0f, 1.0f }; // unit vector opposite to the light's direction
  Color diffuse{ 1.0f, 1.0f, 1.0f };  // including the intensity
  Color specular{ 1.0f, 1.0f, 1.0f };
  Vector attenuation{ 1.0f, 0.0f, 0.0f }; // constant, linear, quadratic
  float coneCosine = -1.0f;               // of half the angle of a spot light; -1: no spot light
  float exponent = 1.0f;                  // of the cosine within the cone
  float extent = 0.0f; // directional: tangent of half the apparent angle; otherwise its radius
};

/// The light that reaches a position from one point of a light.
struct Illumination
{
  Vector towards;
  float distance = std::numeric_limits<float>::infinity();
  float strength = 0.0f;
};

/// @param place two random numbers that select the point of the light
inline Illumination illuminationOf(const Light& light, const Vector& position, const Pair& place)
{
  const float radius = light.extent * std::sqrt(place.first);
  const float angle = 6.2831853f * place.second;
  Illumination result;
  if (!light.isPositional)
  {
    const Frame frame(light.towards);
    result.towards =
      directionOf(frame.toWorld({ radius * std::cos(angle), radius * std::sin(angle), 1.0f }));
    result.strength = 1.0f;
    return result;
  }
  const Frame frame(directionOf(light.position - position));
  const Vector point =
    light.position + frame.toWorld({ radius * std::cos(angle), radius * std::sin(angle), 0.0f });
  const Vector offset = point - position;
  result.distance = lengthOf(offset);
  result.towards = directionOf(offset, light.towards);
  const float attenuation =
    light.attenuation.x +
    result.distance * (light.attenuation.y + result.distance * light.attenuation.z);
  result.strength = attenuation > 0.0f ? 1.0f / attenuation : 1.0f;
  if (light.coneCosine > -1.0f)
  {
    const float cosine = dot(result.towards, light.towards);
    result.strength *=
      cosine >= light.coneCosine ? std::pow(std::max(cosine, 0.0f), light.exponent) : 0.0f;
  }
  return result;
}

/// An image around or behind the scene.
struct Texture
{
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<Color> pixels; // rows from the bottom

  bool isEmpty() const { return this->pixels.empty(); }

  /// The color at coordinates from 0 to 1, interpolated between pixels.
  Color at(float x, float y) const
  {
    const auto place = [](float coordinate, std::uint32_t size)
    {
      const float last = static_cast<float>(size - 1);
      return std::clamp(coordinate * static_cast<float>(size) - 0.5f, 0.0f, last);
    };
    const float column = place(x, this->width);
    const float row = place(y, this->height);
    const auto left = static_cast<std::uint32_t>(column);
    const auto below = static_cast<std::uint32_t>(row);
    const std::uint32_t right = std::min(left + 1, this->width - 1);
    const std::uint32_t above = std::min(below + 1, this->height - 1);
    const auto pixel = [this](std::uint32_t i, std::uint32_t j)
    { return this->pixels[static_cast<std::size_t>(j) * this->width + i]; };
    const float share = column - static_cast<float>(left);
    return mixed(mixed(pixel(left, below), pixel(right, below), share),
      mixed(pixel(left, above), pixel(right, above), share), row - static_cast<float>(below));
  }
};

/// The surroundings of the scene. Rays from the camera see the background as the window draws it.
/// Reflected and refracted rays see it as a panorama around the camera, mirrored behind the camera
/// and continued above and below, or see an image of all directions, if there is one.
struct Environment
{
  Color bottom;
  Color top;
  Texture background; // instead of the colors
  Texture panorama;   // by longitude and latitude; if empty, the background is used

  // The camera's axes, and the tangents of half the window's angles.
  Vector right{ 1.0f, 0.0f, 0.0f };
  Vector up{ 0.0f, 1.0f, 0.0f };
  Vector ahead{ 0.0f, 0.0f, -1.0f };
  float tangentX = 0.5f;
  float tangentY = 0.5f;

  /// The background at window coordinates, 0 to 1 from left to right and from bottom to top.
  Color behind(float x, float y) const
  {
    return this->background.isEmpty() ? mixed(this->bottom, this->top, std::clamp(y, 0.0f, 1.0f))
                                      : this->background.at(x, y);
  }

  Color towards(const Vector& direction) const
  {
    constexpr float pi = 3.14159265f;
    if (!this->panorama.isEmpty())
    {
      // As VTK maps it: y is up.
      const float longitude = std::atan2(direction.z, direction.x);
      const float latitude = std::asin(std::clamp(direction.y, -1.0f, 1.0f));
      return this->panorama.at(0.5f + 0.5f * longitude / pi, 0.5f + latitude / pi);
    }
    const Vector seen{ dot(direction, this->right), dot(direction, this->up),
      std::abs(dot(direction, this->ahead)) };
    const float level = std::max(std::sqrt(seen.x * seen.x + seen.z * seen.z), 1e-6f);
    const float angle = std::atan2(seen.x, seen.z) / std::atan(this->tangentX);
    return this->behind(0.5f + 0.5f * angle, 0.5f + 0.5f * seen.y / level / this->tangentY);
  }
};

/// Uniform light from all directions, reduced by nearby surfaces.
struct AmbientLight
{
  Color color;
  float distance = 0.0f; // within which surfaces block it; 0: none do
};

} // namespace raytracing
