// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointStructure_h
#define vtkIsopointStructure_h

#include "Core/Ranks/ByteBuffer.h"

#include "vtkSmartPointer.h"

#include <cstddef>
#include <string>
#include <vector>

namespace isopoint
{
class ProcessGroup;
}
class vtkCompositeDataSet;
class vtkDataObject;
class vtkPolyData;

/// The structure of a data object: a leaf, or the tree of a composite. Leaves may be null; they are
/// numbered in the order of traversal, including null ones.
class vtkIsopointStructure
{
public:
  /// The structure of null.
  vtkIsopointStructure() = default;

  explicit vtkIsopointStructure(vtkDataObject* object);

  bool IsComposite() const { return this->Type >= 0; }

  std::size_t GetNumberOfLeaves() const;

  /// The numbers of the non-null leaves of a data object, in the order of traversal.
  /// @param object of this structure, or of one that was merged into it
  std::vector<std::size_t> GetNumbersOf(vtkDataObject* object) const;

  /// Adds the parts of another structure that are missing in this one. Null matches anything, and a
  /// composite without children matches one with any; partitioned data sets may differ in size.
  /// @param place of both structures in the tree, for messages
  /// @throws isopoint::UsageError if the structures contradict each other
  void Merge(const vtkIsopointStructure& other, const std::string& place = {});

  /// Gives an output of vtkNewIsopointComposite() this structure, with surfaces as leaves.
  /// @param input of the output; names of blocks and assemblies are kept
  /// @param surfaces one per leaf, or null
  void Fill(vtkDataObject* input, const std::vector<vtkSmartPointer<vtkPolyData>>& surfaces,
    vtkCompositeDataSet* output) const;

  /// Appends this node, then its children.
  void Write(isopoint::ByteBuffer& bytes) const;
  /// Reads what Write() appended.
  static vtkIsopointStructure Read(isopoint::ByteReader& bytes);

private:
  static constexpr int leaf = -1;
  static constexpr int nothing = -2;

  void AddNumbers(
    vtkDataObject* object, std::size_t& next, std::vector<std::size_t>& numbers) const;
  void FillChildren(const std::vector<vtkSmartPointer<vtkPolyData>>& surfaces, std::size_t& next,
    vtkDataObject* output) const;

  int Type = nothing; // vtkDataObject::GetDataObjectType() of a composite
  std::string Name;   // within its parent, or empty
  std::vector<vtkIsopointStructure> Children;
};

/// The merged structure of the inputs of all ranks. Collective.
/// @throws isopoint::UsageError on rank 0 and isopoint::FailedElsewhere on the others if they
/// contradict each other; what isopoint::ProcessGroup throws
vtkIsopointStructure vtkMergeIsopointStructures(
  isopoint::ProcessGroup& processes, vtkDataObject* input);

#endif
