// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointSampleArrays_h
#define vtkIsopointSampleArrays_h

#include "Core/Places/ProbeRequest.h"
#include "Core/Report.h"
#include "Input/vtkIsopointBlocks.h"

#include "vtkSmartPointer.h"

#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace isopoint
{
class ProcessGroup;
}
class vtkAbstractArray;
class vtkDataArray;

/// An array of the samples of all blocks.
struct vtkIsopointSampleArray
{
  std::string Name;
  int Components = 1; // 0: it is no array of all blocks
  int Type = 0;       // of its values; double if blocks have different types
  int Attribute = -1; // a vtkDataSetAttributes::AttributeTypes, or -1
  bool AreIntegers = false;
  bool IsNearest = false;               // takes the value of the nearest sample, and keeps its type
  std::vector<vtkAbstractArray*> Parts; // by block of this rank
};

/// Lists the arrays of numbers and strings that all blocks of all ranks have with as many
/// components, in the order of the first block. Ghost marks are never among them. Collective.
/// @param nearest names of arrays that take the nearest value, besides ids and strings
/// @param dropped receives the names of other arrays
/// @throws what isopoint::ProcessGroup throws
std::vector<vtkIsopointSampleArray> vtkListIsopointArrays(isopoint::ProcessGroup& processes,
  const std::vector<vtkIsopointBlock>& blocks, const std::vector<std::string>& nearest,
  std::set<std::string>& dropped);

/// The chosen array of the blocks of all ranks, without its name; without components if their
/// number differs. Collective.
/// @throws what isopoint::ProcessGroup throws
vtkIsopointSampleArray vtkFindIsopointArray(isopoint::ProcessGroup& processes,
  const std::vector<vtkIsopointBlock>& blocks, const vtkIsopointArrayChoice& choice);

/// The note that arrays are left out of the output.
/// @param rule which arrays are not
isopoint::Message vtkDescribeLeftOut(const std::set<std::string>& names, const std::string& rule);

/// The values of arrays at places: double, or for PlaceMethod::Nearest, and arrays that take the
/// nearest value, of the type of the array. Collective.
/// @param probe calls IsosurfaceExtractor::probe()
/// @throws std::bad_alloc, and what probe throws
std::vector<vtkSmartPointer<vtkAbstractArray>> vtkProbeIsopointArrays(
  isopoint::ProcessGroup& processes, const std::vector<vtkIsopointSampleArray>& arrays,
  const std::vector<vtkIsopointBlock>& blocks, const isopoint::ProbeOptions& options,
  std::size_t places, const std::function<void(const std::vector<isopoint::ProbedArray>&)>& probe);

/// Replaces the numbers of an array by those of another one that are finite, integers rounded.
void vtkReplaceIsopointNumbers(vtkDataArray* found, vtkDataArray* array);

/// Makes `probed` read an array of samples.
void vtkReadIsopointArray(const vtkIsopointSampleArray& array,
  const std::vector<vtkIsopointBlock>& blocks, isopoint::ProbedArray& probed);

#endif
