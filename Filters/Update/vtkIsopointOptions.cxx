// SPDX-License-Identifier: GPL-3.0-or-later
#include "Update/vtkIsopointOptions.h"

#include "Core/Base/Team.h"
#include "Input/vtkIsopointUsageError.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <ios>
#include <optional>
#include <sstream>
#include <string>

namespace
{

constexpr int automaticNormals = -1;
constexpr int normalsFromField = 0;

} // namespace

void vtkIsopointOptions::Check() const
{
  if (std::any_of(this->Isovalues.begin(), this->Isovalues.end(),
        [](double value) { return std::isnan(value); }))
  {
    throw vtkIsopointUsageError("An isovalue is not a number. Choose numbers as isovalues.");
  }
  this->ForEach(
    [](const char* name, double value, double least, double greatest)
    {
      if (!(value >= least && value <= greatest))
      {
        std::ostringstream message;
        message << name << " is " << value << ", which is out of range. Set it to a value from "
                << least << " to " << greatest << ".";
        throw vtkIsopointUsageError(message.str());
      }
    });
}

void vtkIsopointOptions::CheckOnRanks(isopoint::Team& team) const
{
  std::ostringstream text;
  text << std::hexfloat << this->Triangles << " " << this->Array.Describe();
  for (const double isovalue : this->GetSortedIsovalues())
  {
    text << " " << isovalue + 0.0; // 0 and -0 are the same
  }
  this->ForEach([&text](const char*, double value, double, double) { text << " " << value + 0.0; });
  const std::uint64_t hash = std::hash<std::string>()(text.str());
  const bool differ = team.maximum(hash) != ~team.maximum(~hash);
  if (differ && team.rank() == 0)
  {
    throw vtkIsopointUsageError(
      "The filters of the ranks have different options. Set the same on all of them, or contour"
      " each rank's samples separately by setting Controller to null.");
  }
}

std::set<double> vtkIsopointOptions::GetSortedIsovalues() const
{
  return { this->Isovalues.begin(), this->Isovalues.end() };
}

vtkIsopointComputedArrays::Choice vtkIsopointOptions::GetArrays() const
{
  vtkIsopointComputedArrays::Choice choice;
  choice.Normals = this->ComputeNormals;
  choice.Splats = this->ComputeSplats;
  choice.Gradients = this->ComputeGradients;
  choice.ProjectionOrder = this->ComputeProjectionOrders;
  choice.IsProjected = this->Projection != 0;
  return choice;
}

bool vtkIsopointOptions::HasNormalsFromField() const
{
  if (this->NormalMethod == automaticNormals)
  {
    return this->Projection != 0 || this->ComputeGradients || this->MinimumSpacing > 0.0;
  }
  return this->NormalMethod == normalsFromField;
}

/// The fit that the projection or an output requires, if any: thinning and normals from the field
/// require polynomials, other splats and fit orders at least the sample spacing.
std::optional<isopoint::FitRequest> vtkIsopointOptions::GetFitRequest() const
{
  using isopoint::FitOrder;
  using isopoint::FitRequest;
  if (this->Projection != 0)
  {
    return FitRequest{ static_cast<FitOrder>(this->Projection), true };
  }
  const bool needsSplats = this->GetArrays().NeedsSplats();
  if (this->ComputeGradients || this->MinimumSpacing > 0.0 ||
      (needsSplats && this->HasNormalsFromField()))
  {
    return FitRequest{ FitOrder::Cubic, false };
  }
  if (needsSplats || this->ComputeProjectionOrders)
  {
    return FitRequest{ std::nullopt, false };
  }
  return std::nullopt;
}

isopoint::ExtractionRequest vtkIsopointOptions::GetRequest() const
{
  isopoint::ExtractionRequest request;
  request.isosurface.angle = this->Angle;
  request.isosurface.dropsGaps = this->DropGaps;
  request.isosurface.fit = this->GetFitRequest();
  request.isosurface.partsCreases = this->ComputeNormals;
  request.minimumSpacing = this->MinimumSpacing;
  request.triangles = this->Triangles;
  if (this->GetArrays().NeedsSplats())
  {
    request.splats = isopoint::SplatOptions{ this->NumberOfNeighbors, this->HasNormalsFromField(),
      this->ComputeSplats };
  }
  return request;
}
