// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointOptions_h
#define vtkIsopointOptions_h

#include "Core/ExtractionRequest.h"
#include "Input/vtkIsopointBlocks.h"
#include "Output/vtkIsopointComputedArrays.h"

#include <optional>
#include <set>
#include <vector>

namespace isopoint
{
class Team;
}

/**
 * The values of a filter's properties in one update. ForEach() is the table of those that determine
 * the output: what compares, checks or prints them all goes through it.
 */
struct vtkIsopointOptions
{
  bool Triangles = false; // or points alone
  std::vector<double> Isovalues;
  vtkIsopointArrayChoice Array;
  int Projection = 0;   // as vtkScatteredContourFilter::ProjectionMethod
  int NormalMethod = 0; // as vtkScatteredContourFilter::NormalMethods
  bool DropGaps = false;
  bool ComputeNormals = false;
  bool ComputeScalars = false;
  bool ComputeGradients = false;
  bool ComputeProjectionOrders = false;
  int OutputPointsPrecision = 0;
  bool ContourBlocks = false;

  // Of points alone:
  double Angle = isopoint::defaultAngle;
  double MinimumSpacing = 0.0;
  int NumberOfNeighbors = isopoint::defaultNeighborCount;
  bool ComputeSplats = false;

  // How an update runs, which the output does not depend on:
  bool KeepTree = false;
  bool UseAllCores = false;

  /// Calls visit(name, value, least, greatest) for each property that has an effect, of the type
  /// bool, int or double.
  template <class Visitor>
  void ForEach(const Visitor& visit) const
  {
    visit("Projection", this->Projection, 0, 4);
    visit("NormalMethod", this->NormalMethod, -1, 1);
    visit("DropGaps", this->DropGaps, 0, 1);
    visit("ComputeNormals", this->ComputeNormals, 0, 1);
    visit("ComputeScalars", this->ComputeScalars, 0, 1);
    visit("ComputeGradients", this->ComputeGradients, 0, 1);
    visit("ComputeProjectionOrders", this->ComputeProjectionOrders, 0, 1);
    visit("OutputPointsPrecision", this->OutputPointsPrecision, 0, 2);
    visit("ContourBlocks", this->ContourBlocks, 0, 1);
    if (!this->Triangles)
    {
      visit("Angle", this->Angle, 0, 180);
      visit("MinimumSpacing", this->MinimumSpacing, 0, 1);
      visit("NumberOfNeighbors", this->NumberOfNeighbors, 3, 1000);
      visit("ComputeSplats", this->ComputeSplats, 0, 1);
    }
  }

  /// Checks what setters accept unchecked.
  /// @throws vtkIsopointUsageError
  void Check() const;

  /// Checks that all ranks have the same options. Collective.
  /// @throws vtkIsopointUsageError on one rank and isopoint::FailedElsewhere on the others
  void CheckOnRanks(isopoint::Team& team) const;

  /// Each isovalue once, ascending; none of them NaN.
  std::set<double> GetSortedIsovalues() const;

  /// The arrays that are to be computed.
  vtkIsopointComputedArrays::Choice GetArrays() const;

  /// What the core is to do, without an isovalue.
  isopoint::ExtractionRequest GetRequest() const;

private:
  bool HasNormalsFromField() const;
  std::optional<isopoint::FitRequest> GetFitRequest() const;
};

#endif
