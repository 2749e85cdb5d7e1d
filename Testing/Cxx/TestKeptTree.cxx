// SPDX-License-Identifier: GPL-3.0-or-later
// A kept tree: after any change of the filter or its input, the next update yields the output of a
// new filter.
#include "InputTesting.h"

#include "Common/vtkIsopointCompatibility.h"

#include "vtkMappedUnstructuredGrid.h"
#include "vtkMatrix3x3.h"
#include "vtkObjectFactory.h"

using namespace inputtesting;

namespace
{

/// A filter of the active scalars.
vtkSmartPointer<Isopoints> newFilterOf(vtkDataObject* input, int association)
{
  const auto filter = newFilter(input, 0.3);
  filter->SetInputArrayToProcess(0, 0, 0, association, vtkDataSetAttributes::SCALARS);
  return filter;
}

using Changes = std::vector<std::function<void(Isopoints*)>>;

/// Expects each change to alter the output, and to yield that of a new filter.
void expectFresh(vtkDataObject* input, int association, const Changes& changes)
{
  const auto kept = newFilterOf(input, association);
  const auto updated = [&]()
  {
    kept->Update();
    const auto fresh = newFilterOf(kept->GetInputDataObject(0, 0), association);
    fresh->KeepTreeOff();
    fresh->SetValue(0, kept->GetValue(0));
    fresh->SetAngle(kept->GetAngle());
    const std::vector<double> found = everythingOf(kept->GetOutput());
    EXPECT_FALSE(found.empty());
    EXPECT_EQ(found, everythingOf(outputOf(fresh)));
    EXPECT_EQ(kept->GetNumberOfSkippedSamples(), fresh->GetNumberOfSkippedSamples());
    return found;
  };
  std::vector<double> before = updated();
  for (std::size_t i = 0; i < changes.size(); ++i)
  {
    SCOPED_TRACE(testing::Message() << "change " << i);
    changes[i](kept);
    const std::vector<double> after = updated();
    EXPECT_NE(after, before);
    before = after;
  }
}

/// The same for changes that leave the data set's own modification time unchanged.
void expectReadAgain(
  vtkDataObject* input, int association, const std::vector<std::function<void()>>& changes)
{
  Changes checked;
  for (const auto& change : changes)
  {
    checked.push_back(
      [&](Isopoints* kept)
      {
        const vtkMTimeType time = input->vtkObject::GetMTime();
        change();
        EXPECT_EQ(input->vtkObject::GetMTime(), time);
        kept->Modified();
      });
  }
  expectFresh(input, association, checked);
}

void addScatteredFields(vtkDataSet* input)
{
  addScatteredField(input, vtkDataObject::POINT, input->GetNumberOfPoints());
  addScatteredField(input, vtkDataObject::CELL, input->GetNumberOfCells());
}

/// Changes some numbers of an array, and marks it as modified.
template <class Changed>
void change(vtkDataArray* array, vtkIdType first, vtkIdType step, const Changed& changed)
{
  for (vtkIdType i = first; i < array->GetNumberOfTuples(); i += step)
  {
    array->SetComponent(i, 0, changed(array->GetComponent(i, 0)));
  }
  array->Modified();
}

/// A block of cubes that are polyhedra.
vtkSmartPointer<vtkUnstructuredGrid> newPolyhedra()
{
  const auto cubes = structuredOf(newImage({ 4, 4, 4 }, 1.0));
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(cubes->GetPoints());
  for (vtkIdType cell = 0; cell < cubes->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> faces;
    faces->InsertNextId(6);
    for (int face = 0; face < 6; ++face)
    {
      faces->InsertNextId(4);
      for (const vtkIdType corner : *cubes->GetCell(cell)->GetFace(face)->GetPointIds())
      {
        faces->InsertNextId(corner);
      }
    }
    grid->InsertNextCell(VTK_POLYHEDRON, faces);
  }
  addScatteredFields(grid);
  return grid;
}

/// Tetrahedra whose corners are computed, as in a grid in a simulation's memory.
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

void forIds(vtkIdType begin, vtkIdType end, const std::function<void(vtkIdType)>& call)
{
  for (vtkIdType id = begin; id < end; ++id)
  {
    call(id);
  }
}

/// Calls visit(cursor at the root of a tree, index of the tree) for some trees.
template <class Visit>
void forTrees(vtkHyperTreeGrid* trees, vtkIdType begin, vtkIdType end, const Visit& visit)
{
  forIds(begin, end,
    [&](vtkIdType tree)
    {
      vtkNew<vtkHyperTreeGridNonOrientedCursor> cursor;
      trees->InitializeNonOrientedCursor(cursor, tree, true);
      visit(cursor, tree);
    });
}

/// Hyper trees of one node each, with enough ids for a node, its children, and the children of one
/// of these.
vtkSmartPointer<vtkHyperTreeGrid> newTrees()
{
  constexpr vtkIdType idsOfTree = 1 + 8 + 8;
  const auto trees = newHyperTreeGrid();
  forTrees(trees, 0, 64,
    [](vtkHyperTreeGridNonOrientedCursor* cursor, vtkIdType tree)
    { cursor->SetGlobalIndexStart(idsOfTree * tree); });
  const auto mask = newArray<vtkBitArray>("", idsOfTree * 64);
  mask->Fill(0.0);
  trees->SetMask(mask);
  addScatteredField(trees, vtkDataObject::CELL, idsOfTree * 64);
  return trees;
}

/// Splits the root of 30 trees, and one of its children.
void subdivide(vtkHyperTreeGrid* trees, unsigned char child)
{
  forTrees(trees, 0, 30,
    [child](vtkHyperTreeGridNonOrientedCursor* cursor, vtkIdType)
    {
      cursor->SubdivideLeaf();
      cursor->ToChild(child);
      cursor->SubdivideLeaf();
    });
}

} // namespace

TEST(KeptTree, OptionsAndArraysOfACloud)
{
  const auto cloud = newCloud(5000);
  expectFresh(cloud, ofPoints,
    { [](Isopoints* filter) { filter->SetValue(0, 0.7); },
      [](Isopoints* filter) { filter->SetAngle(30.0); },
      [&](Isopoints*)
      { change(distancesOf(cloud), 0, 3, [](double value) { return 0.9 * value; }); },
      [&](Isopoints*)
      {
        setScalars(
          cloud, [](const Vector& p) { return 0.4 + std::abs(p[2]); }, "distance");
      },
      [&](Isopoints*)
      {
        vtkNew<vtkPoints> moved;
        moved->DeepCopy(cloud->GetPoints());
        moved->SetPoint(17, 0.1, 0.2, 0.3);
        cloud->SetPoints(moved);
      },
      [&](Isopoints*) // only the data set itself is marked as modified
      {
        move(cloud->GetPoints(), [](const Vector& p) { return Vector{ p[1], 1.5 * p[0], p[2] }; });
        cloud->Modified();
      } });
}

// Two data sets share scalars that were modified after both of them.
TEST(KeptTree, AnotherDataSetWithTheSameScalars)
{
  const auto first = newCloud(3000);
  vtkNew<vtkPolyData> second;
  second->SetPoints(pointsOfDataSet(first));
  move(second->GetPoints(),
    [](const Vector& p) {
      return Vector{ p[2], 3.0 * p[0], p[1] * p[1] };
    });
  second->GetPointData()->SetScalars(distancesOf(first));
  distancesOf(first)->Modified();
  expectFresh(first, ofPoints, { [&](Isopoints* filter) { filter->SetInputData(second); } });
}

TEST(KeptTree, CoordinatesOfARectilinearGrid)
{
  const auto grid = rectilinearOf(newImage({ 8, 8, 8 }, 0.1));
  addScatteredFields(grid);
  expectReadAgain(grid, ofPoints,
    { [&]() { change(grid->GetXCoordinates(), 7, 1, [](double x) { return x + 5.0; }); } });
}

TEST(KeptTree, DirectionOfAnImage)
{
  const auto image = newImage({ 8, 8, 8 }, 0.25);
  addScatteredFields(image);
  expectReadAgain(image, ofCells,
    { [&]()
      {
        const double turned[9] = { 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0 };
        image->GetDirectionMatrix()->DeepCopy(turned);
      } });
}

// Some versions of VTK take the center of a polyhedron's bounding box, which its faces do not
// affect. Points that move unnoticed show that the cells were read again.
TEST(KeptTree, FacesOfPolyhedra)
{
  const auto grid = newPolyhedra();
  const auto shear = [&]()
  {
    move(grid->GetPoints(),
      [](const Vector& p) {
        return Vector{ p[0] + 0.1 * p[1], p[1], p[2] };
      });
  };
  expectReadAgain(grid, ofCells,
    { [&]()
      {
        vtkGetFacesOfPolyhedra(grid.Get()).first->Modified();
        shear();
      },
      [&]()
      {
        vtkGetFacesOfPolyhedra(grid.Get()).second->Modified();
        shear();
      } });
}

TEST(KeptTree, CellsOfAnUnstructuredGrid)
{
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(newCloud(400, VTK_DOUBLE)->GetPoints());
  for (vtkIdType cell = 0; cell < 200; ++cell)
  {
    const vtkIdType corners[4] = { cell, cell + 31, cell + 62, cell + 93 };
    grid->InsertNextCell(VTK_TETRA, 4, corners);
  }
  addScatteredFields(grid);
  vtkCellArray* const cells = grid->GetCells();
  expectReadAgain(grid, ofCells,
    { [&]() {
       change(cells->GetConnectivityArray(), 0, 3, [](double corner) { return 399.0 - corner; });
     },
      [&]() { change(vtkGetTypesOfCells(grid), 0, 1, [](double) { return VTK_POLY_LINE; }); },
      [&]()
      { change(cells->GetOffsetsArray(), 1, 2, [](double offset) { return offset + 2.0; }); } });
}

TEST(KeptTree, CellsOfAnExplicitStructuredGrid)
{
  const auto grid = explicitOf(newImage({ 8, 7, 6 }, 0.25));
  addScatteredFields(grid);
  vtkDataArray* const connectivity = grid->GetCells()->GetConnectivityArray();
  const auto reverse = [&]()
  {
    std::vector<double> corners = numbersOf(connectivity);
    for (vtkIdType i = 0; !corners.empty(); ++i, corners.pop_back())
    {
      connectivity->SetComponent(i, 0, corners.back());
    }
  };
  const std::vector<std::function<void()>> changes{ [&]()
    {
      reverse();
      connectivity->Modified();
    },
    [&]()
    {
      reverse();
      grid->GetCells()->Modified();
    } };
  expectReadAgain(grid, ofCells, changes);
  grid->GetCellData()->AddArray(
    ghostsOf(grid->GetNumberOfCells(), [](vtkIdType cell) { return cell < 200 ? hidden : 0; }));
  expectReadAgain(grid, ofPoints, changes);
}

TEST(KeptTree, CellsOfAMappedGrid)
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

TEST(KeptTree, BlankedCellsAndPoints)
{
  const auto check = [](const auto& grid)
  {
    SCOPED_TRACE(grid->GetClassName());
    addScatteredFields(grid);
    grid->BlankCell(0); // the first one adds an array, which modifies the cell data
    expectReadAgain(grid, ofCells,
      { [&]() { forIds(40, 200, [&](vtkIdType cell) { grid->BlankCell(cell); }); },
        [&]() { forIds(100, 150, [&](vtkIdType cell) { grid->UnBlankCell(cell); }); } });
    grid->BlankPoint(0);
    expectReadAgain(grid, ofPoints,
      { [&]() { forIds(300, 500, [&](vtkIdType point) { grid->BlankPoint(point); }); } });
  };
  check(newImage<vtkUniformGrid>({ 8, 8, 8 }, 0.25));
  check(structuredOf(newImage({ 8, 8, 8 }, 0.25)));
}

TEST(KeptTree, NodesAndMaskOfHyperTrees)
{
  const auto trees = newTrees();
  const auto others = newTrees();
  subdivide(others, 7);
  expectReadAgain(trees, ofCells,
    { [&]() { subdivide(trees, 0); },
      [&]()
      { forIds(0, 30, [&](vtkIdType tree) { trees->SetTree(tree, others->GetTree(tree)); }); },
      [&]()
      {
        forTrees(trees, 40, 60,
          [](vtkHyperTreeGridNonOrientedCursor* cursor, vtkIdType tree)
          { cursor->SetMask(tree % 2 == 0); });
      } });
}

TEST(KeptTree, IdsOfNodesOfHyperTrees)
{
  const auto trees = newHyperTreeGrid();
  constexpr vtkIdType ids = 1 + 8;
  forTrees(trees, 0, 64,
    [&](vtkHyperTreeGridNonOrientedCursor* cursor, vtkIdType tree)
    {
      cursor->SubdivideLeaf();
      for (vtkIdType vertex = 0; vertex < ids; ++vertex)
      {
        trees->GetTree(tree)->SetGlobalIndexFromLocal(vertex, ids * tree + vertex);
      }
    });
  addScatteredField(trees, vtkDataObject::CELL, ids * 64);
  expectReadAgain(trees, ofCells,
    { [&]()
      {
        forIds(0, 64,
          [&](vtkIdType tree)
          {
            trees->GetTree(tree)->SetGlobalIndexFromLocal(2, ids * tree + 5);
            trees->GetTree(tree)->SetGlobalIndexFromLocal(5, ids * tree + 2);
          });
      } });
}
