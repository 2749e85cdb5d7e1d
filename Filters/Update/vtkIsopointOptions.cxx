// SPDX-License-Identifier: GPL-3.0-or-later
#include "Update/vtkIsopointOptions.h"

#include "Input/vtkIsopointUsageError.h"
#include "Isopoint/Base/Team.h"
#include "vtkScatteredIsopointFilter.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkType.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <sstream>
#include <string>

namespace
{

/// Whether isopoints are thinned out; triangles never are.
bool isThinned(vtkScatteredIsopointFilter* filter)
{
  return filter->GetMinimumSpacing() > 0.0 && !filter->ExtractsTriangles();
}

bool hasNormalsFromField(vtkScatteredIsopointFilter* filter)
{
  if (filter->GetNormalMethod() == vtkScatteredIsopointFilter::AUTOMATIC_NORMALS)
  {
    return filter->GetProjection() != vtkScatteredIsopointFilter::NO_PROJECTION ||
           filter->GetComputeGradients() || isThinned(filter);
  }
  return filter->GetNormalMethod() == vtkScatteredIsopointFilter::NORMALS_FROM_FIELD;
}

/// The fit that the projection or an output requires, if any: thinning and normals from the field
/// require polynomials, other splats and fit orders at least the sample spacing.
std::optional<isopoint::FitRequest> fitRequestOf(
  vtkScatteredIsopointFilter* filter, const vtkIsopointComputedArrays::Choice& arrays)
{
  using isopoint::FitOrder;
  using isopoint::FitRequest;
  switch (filter->GetProjection())
  {
    case vtkScatteredIsopointFilter::LINEAR_FIT:
      return FitRequest{ FitOrder::Linear, true };
    case vtkScatteredIsopointFilter::QUADRATIC_FIT:
      return FitRequest{ FitOrder::Quadratic, true };
    case vtkScatteredIsopointFilter::CUBIC_FIT:
      return FitRequest{ FitOrder::Cubic, true };
    case vtkScatteredIsopointFilter::CREASE_FIT:
      return FitRequest{ FitOrder::Crease, true };
    default:
      break;
  }
  const bool hasFieldNormals = arrays.NeedsSplats() && hasNormalsFromField(filter);
  if (arrays.Gradients || hasFieldNormals || isThinned(filter))
  {
    return FitRequest{ FitOrder::Cubic, false };
  }
  if (arrays.NeedsSplats() || arrays.ProjectionOrder)
  {
    return FitRequest{ std::nullopt, false };
  }
  return std::nullopt;
}

} // namespace

void vtkCheckIsopointOptions(vtkScatteredIsopointFilter* filter)
{
  const double* const values = filter->GetValues();
  const vtkIdType valueCount = filter->GetNumberOfContours();
  if (std::any_of(values, values + valueCount, [](double value) { return std::isnan(value); }))
  {
    throw vtkIsopointUsageError("An isovalue is not a number. Set isovalues with SetValue().");
  }
  const double angle = filter->GetAngle();
  if (!(angle >= 0.0 && angle <= 180.0))
  {
    std::ostringstream message;
    message << "The angle is " << angle
            << " degrees, which is out of range. Set one within 0 and 180 with SetAngle().";
    throw vtkIsopointUsageError(message.str());
  }
  if (std::isnan(filter->GetMinimumSpacing()))
  {
    throw vtkIsopointUsageError(
      "The minimum spacing is not a number. Set one within 0 and 1 with SetMinimumSpacing().");
  }
}

void vtkCheckIsopointOptionsOnRanks(isopoint::Team& team, vtkScatteredIsopointFilter* filter)
{
  std::uint64_t hash = 14695981039346656037u; // FNV-1a
  const auto add = [&hash](double number)
  {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof(bits));
    hash = (hash ^ bits) * 1099511628211u;
    hash ^= hash >> 32;
  };
  for (int i = 0; i < filter->GetNumberOfContours(); ++i)
  {
    add(filter->GetValue(i) + 0.0); // 0 and -0 are the same
  }
  for (const double number : { filter->GetAngle(), filter->GetMinimumSpacing() })
  {
    add(number);
  }
  for (const int number : { filter->GetDropGaps(), filter->GetProjection(),
         filter->GetNormalMethod(), filter->GetNumberOfNeighbors(), filter->GetComputeNormals(),
         filter->GetComputeSplats(), filter->GetComputeScalars(), filter->GetComputeGradients(),
         filter->GetComputeProjectionOrders(), filter->GetOutputPointsPrecision(),
         filter->GetContourBlocks() })
  {
    add(number);
  }
  vtkInformation* const array = filter->GetInputArrayInformation(0);
  if (array->Has(vtkDataObject::FIELD_NAME()))
  {
    for (const char letter : std::string(array->Get(vtkDataObject::FIELD_NAME())))
    {
      add(letter);
    }
  }
  const bool differ = team.maximum(hash) != ~team.maximum(~hash);
  team.together(
    [&]()
    {
      if (differ && team.rank() == 0)
      {
        throw vtkIsopointUsageError(
          "The filters of the ranks have different options. Set the same on all of them, or"
          " contour each rank's samples separately with SetController(nullptr).");
      }
    });
}

vtkIsopointComputedArrays::Choice vtkChooseIsopointArrays(vtkScatteredIsopointFilter* filter)
{
  const bool hasSplats = !filter->ExtractsTriangles();
  vtkIsopointComputedArrays::Choice choice;
  choice.Normals = filter->GetComputeNormals() != 0;
  choice.Splats = hasSplats && filter->GetComputeSplats() != 0;
  choice.Gradients = filter->GetComputeGradients() != 0;
  choice.ProjectionOrder = filter->GetComputeProjectionOrders() != 0;
  choice.IsProjected = filter->GetProjection() != vtkScatteredIsopointFilter::NO_PROJECTION;
  return choice;
}

isopoint::ExtractionRequest vtkMakeIsopointRequest(vtkScatteredIsopointFilter* filter)
{
  const vtkIsopointComputedArrays::Choice arrays = vtkChooseIsopointArrays(filter);
  isopoint::ExtractionRequest request;
  request.isosurface.angle = filter->GetAngle();
  request.isosurface.dropsGaps = filter->GetDropGaps() != 0;
  request.isosurface.fit = fitRequestOf(filter, arrays);
  request.isosurface.partsCreases = filter->GetComputeNormals() != 0;
  request.minimumSpacing = filter->GetMinimumSpacing();
  request.triangles = filter->ExtractsTriangles();
  if (arrays.NeedsSplats())
  {
    request.splats = isopoint::SplatOptions{ filter->GetNumberOfNeighbors(),
      hasNormalsFromField(filter), arrays.Splats };
  }
  return request;
}
