// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointMeetingCorners.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace
{

/// A corner with its place along a line.
struct Projected
{
  double Along;
  vtkIdType Corner;

  bool operator<(const Projected& other) const
  {
    return this->Along != other.Along ? this->Along < other.Along : this->Corner < other.Corner;
  }
};

/// The direction of the line is askew to lattices of all kinds, so that few corners that are apart
/// are close together along the line.
double project(const vtkVector3d& place)
{
  return 0.5227 * place[0] + 0.6180 * place[1] + 0.5871 * place[2];
}

bool areOne(const vtkIsopointCorner& a, const vtkIsopointCorner& b)
{
  constexpr float turn = 1e-3f;
  const double tolerance = std::min(a.Tolerance, b.Tolerance);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (std::abs(a.Place[axis] - b.Place[axis]) > tolerance ||
        std::abs(a.Normal[axis] - b.Normal[axis]) > turn)
    {
      return false;
    }
  }
  return true;
}

} // namespace

//------------------------------------------------------------------------------
std::vector<vtkIdType> vtkIsopointMeetingCorners(const std::vector<vtkIsopointCorner>& corners)
{
  std::vector<Projected> sorted;
  sorted.reserve(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    if (corners[i].Tolerance > 0.0f)
    {
      sorted.push_back({ project(corners[i].Place), static_cast<vtkIdType>(i) });
    }
  }
  vtkSMPTools::Sort(sorted.begin(), sorted.end());

  std::vector<vtkIdType> meetsAt(corners.size());
  std::iota(meetsAt.begin(), meetsAt.end(), 0);
  for (std::size_t i = 0; i < sorted.size(); ++i)
  {
    const auto own = static_cast<std::size_t>(sorted[i].Corner);
    const double end = sorted[i].Along + 2.0 * corners[own].Tolerance;
    for (std::size_t j = i + 1; j < sorted.size() && sorted[j].Along <= end; ++j)
    {
      const auto other = static_cast<std::size_t>(sorted[j].Corner);
      if (meetsAt[other] == sorted[j].Corner && areOne(corners[own], corners[other]))
      {
        meetsAt[other] = meetsAt[own];
      }
    }
  }
  return meetsAt;
}
