// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the input that a kept tree depends on change in place: the next update reads them again,
// although the modification time of the data set itself stays as it was.
#include "InputTesting.h"

#include "Input/vtkIsopointCompatibility.h"

#include "vtkIdList.h"
#include "vtkMappedUnstructuredGrid.h"
#include "vtkMatrix3x3.h"
#include "vtkObjectFactory.h"

using namespace inputtesting;

namespace
{

constexpr int ofPoints = vtkDataObject::FIELD_ASSOCIATION_POINTS;
constexpr int ofCells = vtkDataObject::FIELD_ASSOCIATION_CELLS;

/// Updates a filter, changes its input, and expects from the next update the output of a new
/// filter.
void expectReadAgain(
  vtkDataObject* input, int association, const std::vector<std::function<void()>>& changes)
{
  const auto kept = newFilter(input, association);
  kept->Update();
  for (std::size_t i = 0; i < changes.size(); ++i)
  {
    SCOPED_TRACE(testing::Message() << "change " << i);
    const std::vector<double> before = everythingOf(kept->GetOutput());
    EXPECT_FALSE(before.empty());
    const vtkMTimeType inputTime = input->vtkObject::GetMTime();
    changes[i]();
    EXPECT_EQ(input->vtkObject::GetMTime(), inputTime);
    kept->Modified();
    kept->Update();
    const auto fresh = newFilter(input, association);
    fresh->Update();
    EXPECT_EQ(everythingOf(kept->GetOutput()), everythingOf(fresh->GetOutput()));
    EXPECT_EQ(kept->GetNumberOfSkippedSamples(), fresh->GetNumberOfSkippedSamples());
    EXPECT_NE(everythingOf(kept->GetOutput()), before);
  }
}

/// Values that have nothing to do with positions.
void addScatteredField(vtkDataObject* input, int association, vtkIdType count)
{
  const auto f = newArray<vtkDoubleArray>("f", count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    f->SetValue(i, static_cast<double>((i * 37) % 101) / 101.0);
  }
  input->GetAttributes(association)->SetScalars(f);
}

void addScatteredFields(vtkDataSet* input)
{
  addScatteredField(input, vtkDataObject::POINT, input->GetNumberOfPoints());
  addScatteredField(input, vtkDataObject::CELL, input->GetNumberOfCells());
}

/// A block of polyhedra: cubes with one side, the lower (0) or the upper one (1), pressed in to a
/// ninth point at the center. Both kinds have the same points.
vtkSmartPointer<vtkUnstructuredGrid> newPolyhedra(int pressedSide)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const vtkIdType sides[6][4] = { { 0, 3, 2, 1 }, { 4, 5, 6, 7 }, { 0, 1, 5, 4 }, { 1, 2, 6, 5 },
    { 2, 3, 7, 6 }, { 3, 0, 4, 7 } };
  for (vtkIdType cell = 0; cell < 64; ++cell)
  {
    const double x = static_cast<double>(cell % 4);
    const double y = static_cast<double>(cell / 4 % 4);
    const double z = static_cast<double>(cell / 16);
    for (int corner = 0; corner < 8; ++corner)
    {
      points->InsertNextPoint(x + (corner % 4 == 1 || corner % 4 == 2 ? 1.0 : 0.0),
        y + (corner % 4 >= 2 ? 1.0 : 0.0), z + (corner >= 4 ? 1.0 : 0.0));
    }
    points->InsertNextPoint(x + 0.5, y + 0.5, z + 0.5);
    const vtkIdType first = 9 * cell;
    vtkNew<vtkIdList> faces;
    faces->InsertNextId(9);
    for (int side = 0; side < 6; ++side)
    {
      const bool isPressed = side == pressedSide;
      for (int edge = 0; edge < (isPressed ? 4 : 1); ++edge)
      {
        const vtkIdType triangle[3] = { sides[side][edge], sides[side][(edge + 1) % 4], 8 };
        const vtkIdType* const corners = isPressed ? triangle : sides[side];
        faces->InsertNextId(isPressed ? 3 : 4);
        for (int corner = 0; corner < (isPressed ? 3 : 4); ++corner)
        {
          faces->InsertNextId(first + corners[corner]);
        }
      }
    }
    grid->InsertNextCell(VTK_POLYHEDRON, faces);
  }
  grid->SetPoints(points);
  addScatteredFields(grid);
  return grid;
}

/// Moves points without a change of any modification time.
void moveUnnoticed(vtkPoints* points)
{
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double p[3];
    points->GetPoint(i, p);
    points->SetPoint(i, p[0] + 0.1 * p[1], p[1], p[2]);
  }
}

/// Tetrahedra whose corners are computed, as those of a grid in a simulation's memory may be.
class CellsElsewhere : public vtkObject
{
public:
  static CellsElsewhere* New();
  vtkTypeMacro(CellsElsewhere, vtkObject);

  vtkIdType GetNumberOfCells() { return 200; }
  int GetCellType(vtkIdType) { return VTK_TETRA; }
  void GetCellPoints(vtkIdType cell, vtkIdList* points)
  {
    points->SetNumberOfIds(4);
    for (vtkIdType corner = 0; corner < 4; ++corner)
    {
      points->SetId(corner, (this->Stride * cell + 29 * corner) % 400);
    }
  }
  void GetFaceStream(vtkIdType, vtkIdList*) {}
  void GetPolyhedronFaces(vtkIdType, vtkCellArray*) {}
  void GetPointCells(vtkIdType, vtkIdList* cells) { cells->Reset(); }
  int GetMaxCellSize() { return 4; }
  void GetIdsOfCellsOfType(int, vtkIdTypeArray*) {}
  int IsHomogeneous() { return 1; }
  void Allocate(vtkIdType, int = 0) {}
  vtkIdType InsertNextCell(int, vtkIdList*) { return -1; }
  template <class... Arguments>
  vtkIdType InsertNextCell(int, vtkIdType, const Arguments&...)
  {
    return -1;
  }
  void ReplaceCell(vtkIdType, int, const vtkIdType*) {}

  vtkIdType Stride = 13;
};
vtkStandardNewMacro(CellsElsewhere);

vtkMakeExportedMappedUnstructuredGrid(GridOfCellsElsewhere, CellsElsewhere, );
vtkStandardNewMacro(GridOfCellsElsewhere);

/// The number of ids of a node, its children, and the children of one of these.
constexpr vtkIdType idsOfTree = 1 + 8 + 8;

/// Hyper trees of one node each, with enough ids for three levels.
vtkSmartPointer<vtkHyperTreeGrid> newTrees()
{
  vtkSmartPointer<vtkHyperTreeGrid> trees = inputtesting::newHyperTreeGrid();
  vtkNew<vtkBitArray> mask;
  for (vtkIdType tree = 0; tree < 64; ++tree)
  {
    vtkNew<vtkHyperTreeGridNonOrientedCursor> cursor;
    trees->InitializeNonOrientedCursor(cursor, tree, true);
    cursor->SetGlobalIndexStart(idsOfTree * tree);
  }
  for (vtkIdType id = 0; id < idsOfTree * 64; ++id)
  {
    mask->InsertNextValue(0);
  }
  trees->SetMask(mask);
  addScatteredField(trees, vtkDataObject::CELL, idsOfTree * 64);
  return trees;
}

/// Splits the first node of some trees, and one of its children.
void subdivide(vtkHyperTreeGrid* trees, vtkIdType treeCount, unsigned char child)
{
  for (vtkIdType tree = 0; tree < treeCount; ++tree)
  {
    vtkNew<vtkHyperTreeGridNonOrientedCursor> cursor;
    trees->InitializeNonOrientedCursor(cursor, tree);
    cursor->SubdivideLeaf();
    cursor->ToChild(child);
    cursor->SubdivideLeaf();
  }
}

} // namespace

// In VTK versions that use the center of a polyhedron's bounding box its faces do not affect its
// center. Points that move unnoticed show that the cells were read again.
TEST(KeptTreeKey, FacesOfPolyhedra)
{
  const auto grid = newPolyhedra(0);
  const auto other = newPolyhedra(1);
  expectReadAgain(grid, ofCells,
    { [&]()
      {
        auto* const faces = vtkGetFacesOfPolyhedra(grid.Get()).first;
        faces->DeepCopy(vtkGetFacesOfPolyhedra(other.Get()).first);
        faces->Modified();
        moveUnnoticed(grid->GetPoints());
      },
      [&]()
      {
        vtkGetFacesOfPolyhedra(grid.Get()).second->Modified();
        moveUnnoticed(grid->GetPoints());
      } });
}

TEST(KeptTreeKey, CellsOfAnUnstructuredGrid)
{
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(newCloud(400, VTK_DOUBLE)->GetPoints());
  for (vtkIdType cell = 0; cell < 200; ++cell)
  {
    const vtkIdType corners[4] = { cell, cell + 31, cell + 62, cell + 93 };
    grid->InsertNextCell(VTK_TETRA, 4, corners);
  }
  addScatteredFields(grid);
  vtkDataArray* const connectivity = grid->GetCells()->GetConnectivityArray();
  vtkDataArray* const offsets = grid->GetCells()->GetOffsetsArray();
  expectReadAgain(grid, ofCells,
    { [&]()
      {
        for (vtkIdType i = 0; i < connectivity->GetNumberOfValues(); i += 3)
        {
          connectivity->SetComponent(i, 0, 399.0 - connectivity->GetComponent(i, 0));
        }
        connectivity->Modified();
      },
      [&]()
      {
        for (vtkIdType cell = 0; cell < 200; ++cell)
        {
          vtkGetTypesOfCells(grid)->SetComponent(cell, 0, VTK_POLY_LINE);
        }
        vtkGetTypesOfCells(grid)->Modified();
      },
      [&]()
      {
        for (vtkIdType cell = 1; cell < 200; cell += 2)
        {
          offsets->SetComponent(cell, 0, offsets->GetComponent(cell, 0) + 2.0);
        }
        offsets->Modified();
      } });
}

TEST(KeptTreeKey, CellsOfAnExplicitStructuredGrid)
{
  const vtkSmartPointer<vtkDataSet> input = everyGrid()[4];
  auto* const grid = vtkExplicitStructuredGrid::SafeDownCast(input);
  ASSERT_TRUE(grid);
  addScatteredFields(grid);
  vtkDataArray* const connectivity = grid->GetCells()->GetConnectivityArray();
  const auto turn = [&]()
  {
    const vtkIdType last = connectivity->GetNumberOfValues() - 1;
    for (vtkIdType i = 0; i < last - i; ++i)
    {
      const double corner = connectivity->GetComponent(i, 0);
      connectivity->SetComponent(i, 0, connectivity->GetComponent(last - i, 0));
      connectivity->SetComponent(last - i, 0, corner);
    }
  };
  const std::vector<std::function<void()>> changes{ [&]()
    {
      turn();
      connectivity->Modified();
    },
    [&]()
    {
      turn();
      grid->GetCells()->Modified();
    } };
  expectReadAgain(grid, ofCells, changes);

  const auto ghosts = newGhosts(grid->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < 200; ++cell)
  {
    ghosts->SetValue(cell, vtkDataSetAttributes::HIDDENCELL);
  }
  grid->GetCellData()->AddArray(ghosts);
  expectReadAgain(grid, ofPoints, changes);
}

TEST(KeptTreeKey, CellsOfAMappedGrid)
{
  vtkNew<GridOfCellsElsewhere> grid;
  grid->SetPoints(newCloud(400, VTK_DOUBLE)->GetPoints());
  addScatteredFields(grid);
  expectReadAgain(grid, ofCells,
    { [&]()
      {
        grid->GetImplementation()->Stride = 7;
        grid->GetImplementation()->Modified();
      } });
}

TEST(KeptTreeKey, BlankedCellsAndPoints)
{
  const auto image = newImage(8, 0.25, -1.0, -1.0, -1.0);
  const auto check = [](auto* grid)
  {
    SCOPED_TRACE(grid->GetClassName());
    addScatteredFields(grid);
    grid->BlankCell(0); // the first one adds an array, which modifies the cell data
    expectReadAgain(grid, ofCells,
      { [&]()
        {
          for (vtkIdType cell = 40; cell < 200; ++cell)
          {
            grid->BlankCell(cell);
          }
        },
        [&]()
        {
          for (vtkIdType cell = 100; cell < 150; ++cell)
          {
            grid->UnBlankCell(cell);
          }
        } });
    grid->BlankPoint(0);
    expectReadAgain(grid, ofPoints,
      { [&]()
        {
          for (vtkIdType point = 300; point < 600; point += 2)
          {
            grid->BlankPoint(point);
          }
        } });
  };
  vtkNew<vtkUniformGrid> uniform;
  uniform->ShallowCopy(image);
  check(uniform.Get());
  vtkNew<vtkStructuredGrid> structured;
  structured->SetDimensions(image->GetDimensions());
  structured->SetPoints(pointsOfDataSet(image));
  check(structured.Get());
}

TEST(KeptTreeKey, NodesAndMaskOfHyperTrees)
{
  const auto trees = newTrees();
  const auto others = newTrees();
  subdivide(others, 30, 7);
  expectReadAgain(trees, ofCells,
    { [&]() { subdivide(trees, 30, 0); },
      [&]()
      {
        for (vtkIdType tree = 0; tree < 30; ++tree)
        {
          trees->SetTree(tree, others->GetTree(tree));
        }
      },
      [&]()
      {
        for (vtkIdType tree = 40; tree < 60; tree += 2)
        {
          vtkNew<vtkHyperTreeGridNonOrientedCursor> cursor;
          trees->InitializeNonOrientedCursor(cursor, tree);
          cursor->SetMask(true);
        }
      } });
}

TEST(KeptTreeKey, IdsOfNodesOfHyperTrees)
{
  const vtkSmartPointer<vtkHyperTreeGrid> trees = inputtesting::newHyperTreeGrid();
  constexpr vtkIdType ids = 1 + 8;
  for (vtkIdType tree = 0; tree < 64; ++tree)
  {
    vtkNew<vtkHyperTreeGridNonOrientedCursor> cursor;
    trees->InitializeNonOrientedCursor(cursor, tree, true);
    cursor->SubdivideLeaf();
    for (vtkIdType vertex = 0; vertex < ids; ++vertex)
    {
      trees->GetTree(tree)->SetGlobalIndexFromLocal(vertex, ids * tree + vertex);
    }
  }
  addScatteredField(trees, vtkDataObject::CELL, ids * 64);
  expectReadAgain(trees, ofCells,
    { [&]()
      {
        for (vtkIdType tree = 0; tree < 64; ++tree)
        {
          trees->GetTree(tree)->SetGlobalIndexFromLocal(2, ids * tree + 5);
          trees->GetTree(tree)->SetGlobalIndexFromLocal(5, ids * tree + 2);
        }
      } });
}

TEST(KeptTreeKey, DirectionOfAnImage)
{
  const auto image = newImage(8, 0.25, -1.0, -1.0, -1.0);
  addScatteredFields(image);
  expectReadAgain(image, ofCells,
    { [&]()
      {
        image->GetDirectionMatrix()->SetElement(0, 0, 0.0);
        image->GetDirectionMatrix()->SetElement(0, 1, -1.0);
        image->GetDirectionMatrix()->SetElement(1, 0, 1.0);
        image->GetDirectionMatrix()->SetElement(1, 1, 0.0);
      } });
}
