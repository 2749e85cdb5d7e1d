// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatBounds.h"

#include "vtkIsopointSplatBlocks.h"

#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"

#include <cmath>

//------------------------------------------------------------------------------
vtkBoundingBox vtkIsopointSplatBounds::OfFinite(vtkPoints* points)
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
        if (std::isfinite(position[0]) && std::isfinite(position[1]) && std::isfinite(position[2]))
        {
          box.AddPoint(position);
        }
      }
    });
  vtkBoundingBox result;
  for (const vtkBoundingBox& box : boxes)
  {
    result.AddBox(box);
  }
  return result;
}

//------------------------------------------------------------------------------
vtkBoundingBox vtkIsopointSplatBounds::Of(
  vtkDataObject* input, vtkCompositeDataDisplayAttributes* attributes)
{
  vtkBoundingBox box;
  decltype(this->Kept) kept;
  for (const vtkIsopointSplatLeaf& leaf : vtkIsopointSplatLeaves(input, attributes))
  {
    vtkPoints* const points = leaf.Data->GetPoints();
    const auto key = std::make_pair(points, points->GetMTime());
    const auto former = this->Kept.find(key);
    const vtkBoundingBox own = former == this->Kept.end() ? OfFinite(points) : former->second;
    kept.emplace(key, own);
    if (leaf.Visible)
    {
      box.AddBox(own);
    }
  }
  this->Kept.swap(kept);
  return box;
}
