// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointBlocks_h
#define vtkIsopointBlocks_h

#include "Core/Failure.h"
#include "Input/vtkIsopointInputState.h"

#include "vtkDataSetAttributes.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace isopoint
{
struct Execution;
}
class vtkAbstractArray;
class vtkDataArray;
class vtkDataObject;
class vtkDataSet;
class vtkInformation;
class vtkUnsignedCharArray;

/// The samples of a data set or hyper tree grid: its points, or the centers of its cells, with
/// their ids. References the input's arrays. Cell centers and inherited ghost flags may be
/// computed.
struct vtkIsopointBlock
{
  vtkSmartPointer<vtkDataSet> Positions; // one point per sample; its attributes are ignored
  vtkDataSetAttributes* Attributes = nullptr;
  vtkDataArray* Scalars = nullptr; // the samples' values; null if they have none

  /// Null, or one value per sample; samples with any of the bits in `Excluding` are skipped.
  vtkSmartPointer<vtkUnsignedCharArray> Ghosts;
  static constexpr unsigned char Excluding =
    vtkDataSetAttributes::DUPLICATEPOINT | vtkDataSetAttributes::HIDDENPOINT;

  /// The number of samples that `Ghosts` excludes.
  vtkIdType NumberOfExcluded = 0;

  /// For a hyper tree grid, how many of these are ids of coarse nodes or of no node.
  vtkIdType NumberOfUnusedIds = 0;

  /// The number of its leaf in the traversal of a composite input; otherwise 0.
  std::size_t Leaf = 0;

  vtkIdType GetNumberOfSamples() const;
};

/// The array that determines which points or cells are samples.
class vtkIsopointArrayChoice
{
public:
  enum Roles
  {
    NoArray, // samples are the points or, of a data set with cell arrays alone, the cells
    Values,  // a scalar array, the values of the samples
    Tuples   // an array with any components; the samples have no values
  };

  /// No array.
  vtkIsopointArrayChoice() = default;

  /// @param inputArray as chosen by vtkAlgorithm::SetInputArrayToProcess()
  explicit vtkIsopointArrayChoice(vtkInformation* inputArray, Roles role = Values);

  Roles GetRole() const { return this->Role; }

  /// Whether the array may be a point array, and a cell array. Point arrays have precedence.
  bool MayBeOfPoints() const;
  bool MayBeOfCells() const;

  /// The array of the chosen name, or else of the chosen attribute (default: active scalars), or
  /// null.
  vtkAbstractArray* Find(vtkDataSetAttributes* attributes) const;

  /// The attributes of a leaf's samples and the chosen array, which is null if none is. Both are
  /// null if the leaf does not have it.
  std::pair<vtkDataSetAttributes*, vtkAbstractArray*> FindIn(vtkDataObject* leaf) const;

  /// Describes the array for messages and comparisons, as in "point array named ...".
  std::string Describe() const;

private:
  Roles Role = NoArray;
  int Association = 0;
  std::string Name; // empty: the active attribute
  int Attribute = 0;
};

/// There are no samples. In a process group this is an error only if it holds for all ranks.
struct vtkIsopointNoSamplesError : isopoint::UsageError
{
  using isopoint::UsageError::UsageError;
};

/// Presents a data object as samples: each data set or hyper tree grid in it is a block. Keeps
/// computed cell centers and inherited ghosts between calls while the cells and their ghosts do not
/// change. Arrays changed in place need Modified(), except ghost arrays and the mask of a hyper
/// tree grid, whose contents are compared.
class vtkIsopointBlocks
{
public:
  /// Collects the blocks of an input that have the array, if one is chosen, and any points or
  /// cells.
  /// @param wholeExtent of the structured grid whose pieces are distributed over ranks, or null
  /// @throws isopoint::UsageError if no block remains, or if the array of a block does not have a
  /// number, or for an attribute a tuple, per point or cell; std::bad_alloc; isopoint::Aborted
  void Collect(const isopoint::Execution& execution, vtkDataObject* input,
    const vtkIsopointArrayChoice& choice, const int* wholeExtent);

  const std::vector<vtkIsopointBlock>& GetBlocks() const { return this->Blocks; }

  /// The state of the input in the blocks [begin, end).
  vtkIsopointInputState GetState(std::size_t begin, std::size_t end) const;

  /// The number of points (or cells, if more) of leaves without the array.
  vtkIdType GetNumberOfPointsWithoutArray() const { return this->PointsWithoutArray; }

  /// Drops all references to the input, but keeps computed data.
  void ReleaseInput();

private:
  void AddLeaf(const isopoint::Execution& execution, vtkDataObject* leaf, std::size_t number,
    const vtkIsopointArrayChoice& choice, const int* wholeExtent);

  struct Computed
  {
    vtkIsopointInputState Of;                     // what it was computed from
    vtkSmartPointer<vtkDataSet> Centers;          // of cells or leaves of hyper trees, as points
    vtkSmartPointer<vtkUnsignedCharArray> Ghosts; // as vtkIsopointBlock::Ghosts, or null
    bool HasOwnGhosts = false;                    // whether Ghosts is the array of the points
    vtkIdType NumberOfExcluded = 0;
    vtkIdType NumberOfUnusedIds = 0;
  };
  static void Compute(const isopoint::Execution& execution, vtkDataObject* leaf,
    const vtkIsopointBlock& block, vtkIdType samples, const int* wholeExtent, Computed& computed);

  std::vector<vtkIsopointBlock> Blocks;
  std::vector<vtkIsopointInputState> States; // one for each block
  vtkIdType PointsWithoutArray = 0;
  std::map<std::size_t, Computed> Kept; // by leaf
};

/// The leaves of a composite that are not null, in the order of traversal. Another data object is
/// its only leaf.
std::vector<vtkDataObject*> vtkListIsopointLeaves(vtkDataObject* input);

#endif
