// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatBounds.h"

#include "vtkIsopointSplatBlocks.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"

#include <cmath>

namespace
{

/// Bounds of boxes around the finite points.
/// @param reachOf(point) half the side of its box
template <class ReachOf>
vtkBoundingBox boundsOf(vtkPoints* points, const ReachOf& reachOf)
{
  vtkSMPThreadLocal<vtkBoundingBox> boxes;
  vtkSMPTools::For(0, points->GetNumberOfPoints(),
    [&](vtkIdType begin, vtkIdType end)
    {
      vtkBoundingBox& box = boxes.Local();
      for (vtkIdType i = begin; i < end; ++i)
      {
        double position[3];
        points->GetPoint(i, position);
        if (!std::isfinite(position[0]) || !std::isfinite(position[1]) ||
            !std::isfinite(position[2]))
        {
          continue;
        }
        const double reach = reachOf(i);
        double lower[3] = { position[0] - reach, position[1] - reach, position[2] - reach };
        double upper[3] = { position[0] + reach, position[1] + reach, position[2] + reach };
        box.AddPoint(lower);
        box.AddPoint(upper);
      }
    });
  vtkBoundingBox result;
  for (const vtkBoundingBox& box : boxes)
  {
    result.AddBox(box);
  }
  return result;
}

double usable(double reach)
{
  return reach > 0.0 && std::isfinite(reach) ? reach : 0.0;
}

/// The radii of points, or null.
vtkDataArray* radiiOf(vtkPolyData* data, const std::string& name)
{
  vtkDataArray* const radii = name.empty() ? nullptr : data->GetPointData()->GetArray(name.c_str());
  return radii && radii->GetNumberOfTuples() >= data->GetNumberOfPoints() ? radii : nullptr;
}

} // namespace

//------------------------------------------------------------------------------
vtkBoundingBox vtkIsopointSplatBounds::OfFinite(vtkPoints* points)
{
  return boundsOf(points, [](vtkIdType) { return 0.0; });
}

//------------------------------------------------------------------------------
double vtkIsopointSplatBounds::AutomaticRadius(vtkPoints* points)
{
  const double diagonal = OfFinite(points).GetDiagonalLength();
  const double radius =
    2.0 * diagonal / std::sqrt(static_cast<double>(points->GetNumberOfPoints()));
  return std::isfinite(radius) && radius > 0.0 ? radius : 1.0;
}

//------------------------------------------------------------------------------
vtkBoundingBox vtkIsopointSplatBounds::Of(
  vtkDataObject* input, vtkCompositeDataDisplayAttributes* attributes, const Reach& reach)
{
  vtkBoundingBox box;
  decltype(this->Kept) kept;
  for (const vtkIsopointSplatLeaf& leaf : vtkIsopointSplatLeaves(input, attributes))
  {
    vtkPoints* const points = leaf.Data->GetPoints();
    vtkDataArray* const radii = radiiOf(leaf.Data, reach.ArrayName);
    const Key key(
      points, points->GetMTime(), radii, radii ? radii->GetMTime() : 0, reach.Radius, reach.Scale);
    const auto former = this->Kept.find(key);
    const vtkBoundingBox own =
      former != this->Kept.end()
        ? former->second
        : boundsOf(points, [&](vtkIdType i)
            { return usable(reach.Scale * (radii ? radii->GetComponent(i, 0) : reach.Radius)); });
    kept.emplace(key, own);
    if (leaf.Visible)
    {
      box.AddBox(own);
    }
  }
  this->Kept.swap(kept);
  return box;
}
