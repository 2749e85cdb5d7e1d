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
class Team;
}
class vtkCompositeDataSet;
class vtkDataObject;
class vtkPolyData;

/**
 * The structure of a data object: a leaf, or the tree of the leaves of a composite, some of which
 * may be null. Leaves are numbered in the order of traversal, null ones included.
 */
class vtkIsopointStructure
{
public:
  /// That of null.
  vtkIsopointStructure() = default;

  explicit vtkIsopointStructure(vtkDataObject* object);

  bool IsComposite() const { return this->Type >= 0; }

  std::size_t GetNumberOfLeaves() const;

  /// The numbers of the leaves of a data object that are not null, in the order of traversal.
  /// @param object of this structure, or of one that was merged into it
  std::vector<std::size_t> GetNumbersOf(vtkDataObject* object) const;

  /// Adds what another structure has and this one lacks. Null can be anything, and a composite
  /// without children may have any; data sets in pieces may have different numbers of them.
  /// @throws isopoint::UsageError where the structures contradict each other
  void Merge(const vtkIsopointStructure& other);

  /// Gives an output of vtkNewIsopointComposite() this structure, with surfaces in place of the
  /// leaves.
  /// @param input that the output is for; names of blocks and assemblies are kept
  /// @param surfaces one for each leaf, null for none
  void Fill(vtkDataObject* input, const std::vector<vtkSmartPointer<vtkPolyData>>& surfaces,
    vtkCompositeDataSet* output) const;

  /// Appends this node, then its children.
  void Write(isopoint::ByteBuffer& bytes) const;
  /// @returns what Write() has appended
  static vtkIsopointStructure Read(isopoint::ByteReader& bytes);

private:
  static constexpr int leaf = -1;
  static constexpr int nothing = -2;

  void AddNumbers(
    vtkDataObject* object, std::size_t& next, std::vector<std::size_t>& numbers) const;
  void Merge(const vtkIsopointStructure& other, const std::string& place);
  void FillChildren(const std::vector<vtkSmartPointer<vtkPolyData>>& surfaces, std::size_t& next,
    vtkDataObject* output) const;

  int Type = nothing; // of a composite, as vtkDataObject::GetDataObjectType() returns it
  std::string Name;   // as its parent calls it, or empty
  std::vector<vtkIsopointStructure> Children;
};

/**
 * The structure that the inputs of all ranks have together. Collective.
 * @throws isopoint::UsageError on rank 0 and isopoint::FailedElsewhere on the others where they
 * contradict each other; what isopoint::Team throws
 */
vtkIsopointStructure vtkMergeIsopointStructures(isopoint::Team& team, vtkDataObject* input);

#endif
