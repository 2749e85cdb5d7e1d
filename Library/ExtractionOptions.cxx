// SPDX-License-Identifier: GPL-3.0-or-later
#include "Library/ExtractionOptions.h"

#include "Core/Failure.h"
#include "Library/VersionedOptions.h"

#include <cctype>
#include <cstddef>
#include <type_traits>

namespace isopoint
{
namespace
{

static_assert( // see takeOptions()
  sizeof(isopoint_options) == offsetof(isopoint_options, minimum_piece_size) + sizeof(double));
static_assert(
  haveSameNumbers({ FitOrder::Linear, FitOrder::Quadratic, FitOrder::Cubic, FitOrder::Crease },
    { ISOPOINT_PROJECTION_LINEAR, ISOPOINT_PROJECTION_QUADRATIC, ISOPOINT_PROJECTION_CUBIC,
      ISOPOINT_PROJECTION_CREASE }));
static_assert(
  haveSameNumbers({ NormalMethod::Automatic, NormalMethod::Field, NormalMethod::Planes },
    { ISOPOINT_NORMALS_AUTOMATIC, ISOPOINT_NORMALS_FROM_FIELD, ISOPOINT_NORMALS_FROM_PLANES }));
static_assert(haveSameNumbers({ Precision::Single, Precision::Double, Precision::Default },
  { ISOPOINT_PRECISION_SINGLE, ISOPOINT_PRECISION_DOUBLE, ISOPOINT_PRECISION_INPUT }));

/// Calls visit(name, member of isopoint_options, member of Options) for each option.
template <class Visitor>
void forEachMember(const Visitor& visit)
{
  using C = isopoint_options;
  using Core = Options;
  visit("triangles", &C::triangles, &Core::triangles);
  visit("projection", &C::projection, &Core::projection);
  visit("normal_method", &C::normal_method, &Core::normalMethod);
  visit("drop_gaps", &C::drop_gaps, &Core::dropGaps);
  visit("compute_normals", &C::compute_normals, &Core::computeNormals);
  visit("compute_gradients", &C::compute_gradients, &Core::computeGradients);
  visit("compute_projection_orders", &C::compute_projection_orders, &Core::computeProjectionOrders);
  visit("output_points_precision", &C::output_points_precision, &Core::outputPointsPrecision);
  visit("number_of_neighbors", &C::number_of_neighbors, &Core::numberOfNeighbors);
  visit("compute_splats", &C::compute_splats, &Core::computeSplats);
  visit("angle", &C::angle, &Core::angle);
  visit("keep_tetrahedra", &C::keep_tetrahedra, &Core::keepTetrahedra);
  visit("regularize", &C::regularize, &Core::regularize);
  visit("keep_hull_slivers", &C::keep_hull_slivers, &Core::keepHullSlivers);
  visit("capping", &C::capping, &Core::capping);
  visit("minimum_piece_size", &C::minimum_piece_size, &Core::minimumPieceSize);
}

} // namespace

std::string memberName(const char* name)
{
  std::string member;
  for (; *name != '\0'; ++name)
  {
    const auto character = static_cast<unsigned char>(*name);
    if (std::isupper(character) && !member.empty())
    {
      member += '_';
    }
    member += static_cast<char>(std::tolower(character));
  }
  return member;
}

Options optionsFrom(const isopoint_options* given)
{
  isopoint_options all;
  isopoint_initialize_options(&all, sizeof(all));
  if (given)
  {
    constexpr std::size_t sizeOf1_0 = 80;
    takeOptions(*given, sizeOf1_0, "isopoint_initialize_options()", all);
  }
  Options options;
  forEachMember(
    [&](const char* name, auto member, auto option)
    {
      using T = std::decay_t<decltype(options.*option)>;
      options.*option = static_cast<T>(all.*member);
      if constexpr (std::is_same_v<T, bool>)
      {
        if (all.*member != 0 && all.*member != 1)
        {
          throw UsageError(std::string(name) + " is " + std::to_string(all.*member) +
                             ". Use 0 for off and 1 for on.",
            UsageError::Option);
        }
      }
    });
  checkOptions(options, memberName);
  return effectiveOptions(options);
}

} // namespace isopoint

void isopoint_initialize_options(isopoint_options* options, size_t size)
{
  isopoint_options all{};
  all.size = size;
  const isopoint::Options defaults;
  isopoint::forEachMember([&](const char*, auto member, auto option)
    { all.*member = static_cast<std::decay_t<decltype(all.*member)>>(defaults.*option); });
  isopoint::giveOptions(all, options, size);
}
