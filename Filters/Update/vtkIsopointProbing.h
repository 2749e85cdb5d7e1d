// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointProbing_h
#define vtkIsopointProbing_h

#include "Core/Base/Vector.h"
#include "Core/Places/ProbeRequest.h"
#include "Core/Report.h"

#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

class vtkAbstractArray;
class vtkDataObject;
class vtkDataSet;
class vtkDoubleArray;
class vtkInformation;
class vtkIsopointArrayChoice;
class vtkIsopointUpdate;
struct vtkIsopointBlock;
struct vtkIsopointSampleArray;
struct vtkIsopointCloud;

/// Interpolates arrays of samples at places, in the updates of a filter.
class vtkIsopointProbing
{
public:
  /// @param update of the filter; must outlive this
  explicit vtkIsopointProbing(vtkIsopointUpdate& update);
  ~vtkIsopointProbing();

  /// Runs the work of an update; see vtkIsopointUpdate::Run(). Collective.
  void Run(vtkDataObject* output, const std::function<void()>& work);

  /// Of the last update; all 0 if it failed.
  const isopoint::SampleCounts& GetCounts() const { return this->Report.Samples; }

  // For the work, in this order. All are collective.

  /// Loads the samples of an input, without values.
  /// @param options a text with all options that ranks must share
  /// @throws isopoint::UsageError, or what isopoint::IsosurfaceExtractor throws
  void Load(
    vtkInformation* inputInfo, const vtkIsopointArrayChoice& array, const std::string& options);

  /// The samples of this rank.
  const std::vector<vtkIsopointBlock>& GetBlocks() const;

  /// The bounds of the samples in use on all ranks: least and greatest x, y and z.
  /// @throws isopoint::UsageError if there are none
  void FindBounds(double bounds[6]) const;

  /// Interpolates arrays of the samples. Counts places, arrays left out, and places outside.
  /// @param chosen the names of the arrays; null: all
  /// @param nearest names of arrays that take the nearest value, besides ids and strings
  /// @param own names of arrays that the filter makes itself; those of samples are left out
  /// @param isOutsideHidden whether places outside will be hidden
  /// @param kinds receives isopoint::PlaceKinds of each place
  /// @returns arrays with a tuple for each place; active attributes are listed beside them
  /// @throws isopoint::UsageError if none is among the chosen ones
  struct Array
  {
    vtkSmartPointer<vtkAbstractArray> Values;
    int Attribute; // a vtkDataSetAttributes::AttributeTypes, or -1
  };
  std::vector<Array> ProbeAll(const std::vector<isopoint::Vector>& places,
    const isopoint::ProbeOptions& options, const std::set<std::string>* chosen,
    const std::vector<std::string>& nearest, const std::set<std::string>& own, bool isOutsideHidden,
    std::vector<std::uint8_t>& kinds);

  /// The chosen array of the samples, perhaps without a name.
  /// @throws isopoint::UsageError if blocks have different numbers of components
  vtkIsopointSampleArray FindArray(const vtkIsopointArrayChoice& choice);

  /// The gradients of an array at places: for each of its components the derivatives by x, y and z.
  /// NaN where there is none. Counts places without.
  vtkSmartPointer<vtkDoubleArray> FindGradients(const vtkIsopointSampleArray& array,
    const std::vector<isopoint::Vector>& places, const isopoint::ProbeOptions& options);

private:
  struct ProbeReport
  {
    isopoint::SampleCounts Samples;
    std::uint64_t Places = 0;
    std::uint64_t Outside = 0;
    std::uint64_t Flat = 0;
    bool HasArrays = true;
    bool IsOutsideLost = false; // whether places outside get no values, or are hidden
    bool AreGradients = false;
    std::uint64_t WithoutGradient = 0; // places that are finite
    std::set<std::string> Replaced;    // arrays of samples, by the filter's own
    std::set<std::string> NotCommon;   // arrays that not all blocks have
  };
  void Probe(const std::vector<isopoint::Vector>& places, const isopoint::ProbeOptions& options,
    const std::vector<isopoint::ProbedArray>& arrays, std::vector<std::uint8_t>& kinds);
  std::vector<isopoint::Message> Describe() const;

  vtkIsopointUpdate& Update;
  ProbeReport Report; // of the last update

  // Of the present update.
  vtkIsopointCloud* Cloud = nullptr;
  double Loaded = 0.0; // share of the progress
};

#endif
