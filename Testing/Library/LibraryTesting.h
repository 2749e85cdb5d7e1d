// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "isopoint.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#ifndef _WIN32
#include <sys/wait.h>
#include <unistd.h>
#endif

/// Shared by the tests of the C library.
namespace librarytesting
{

using Surface = std::unique_ptr<isopoint_surface, decltype(&isopoint_destroy_surface)>;

template <class T>
isopoint_array arrayOf(const std::vector<T>& numbers, isopoint_type type, int components)
{
  const auto count = static_cast<std::int64_t>(numbers.size()) / components;
  return { numbers.data(), type, components, count, 0, 0 };
}

/// Random samples of the distance from the center of a cube.
struct Cloud
{
  std::vector<double> positions;
  std::vector<double> values;

  explicit Cloud(std::size_t count = 5000)
  {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> anywhere(-1.0, 1.0);
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::array<double, 3> p{ anywhere(random), anywhere(random), anywhere(random) };
      this->positions.insert(this->positions.end(), p.begin(), p.end());
      this->values.push_back(std::hypot(p[0], p[1], p[2]));
    }
  }

  isopoint_array positionArray() const { return arrayOf(this->positions, ISOPOINT_DOUBLE, 3); }
  isopoint_array valueArray() const { return arrayOf(this->values, ISOPOINT_DOUBLE, 1); }

  isopoint_status load(
    isopoint_extractor* extractor, const std::vector<std::uint8_t>& excluded = {}) const
  {
    const isopoint_array places = this->positionArray();
    const isopoint_array numbers = this->valueArray();
    const isopoint_array flags = arrayOf(excluded, ISOPOINT_UINT8, 1);
    return isopoint_set_samples(extractor, &places, &numbers, excluded.empty() ? nullptr : &flags);
  }
};

/// The default options after a change.
template <class Change>
isopoint_options optionsWith(const Change& change)
{
  isopoint_options options;
  isopoint_initialize_options(&options, sizeof(options));
  change(options);
  return options;
}

inline const isopoint_options defaults = optionsWith([](isopoint_options&) {});
inline const isopoint_options withTriangles =
  optionsWith([](isopoint_options& options) { options.triangles = 1; });

class Extractor
{
public:
  Extractor() = default;
  explicit Extractor(const Cloud& cloud) { EXPECT_EQ(cloud.load(this->get()), ISOPOINT_OK); }

  isopoint_extractor* get() const { return this->Handle.get(); }

  Surface extract(const std::vector<double>& isovalues = { 0.7 },
    const isopoint_options& options = defaults) const
  {
    isopoint_surface* surface = nullptr;
    EXPECT_EQ(isopoint_extract(this->get(), isovalues.data(),
                static_cast<std::int64_t>(isovalues.size()), &options, &surface),
      ISOPOINT_OK)
      << isopoint_get_error();
    return { surface, isopoint_destroy_surface };
  }

private:
  std::unique_ptr<isopoint_extractor, decltype(&isopoint_destroy_extractor)> Handle{
    isopoint_create_extractor(), isopoint_destroy_extractor
  };
};

inline isopoint_array arrayOf(const Surface& surface, std::int32_t id)
{
  isopoint_array array;
  EXPECT_EQ(isopoint_get_array(surface.get(), id, &array), ISOPOINT_OK);
  return array;
}

template <class T>
isopoint_status interpolate(
  const Surface& surface, const isopoint_array& ofSamples, std::vector<T>& result)
{
  return isopoint_interpolate(surface.get(), &ofSamples, result.data(), sizeof(T) * result.size());
}

template <class T>
isopoint_status average(
  const Surface& surface, const isopoint_array& ofPoints, std::vector<T>& result)
{
  return isopoint_average_at_splat_vertices(
    surface.get(), &ofPoints, result.data(), sizeof(T) * result.size());
}

/// Memory for the results of one array.
template <class T>
isopoint_probe_result resultIn(std::vector<T>& values)
{
  return { values.data(), sizeof(T) * values.size(), nullptr, 0 };
}
template <class T>
isopoint_probe_result resultIn(std::vector<T>& values, std::vector<double>& gradients)
{
  return { values.data(), sizeof(T) * values.size(), gradients.data(),
    sizeof(double) * gradients.size() };
}

/// The numbers of an array of a surface.
template <class T>
std::vector<T> numbersOf(const Surface& surface, isopoint_array_id id)
{
  const isopoint_array array = arrayOf(surface, id);
  const T* const data = static_cast<const T*>(array.data);
  return array.data ? std::vector<T>(data, data + array.count * array.components)
                    : std::vector<T>();
}

/// The bytes of all arrays of a surface.
inline std::string bytesOf(const Surface& surface)
{
  std::string bytes;
  for (std::int32_t id = ISOPOINT_ARRAY_POINTS; id <= ISOPOINT_ARRAY_CAPS; ++id)
  {
    const isopoint_array array = arrayOf(surface, id);
    constexpr std::array<std::size_t, 10> sizes{ 4, 8, 1, 1, 2, 2, 4, 4, 8, 8 };
    const std::size_t size = static_cast<std::size_t>(array.count * array.components) *
                             sizes.at(static_cast<std::size_t>(array.type));
    bytes += std::to_string(size) + ":";
    bytes.append(static_cast<const char*>(array.data), size);
  }
  return bytes;
}

inline void expectContains(const std::string& text, const std::string& part)
{
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

#ifndef _WIN32
/// Expects that something holds in a forked process, which must not wait for ever.
inline void expectInFork(const std::function<bool()>& holds)
{
  const pid_t process = fork();
  if (process == 0)
  {
    alarm(60);
    _exit(holds() ? 0 : 1);
  }
  int status = 0;
  waitpid(process, &status, 0);
  EXPECT_EQ(status, 0);
}
#endif

/// Expects an error of a kind that names a word.
inline void expectInvalid(isopoint_status status, const std::string& word = "",
  isopoint_status kind = ISOPOINT_INVALID_ARGUMENT)
{
  EXPECT_EQ(status, kind) << word;
  EXPECT_STRNE(isopoint_get_error(), "");
  expectContains(isopoint_get_error(), word);
}

struct Observed
{
  std::thread::id caller = std::this_thread::get_id();
  std::vector<double> fractions;
  int cancelAfter = -1;
  int asked = 0;
  bool isOnCaller = true;
};

inline void observe(void* user, double fraction)
{
  auto* const observed = static_cast<Observed*>(user);
  observed->fractions.push_back(fraction);
  observed->isOnCaller &= std::this_thread::get_id() == observed->caller;
}

inline int isCanceled(void* user)
{
  auto* const observed = static_cast<Observed*>(user);
  observed->isOnCaller &= std::this_thread::get_id() == observed->caller;
  return observed->asked++ == observed->cancelAfter ? 1 : 0;
}

/// The arrays of isopoints that isopoint_create_surface() takes.
struct KeptSplats
{
  std::vector<double> points;
  std::vector<float> normals;
  std::vector<float> axes;
  std::vector<float> polygons;

  explicit KeptSplats(const Surface& surface)
    : points(numbersOf<double>(surface, ISOPOINT_ARRAY_POINTS))
    , normals(numbersOf<float>(surface, ISOPOINT_ARRAY_NORMALS))
    , axes(numbersOf<float>(surface, ISOPOINT_ARRAY_SPLAT_AXES))
    , polygons(numbersOf<float>(surface, ISOPOINT_ARRAY_SPLAT_POLYGONS))
  {
  }

  isopoint_status create(isopoint_surface** surface, int components = 3) const
  {
    const isopoint_array places = arrayOf(this->points, ISOPOINT_DOUBLE, 3);
    const isopoint_array directions = arrayOf(this->normals, ISOPOINT_FLOAT, components);
    const isopoint_array along = arrayOf(this->axes, ISOPOINT_FLOAT, 3);
    const isopoint_array shapes = arrayOf(this->polygons, ISOPOINT_FLOAT, 40);
    return isopoint_create_surface(&places, &directions, &along, &shapes, surface);
  }

  /// A surface with the mesh of the splats.
  Surface mesh(double scale) const
  {
    isopoint_surface* created = nullptr;
    EXPECT_EQ(this->create(&created), ISOPOINT_OK) << isopoint_get_error();
    EXPECT_EQ(isopoint_make_splat_mesh(created, scale), ISOPOINT_OK) << isopoint_get_error();
    return { created, isopoint_destroy_surface };
  }
};

} // namespace librarytesting
