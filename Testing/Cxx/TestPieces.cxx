// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces of the output of one process: together they are the whole, with no point and no triangle
// twice.
#include "FilterTesting.h"

#include "vtkScatteredIsosurfaceFilter.h"

#include "vtkCellData.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"

#include <cstring>
#include <functional>
#include <numeric>
#include <set>
#include <string>
#include <vector>

using namespace filtertesting;

namespace
{

/// A reader of a cloud in pieces.
class PieceReader : public vtkPolyDataAlgorithm
{
public:
  static PieceReader* New();
  vtkTypeMacro(PieceReader, vtkPolyDataAlgorithm);

  vtkSmartPointer<vtkPolyData> Cloud;
  int Executions = 0;

protected:
  PieceReader() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* out) override
  {
    out->GetInformationObject(0)->Set(CAN_HANDLE_PIECE_REQUEST(), 1);
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* out) override
  {
    vtkInformation* const info = out->GetInformationObject(0);
    const int piece = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER());
    const int pieces = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES());
    ++this->Executions;
    vtkNew<vtkIdList> chosen;
    for (vtkIdType i = piece; i < this->Cloud->GetNumberOfPoints(); i += pieces)
    {
      chosen->InsertNextId(i);
    }
    auto* const data = vtkPolyData::GetData(out);
    vtkNew<vtkPoints> points;
    this->Cloud->GetPoints()->GetPoints(chosen, points);
    data->SetPoints(points);
    vtkNew<vtkIdList> places;
    places->SetNumberOfIds(chosen->GetNumberOfIds());
    std::iota(places->begin(), places->end(), 0);
    data->GetPointData()->CopyAllocate(this->Cloud->GetPointData());
    data->GetPointData()->CopyData(this->Cloud->GetPointData(), chosen, places);
    return 1;
  }
};

vtkStandardNewMacro(PieceReader);

vtkSmartPointer<vtkPolyData> newCloudWithNames(vtkIdType count)
{
  auto cloud = newCloud(count);
  vtkNew<vtkStringArray> names;
  names->SetName("name");
  for (vtkIdType i = 0; i < count; ++i)
  {
    names->InsertNextValue(std::to_string(i));
  }
  cloud->GetPointData()->AddArray(names);
  return cloud;
}

/// A hash of whatever is added to it.
class Digest
{
public:
  void Add(std::size_t number) { this->Value = (this->Value ^ number) * 1099511628211u; }
  void Add(double number)
  {
    std::size_t bits = 0;
    std::memcpy(&bits, &number, sizeof(number));
    this->Add(bits);
  }
  void Add(const std::string& text) { this->Add(std::hash<std::string>()(text)); }

  void Add(vtkDataSetAttributes* attributes, vtkIdType id)
  {
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* const array = attributes->GetAbstractArray(i);
      this->Add(std::string(array->GetName()));
      this->Add(static_cast<std::size_t>(attributes->IsArrayAnAttribute(i)));
      for (int k = 0; k < array->GetNumberOfComponents(); ++k)
      {
        if (auto* const numbers = vtkDataArray::SafeDownCast(array))
        {
          this->Add(numbers->GetComponent(id, k));
        }
        else
        {
          this->Add(std::string(vtkStringArray::SafeDownCast(array)->GetValue(id)));
        }
      }
    }
  }

  std::size_t Value = 14695981039346656037u;
};

/// The cells with all their arrays and points, in their order.
std::vector<std::size_t> describeCells(vtkPolyData* surface)
{
  std::vector<std::size_t> cells;
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    Digest digest;
    digest.Add(static_cast<std::size_t>(surface->GetCellType(cell)));
    digest.Add(static_cast<std::size_t>(surface->GetPoints()->GetDataType()));
    digest.Add(surface->GetCellData(), cell);
    surface->GetCellPoints(cell, corners);
    for (const vtkIdType corner : *corners)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        digest.Add(surface->GetPoint(corner)[axis]);
      }
      digest.Add(surface->GetPointData(), corner);
    }
    cells.push_back(digest.Value);
  }
  return cells;
}

vtkIdType countUsedPoints(vtkPolyData* surface)
{
  std::set<vtkIdType> used;
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    surface->GetCellPoints(cell, corners);
    used.insert(corners->begin(), corners->end());
  }
  return static_cast<vtkIdType>(used.size());
}

std::vector<vtkPolyData*> leavesOf(vtkDataObject* output)
{
  if (auto* const surface = vtkPolyData::SafeDownCast(output))
  {
    return { surface };
  }
  std::vector<vtkPolyData*> leaves;
  auto* const blocks = vtkMultiBlockDataSet::SafeDownCast(output);
  for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
  {
    leaves.push_back(vtkPolyData::SafeDownCast(blocks->GetBlock(i)));
  }
  return leaves;
}

/// Expects the whole output from all pieces together, in its order.
/// @param prepare sets a filter up
template <class TFilter, class Prepare>
void expectPieces(const Prepare& prepare)
{
  vtkNew<TFilter> undivided;
  prepare(undivided);
  undivided->Update();
  const std::vector<vtkPolyData*> whole = leavesOf(undivided->GetOutputDataObject(0));
  ASSERT_GT(whole.front()->GetNumberOfCells(), 100);
  for (const int pieces : { 1, 2, 7 })
  {
    SCOPED_TRACE(testing::Message() << undivided->GetClassName() << " in pieces: " << pieces);
    vtkNew<TFilter> divided;
    prepare(divided);
    std::vector<std::vector<std::size_t>> cells(whole.size());
    vtkIdType points = 0;
    for (int piece = 0; piece < pieces; ++piece)
    {
      const int ghostLevels = piece % 2; // pieces have no ghosts
      divided->UpdatePiece(piece, pieces, ghostLevels);
      EXPECT_EQ(divided->GetNumberOfExtractedPoints(), undivided->GetNumberOfExtractedPoints());
      const std::vector<vtkPolyData*> leaves = leavesOf(divided->GetOutputDataObject(0));
      ASSERT_EQ(leaves.size(), whole.size());
      for (std::size_t i = 0; i < leaves.size(); ++i)
      {
        const std::vector<std::size_t> some = describeCells(leaves[i]);
        EXPECT_NEAR(static_cast<double>(some.size()),
          static_cast<double>(whole[i]->GetNumberOfCells()) / pieces, 1.0);
        cells[i].insert(cells[i].end(), some.begin(), some.end());
        points += leaves[i]->GetNumberOfPoints();
        EXPECT_EQ(countUsedPoints(leaves[i]), leaves[i]->GetNumberOfPoints());
      }
    }
    vtkIdType wholePoints = 0;
    for (std::size_t i = 0; i < whole.size(); ++i)
    {
      EXPECT_EQ(cells[i], describeCells(whole[i]));
      wholePoints += whole[i]->GetNumberOfPoints();
    }
    const bool areTriangles = whole.front()->GetNumberOfPolys() > 0;
    EXPECT_GE(points, wholePoints);
    EXPECT_TRUE(areTriangles || points == wholePoints);
  }
}

template <class TFilter>
void expectPiecesOfEveryInput()
{
  vtkNew<PieceReader> reader;
  reader->Cloud = newCloudWithNames(6000);
  expectPieces<TFilter>(
    [&](TFilter* filter)
    {
      filter->SetInputConnection(reader->GetOutputPort());
      filter->GenerateValues(2, 0.6, 0.8);
    });
  EXPECT_EQ(reader->Executions, 1); // all pieces are of the same, whole input

  vtkNew<vtkImageData> image;
  image->SetDimensions(14, 14, 14);
  image->SetOrigin(-6.5, -6.5, -6.5);
  const auto distance = newArray<vtkDoubleArray>("distance", image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double* const p = image->GetPoint(i);
    distance->SetValue(i, std::hypot(p[0], p[1], p[2]));
  }
  image->GetPointData()->SetScalars(distance);
  expectPieces<TFilter>(
    [&](TFilter* filter)
    {
      filter->SetInputData(image);
      filter->SetValue(0, 5.3);
    });

  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, newCloud(3000));
  blocks->SetBlock(1, newCloud(4000));
  for (const bool byBlock : { false, true })
  {
    expectPieces<TFilter>(
      [&](TFilter* filter)
      {
        filter->SetInputData(blocks);
        filter->SetContourBlocks(byBlock);
        filter->SetValue(0, 0.7);
      });
  }
}

} // namespace

TEST(Pieces, OfPointsAreTheWholeTogether)
{
  expectPiecesOfEveryInput<vtkScatteredIsopointFilter>();
}

TEST(Pieces, OfTrianglesAreTheWholeTogether)
{
  expectPiecesOfEveryInput<vtkScatteredIsosurfaceFilter>();
}

TEST(Pieces, OfAnEmptySurfaceAreEmptyAndHaveItsArrays)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(newCloud(1000));
  filter->SetValue(0, 99.0);
  filter->Update();
  const int arrays = filter->GetOutput()->GetPointData()->GetNumberOfArrays();
  for (int piece = 0; piece < 3; ++piece)
  {
    filter->UpdatePiece(piece, 3, 0);
    expectEmpty(filter->GetOutput());
    EXPECT_EQ(filter->GetOutput()->GetPointData()->GetNumberOfArrays(), arrays);
  }
}

TEST(Pieces, TheWholeFollowsAPiece)
{
  vtkNew<vtkScatteredIsosurfaceFilter> filter;
  filter->SetInputData(newCloud(5000));
  filter->SetValue(0, 0.7);
  filter->Update();
  const std::vector<std::size_t> whole = describeCells(filter->GetOutput());
  filter->UpdatePiece(1, 2, 0);
  EXPECT_LT(describeCells(filter->GetOutput()).size(), whole.size());
  filter->UpdatePiece(0, 1, 0);
  EXPECT_EQ(describeCells(filter->GetOutput()), whole);
}
