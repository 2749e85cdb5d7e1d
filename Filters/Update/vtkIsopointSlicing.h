// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointSlicing_h
#define vtkIsopointSlicing_h

#include "Core/ExtractionRequest.h"
#include "Core/Places/ProbeRequest.h"
#include "Core/Report.h"
#include "Input/vtkIsopointInputState.h"
#include "Update/vtkIsopointOptions.h"

#include "vtkSmartPointer.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

class vtkDoubleArray;
class vtkImplicitFunction;
class vtkInformation;
class vtkIsopointCut;
class vtkIsopointUpdate;
class vtkPolyData;
class vtkPointData;
struct vtkIsopointCloud;
struct vtkIsopointSampleArray;

/// Slices samples in the updates of a filter, or finds their body: the surface of values that a
/// function has at the samples, with all their arrays.
class vtkIsopointSlicing
{
public:
  /// What to slice. With capping, Function is null.
  struct Options : vtkIsopointOptions
  {
    vtkSmartPointer<vtkImplicitFunction> Function{};
    std::optional<isopoint::PlaceMethod> Method{}; // of arrays; none: linear along edges
    std::vector<std::string> Nearest{}; // arrays that take the nearest value, besides ids and text
  };

  /// Of triangles with points on edges, without normals.
  static isopoint::Options OptionsOfCore();

  /// @param update of the filter; must outlive this
  explicit vtkIsopointSlicing(vtkIsopointUpdate& update);
  ~vtkIsopointSlicing();

  /// Updates the output, a vtkPolyData; see vtkIsopointUpdate::Run(). Collective.
  void Run(const Options& options, vtkInformation* inputInfo, vtkInformation* outputInfo);

  /// Of the last update; empty if it failed.
  const isopoint::Report& GetReport() const { return this->Report; }

private:
  void Slice(Options options, vtkInformation* inputInfo, vtkInformation* outputInfo);
  void CheckValues(const vtkIsopointCloud& cloud);
  void CheckFunctionOnRanks(const vtkIsopointCut& cut, const vtkIsopointCloud& cloud);
  vtkIsopointCloud& Load(const vtkIsopointCut& cut, vtkInformation* inputInfo);
  void FillOutput(const Options& options, const vtkIsopointCut& cut, vtkIsopointCloud& cloud,
    std::vector<isopoint::ExtractedIsosurface>& surfaces, vtkPolyData* output);
  void Fit(const Options& options, const std::vector<vtkIsopointSampleArray>& arrays,
    vtkIsopointCloud& cloud, vtkPolyData* output);
  std::vector<isopoint::Message> Describe(isopoint::OptionNaming naming) const;

  vtkIsopointUpdate& Update;
  isopoint::Report Report;
  std::set<std::string> Dropped; // arrays

  // Of the function at the samples, by block; kept with the tree.
  std::vector<vtkSmartPointer<vtkDoubleArray>> Values;
  vtkIsopointInputState ValuesOf;
};

#endif
