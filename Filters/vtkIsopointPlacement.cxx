// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointPlacement.h"

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Base/Interpolation.h"
#include "vtkIsopointInput.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"

#include <utility>

isopoint::SurfacePoints vtkPlaceIsopoints(const isopoint::Execution& execution, vtkDataSet* input,
  vtkDataArray* scalars, vtkContouredIsosurface& contoured)
{
  const std::vector<isopoint::Isopoint>& points = contoured.Surface.points;
  const vtkIsopointPositions samplePositions(input);
  const isopoint::CoincidentAttribute valueAt(contoured.Surface,
    [scalars](std::uint64_t id) { return scalars->GetComponent(static_cast<vtkIdType>(id), 0); });
  isopoint::SurfacePoints placed;
  placed.fits = std::move(contoured.Surface.fits);
  placed.positions.resize(points.size());
  placed.decreasingEdges.resize(points.size());
  constexpr std::size_t grain = 4096;
  isopoint::forRanges(execution, points.size(), grain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        double first[3];
        double second[3];
        samplePositions.Get(static_cast<vtkIdType>(points[i].first), first);
        samplePositions.Get(static_cast<vtkIdType>(points[i].second), second);
        const bool falls = !(valueAt(points[i].first) < contoured.Isovalue);
        for (int axis = 0; axis < 3; ++axis)
        {
          placed.positions[i][axis] = placed.fits.empty() ? isopoint::interpolate(first[axis],
                                                              second[axis], points[i].parameter)
                                                          : placed.fits[i].position[axis];
          const double edge = second[axis] - first[axis];
          placed.decreasingEdges[i][axis] = falls ? edge : -edge;
        }
      }
    });
  return placed;
}
