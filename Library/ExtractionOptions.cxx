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

// Programs may leave padding unset, and later versions could put members there.
static_assert(
  sizeof(isopoint_options) == offsetof(isopoint_options, minimum_piece_size) + sizeof(double));

/// Calls visit(member of isopoint_options, member of Options) for each option.
template <class Visitor>
void forEachMember(const Visitor& visit)
{
  using C = isopoint_options;
  using Core = Options;
  visit(&C::triangles, &Core::triangles);
  visit(&C::projection, &Core::projection);
  visit(&C::normal_method, &Core::normalMethod);
  visit(&C::drop_gaps, &Core::dropGaps);
  visit(&C::compute_normals, &Core::computeNormals);
  visit(&C::compute_gradients, &Core::computeGradients);
  visit(&C::compute_projection_orders, &Core::computeProjectionOrders);
  visit(&C::output_points_precision, &Core::outputPointsPrecision);
  visit(&C::number_of_neighbors, &Core::numberOfNeighbors);
  visit(&C::compute_splats, &Core::computeSplats);
  visit(&C::angle, &Core::angle);
  visit(&C::keep_tetrahedra, &Core::keepTetrahedra);
  visit(&C::regularize, &Core::regularize);
  visit(&C::keep_hull_slivers, &Core::keepHullSlivers);
  visit(&C::capping, &Core::capping);
  visit(&C::minimum_piece_size, &Core::minimumPieceSize);
}

/// The name of an option that is on or off.
std::string switchName(bool Options::*value)
{
  std::string name =
    value == &Options::triangles ? "triangles" : "keep_tetrahedra"; // of no property
  forEveryOption(
    [&](const auto& option)
    {
      if constexpr (std::is_same_v<decltype(option.value), bool Options::*>)
      {
        name = option.value == value ? memberName(option.name) : name;
      }
    });
  return name;
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
    [&](auto member, auto option)
    {
      using T = std::decay_t<decltype(options.*option)>;
      options.*option = static_cast<T>(all.*member);
      if constexpr (std::is_same_v<T, bool>)
      {
        if (all.*member != 0 && all.*member != 1)
        {
          throw UsageError(switchName(option) + " is " + std::to_string(all.*member) +
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
  isopoint::forEachMember([&](auto member, auto option)
    { all.*member = static_cast<std::decay_t<decltype(all.*member)>>(defaults.*option); });
  isopoint::giveOptions(all, options, size);
}
