// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointMeetingCorners.h"

#include "vtkBoundingBox.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace
{

/// A corner with the cell of a grid in which it lies. Cells are far larger than tolerances.
struct Located
{
  std::uint64_t Cell;
  vtkIdType Corner;

  bool operator<(const Located& other) const
  {
    return this->Cell != other.Cell ? this->Cell < other.Cell : this->Corner < other.Corner;
  }
};

class Grid
{
public:
  explicit Grid(const std::vector<vtkIsopointCorner>& corners)
  {
    vtkBoundingBox box;
    double sum = 0.0;
    double largest = 0.0;
    std::size_t count = 0;
    for (const vtkIsopointCorner& corner : corners)
    {
      if (corner.Tolerance > 0.0f)
      {
        box.AddPoint(corner.Place[0], corner.Place[1], corner.Place[2]);
        sum += corner.Tolerance;
        largest = std::max<double>(largest, corner.Tolerance);
        ++count;
      }
    }
    if (count == 0)
    {
      return;
    }
    this->Origin = vtkVector3d(box.GetMinPoint());
    // Cells of a hundredth of a splat's size hold few corners, and few corners are near sides.
    constexpr double cellsOfTolerance = 1e4;
    constexpr double mostCells = 1 << 21; // along an axis: three numbers have 64 bits
    this->Side = std::max({ cellsOfTolerance * sum / static_cast<double>(count), 4.0 * largest,
      box.GetMaxLength() / (mostCells - 2.0) });
  }

  std::array<double, 3> Coordinates(const vtkIsopointCorner& corner) const
  {
    std::array<double, 3> result;
    for (int axis = 0; axis < 3; ++axis)
    {
      result[static_cast<std::size_t>(axis)] =
        1.0 + (corner.Place[axis] - this->Origin[axis]) / this->Side;
    }
    return result;
  }

  static std::uint64_t CellOf(const std::array<double, 3>& coordinates)
  {
    std::uint64_t cell = 0;
    for (const double coordinate : coordinates)
    {
      cell = (cell << 21) | static_cast<std::uint64_t>(coordinate);
    }
    return cell;
  }

  double GetSide() const { return this->Side; }

private:
  vtkVector3d Origin{ 0.0, 0.0, 0.0 };
  double Side = 1.0;
};

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

/// Sets of corners. The first one of a set stands for it.
class Sets
{
public:
  explicit Sets(std::size_t count)
    : Parents(count)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      this->Parents[i] = static_cast<vtkIdType>(i);
    }
  }

  vtkIdType First(vtkIdType corner)
  {
    while (this->Parent(corner) != corner)
    {
      this->Parent(corner) = this->Parent(this->Parent(corner));
      corner = this->Parent(corner);
    }
    return corner;
  }

  void Unite(vtkIdType a, vtkIdType b)
  {
    a = this->First(a);
    b = this->First(b);
    this->Parent(std::max(a, b)) = std::min(a, b);
  }

  std::vector<vtkIdType> Firsts()
  {
    for (std::size_t i = 0; i < this->Parents.size(); ++i)
    {
      this->Parents[i] = this->First(static_cast<vtkIdType>(i));
    }
    return std::move(this->Parents);
  }

private:
  vtkIdType& Parent(vtkIdType corner) { return this->Parents[static_cast<std::size_t>(corner)]; }

  std::vector<vtkIdType> Parents;
};

/// The cells other than its own that a corner's tolerance reaches into.
std::vector<std::uint64_t> cellsAround(
  const std::array<double, 3>& coordinates, double reach, std::uint64_t own)
{
  std::vector<std::uint64_t> cells;
  for (int corner = 0; corner < 8; ++corner)
  {
    std::array<double, 3> place = coordinates;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      place[axis] += (corner >> axis) % 2 == 0 ? -reach : reach;
    }
    const std::uint64_t cell = Grid::CellOf(place);
    if (cell != own && std::find(cells.begin(), cells.end(), cell) == cells.end())
    {
      cells.push_back(cell);
    }
  }
  return cells;
}

bool isNearSide(const std::array<double, 3>& coordinates, double reach)
{
  return std::any_of(coordinates.begin(), coordinates.end(),
    [reach](double coordinate)
    {
      const double within = coordinate - std::floor(coordinate);
      return within < reach || within > 1.0 - reach;
    });
}

} // namespace

//------------------------------------------------------------------------------
std::vector<vtkIdType> vtkIsopointMeetingCorners(const std::vector<vtkIsopointCorner>& corners)
{
  const Grid grid(corners);
  std::vector<Located> located;
  located.reserve(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    if (corners[i].Tolerance > 0.0f)
    {
      located.push_back({ Grid::CellOf(grid.Coordinates(corners[i])), static_cast<vtkIdType>(i) });
    }
  }
  vtkSMPTools::Sort(located.begin(), located.end());
  const auto cornerAt = [&corners](const Located& at) -> const vtkIsopointCorner&
  { return corners[static_cast<std::size_t>(at.Corner)]; };
  Sets sets(corners.size());
  const auto uniteFrom = [&](const Located& at, std::size_t from, std::uint64_t cell)
  {
    for (std::size_t j = from; j < located.size() && located[j].Cell == cell; ++j)
    {
      if (areOne(cornerAt(at), cornerAt(located[j])))
      {
        sets.Unite(at.Corner, located[j].Corner);
      }
    }
  };
  for (std::size_t i = 0; i < located.size(); ++i)
  {
    uniteFrom(located[i], i + 1, located[i].Cell);
    const std::array<double, 3> coordinates = grid.Coordinates(cornerAt(located[i]));
    const double reach = cornerAt(located[i]).Tolerance / grid.GetSide();
    if (!isNearSide(coordinates, reach))
    {
      continue;
    }
    for (const std::uint64_t cell : cellsAround(coordinates, reach, located[i].Cell))
    {
      const auto first = std::lower_bound(located.begin(), located.end(), Located{ cell, 0 });
      uniteFrom(located[i], static_cast<std::size_t>(first - located.begin()), cell);
    }
  }
  return sets.Firsts();
}
