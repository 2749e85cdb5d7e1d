// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointBlocks_h
#define vtkIsopointBlocks_h

#include "Core/Base/UsageError.h"
#include "Input/vtkIsopointBlock.h"
#include "Input/vtkIsopointInputState.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace isopoint
{
struct Execution;
}
class vtkAbstractArray;
class vtkDataObject;
class vtkDataSet;
class vtkDataSetAttributes;
class vtkInformation;
class vtkUnsignedCharArray;

/**
 * The array to contour, as chosen by vtkAlgorithm::SetInputArrayToProcess().
 */
class vtkIsopointArrayChoice
{
public:
  vtkIsopointArrayChoice() = default;
  explicit vtkIsopointArrayChoice(vtkInformation* inputArray);

  /// Whether the array may be a point array, and a cell array. If it may be either, a point array
  /// has precedence.
  bool MayBeOfPoints() const;
  bool MayBeOfCells() const;

  /// The array of the chosen name or, if none was chosen, of the chosen attribute (the active
  /// scalars by default); null if there is none.
  vtkAbstractArray* Find(vtkDataSetAttributes* attributes) const;

  /// Which array it is, for messages and comparisons, as in "point array named ...".
  std::string Describe() const;

private:
  int Association = 0;
  std::string Name; // empty: the active attribute
  int Attribute = 0;
};

/**
 * There is nothing to contour, which on one of several ranks is no error unless it is so on all.
 */
struct vtkIsopointNothingError : isopoint::UsageError
{
  using isopoint::UsageError::UsageError;
};

/**
 * Presents a data object as samples: each of its data sets or hyper tree grids is a block. Computed
 * cell centers, and ghosts that points and cells inherit from each other, are kept from one call to
 * the next while the cells and their ghosts do not change. Modified() must be called for arrays
 * that are changed in place, except ghost arrays and the mask of a hyper tree grid, whose content
 * is compared.
 */
class vtkIsopointBlocks
{
public:
  /// Collects the blocks of an input, except those without the array or without points or cells.
  /// @param wholeExtent of the structured grid of which the input is a piece of one of several
  /// ranks, or null
  /// @throws isopoint::UsageError if no block remains, or if the array of a block is not a scalar
  /// array with one value for each point or cell; std::bad_alloc; isopoint::Aborted
  void Collect(const isopoint::Execution& execution, vtkDataObject* input,
    const vtkIsopointArrayChoice& choice, const int* wholeExtent);

  const std::vector<vtkIsopointBlock>& GetBlocks() const { return this->Blocks; }

  /// The state of the input that the blocks [begin, end) present.
  vtkIsopointInputState GetState(std::size_t begin, std::size_t end) const;

  /// The number of points (or cells, where there are more) of leaves without the array.
  vtkIdType GetNumberOfPointsWithoutArray() const { return this->PointsWithoutArray; }

  /// Drops all references to the input. What was computed is kept.
  void ReleaseInput();

private:
  void AddLeaf(const isopoint::Execution& execution, vtkDataObject* leaf, std::size_t number,
    const vtkIsopointArrayChoice& choice, const int* wholeExtent);

  /// What is computed for a leaf.
  struct Computed
  {
    vtkIsopointInputState Of;                     // what it was computed from
    vtkSmartPointer<vtkDataSet> Centers;          // of cells or leaves of hyper trees, as points
    vtkSmartPointer<vtkUnsignedCharArray> Ghosts; // as vtkIsopointBlock::Ghosts, or null
    bool HasOwnGhosts = false;                    // whether these are the array of the points
    vtkIdType NumberOfExcluded = 0;
    vtkIdType NumberOfUnusedIds = 0;
  };
  static void Compute(const isopoint::Execution& execution, vtkDataObject* leaf,
    const vtkIsopointBlock& block, const int* wholeExtent, Computed& computed);

  std::vector<vtkIsopointBlock> Blocks;
  std::vector<vtkIsopointInputState> States; // one for each block
  vtkIdType PointsWithoutArray = 0;
  std::map<std::size_t, Computed> Kept; // by leaf
};

/**
 * Calls visit(leaf, number) for each leaf of a composite data object, numbered in the order of
 * traversal, or for any other data object itself, with the number 0.
 */
void vtkForEachIsopointLeaf(
  vtkDataObject* input, const std::function<void(vtkDataObject* leaf, std::size_t number)>& visit);

#endif
