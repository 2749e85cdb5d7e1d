// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Library/isopoint.h"

#include "Core/Base/Execution.h"
#include "Core/Options.h"
#include "Core/Report.h"
#include "Core/SplatMesh/SplatMesh.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

/// The result of an extraction as arrays.
struct isopoint_surface
{
  /// Single or double precision.
  using Coordinates = std::variant<std::vector<float>, std::vector<double>>;

  /// @param surfaces of all isovalues
  /// @param chosen effective options
  /// @throws std::bad_alloc
  isopoint_surface(const isopoint::Execution& making,
    std::vector<isopoint::ExtractedIsosurface> surfaces, const isopoint::Options& chosen,
    bool areFloatPositions, const isopoint::Report& report, std::size_t samples);

  /// See isopoint_create_surface(). @throws isopoint::UsageError, std::bad_alloc
  isopoint_surface(const isopoint::Execution& making, const isopoint_array* points,
    const isopoint_array* normals, const isopoint_array* axes, const isopoint_array* polygons);

  /// See isopoint_get_array(). @throws isopoint::UsageError, std::bad_alloc
  isopoint_array array(std::int32_t id) const;

  /// See isopoint_interpolate(). @throws isopoint::UsageError, isopoint::Aborted, std::bad_alloc
  void interpolate(const isopoint_array* ofSamples, void* result, std::size_t size) const;

  /// See isopoint_make_splat_mesh(). @throws as interpolate()
  void makeSplatMesh(double scale);

  /// See isopoint_average_at_splat_vertices(). @throws as interpolate()
  void averageAtSplatVertices(const isopoint_array* ofPoints, void* result, std::size_t size) const;

  isopoint::Execution execution; // of all calls on this surface
  isopoint::Options options;     // effective ones
  bool isExtracted = false;      // rather than made of arrays
  std::vector<isopoint::Message> messages;
  isopoint::Report report;

private:
  std::size_t pointCount() const;
  void listEdges() const;
  bool hasFloatPoints() const { return std::holds_alternative<std::vector<float>>(this->Points); }

  struct SplatArrays
  {
    SplatArrays(const isopoint::Execution& execution, isopoint::SplatMesh made, bool areFloat);

    isopoint::SplatMesh mesh;
    Coordinates vertices;
    std::vector<float> normals;
    std::vector<std::int64_t> points;
    std::vector<std::int64_t> triangles;
  };

  std::size_t SampleCount = 0;                            // including skipped ones
  std::vector<isopoint::ExtractedIsosurface> Isosurfaces; // their edges and coincident samples
  Coordinates Points;
  std::vector<double> Isovalues;
  std::vector<float> Normals;
  std::vector<float> Gradients;
  std::vector<std::uint8_t> ProjectionOrders;
  std::vector<std::int64_t> Triangles;
  std::vector<std::uint8_t> Caps;
  std::vector<float> Radii;
  std::vector<float> SplatAxes;
  std::vector<float> SplatPolygons;

  // Of the isosurfaces above; empty until array() is asked for one of them.
  mutable std::vector<std::int64_t> Edges;
  mutable std::vector<double> EdgeParameters;

  std::optional<SplatArrays> Splats; // after makeSplatMesh()
};
