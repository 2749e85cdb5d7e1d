// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointBlocks_h
#define vtkIsopointBlocks_h

#include "vtkIsopointBlock.h"

#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace isopoint
{
struct Execution;
}
class vtkAbstractArray;
class vtkDataObject;
class vtkInformation;
class vtkPoints;

/**
 * An input that cannot be contoured; what() is a whole sentence with the remedy.
 */
struct vtkUnusableIsopointInput : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/**
 * The array that is to be contoured, as vtkAlgorithm::SetInputArrayToProcess() chose it.
 */
class vtkIsopointArrayChoice
{
public:
  explicit vtkIsopointArrayChoice(vtkInformation* inputArray);

  /// Whether the array is one of the points, of the cells, or the first of these that there is.
  bool MayBeOfPoints() const;
  bool MayBeOfCells() const;

  /// The array of that name or, where none was chosen, the active scalars; or null.
  vtkAbstractArray* Find(vtkDataSetAttributes* attributes) const;

  /// For an error message where no part of an input has the array.
  std::string DescribeMissing() const;

private:
  int Association;
  std::string Name; // empty: the active attribute
  int Attribute;
};

/**
 * Sees a data object as samples: each data set or hyper tree grid of it is a block. Centres of
 * cells are kept from one call to the next as long as the cells stay the same. Arrays that change
 * in place are to be marked by Modified(), other than ghosts and the mask of a hyper tree grid,
 * which are compared by what they hold.
 */
class vtkIsopointBlocks
{
public:
  /// Collects the blocks of an input. Blocks that lack the array, or have no points or cells, are
  /// left out.
  /// @throws vtkUnusableIsopointInput if no block can be contoured, or a block has an array of that
  /// name which is no scalar; std::bad_alloc; isopoint::Aborted
  void Collect(const isopoint::Execution& execution, vtkDataObject* input,
    const vtkIsopointArrayChoice& choice);

  const std::vector<vtkIsopointBlock>& GetBlocks() const { return this->Blocks; }

  /// What the blocks [begin, end) were read from.
  vtkIsopointState GetState(std::size_t begin, std::size_t end) const;

  /// Of the input, those without samples included.
  std::size_t GetNumberOfLeaves() const { return this->LeafCount; }

  /// Points (or cells) of blocks without the array.
  vtkIdType GetNumberOfPointsWithoutArray() const { return this->PointsWithoutArray; }

  /// Lets go of the input; centres stay.
  void ReleaseInput();

private:
  void AddLeaf(const isopoint::Execution& execution, vtkDataObject* leaf, std::size_t number,
    const vtkIsopointArrayChoice& choice);
  void AddPositions(const isopoint::Execution& execution, vtkDataObject* leaf, bool isOfCells,
    vtkIsopointBlock& block);

  struct Centers
  {
    vtkIsopointState Geometry;
    vtkSmartPointer<vtkPoints> Points;
  };

  std::vector<vtkIsopointBlock> Blocks;
  std::vector<vtkIsopointState> States; // of each block
  std::size_t LeafCount = 0;
  vtkIdType PointsWithoutArray = 0;
  std::map<std::size_t, Centers> KeptCenters; // by leaf
};

/**
 * Calls visit(leaf, number) for each data set or other leaf of a data object: itself with number 0
 * if it is no composite one.
 */
void vtkForEachIsopointLeaf(
  vtkDataObject* input, const std::function<void(vtkDataObject* leaf, std::size_t number)>& visit);

#endif
