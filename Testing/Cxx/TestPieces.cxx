// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces of the output of one process: together they are the whole, with no point and no triangle
// twice.
#include "InputTesting.h"

#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <cstring>
#include <set>

using namespace inputtesting;

namespace
{

/// Yields every n-th sample of a cloud for a piece of n.
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
    using Pipeline = vtkStreamingDemandDrivenPipeline;
    vtkInformation* const info = out->GetInformationObject(0);
    ++this->Executions;
    vtkPolyData::GetData(out)->ShallowCopy(everyNth(this->Cloud,
      info->Get(Pipeline::UPDATE_PIECE_NUMBER()), info->Get(Pipeline::UPDATE_NUMBER_OF_PIECES())));
    return 1;
  }
};

vtkStandardNewMacro(PieceReader);

std::string bytesOf(double number)
{
  std::string bytes(sizeof(number), ' ');
  std::memcpy(bytes.data(), &number, sizeof(number));
  return bytes;
}

void append(std::string& text, vtkDataSetAttributes* attributes, vtkIdType id)
{
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* const array = attributes->GetAbstractArray(i);
    text += array->GetName() + std::to_string(attributes->IsArrayAnAttribute(i));
    const vtkIdType components = array->GetNumberOfComponents();
    for (vtkIdType value = components * id; value < components * (id + 1); ++value)
    {
      const vtkVariant variant = array->GetVariantValue(value);
      text += variant.IsString() ? std::string(variant.ToString()) : bytesOf(variant.ToDouble());
    }
  }
}

/// The cells with all their arrays and points, in their order. Expects that they use all points.
std::vector<std::string> describeCells(vtkPolyData* surface)
{
  std::vector<std::string> cells;
  std::set<vtkIdType> used;
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    cells.push_back(std::to_string(surface->GetCellType(cell)) + " " +
                    std::to_string(surface->GetPoints()->GetDataType()));
    append(cells.back(), surface->GetCellData(), cell);
    surface->GetCellPoints(cell, corners);
    used.insert(corners->begin(), corners->end());
    for (const vtkIdType corner : *corners)
    {
      const Vector place = placeOf(surface, corner);
      cells.back() += bytesOf(place[0]) + bytesOf(place[1]) + bytesOf(place[2]);
      append(cells.back(), surface->GetPointData(), corner);
    }
  }
  EXPECT_EQ(static_cast<vtkIdType>(used.size()), surface->GetNumberOfPoints());
  return cells;
}

/// Expects the whole output from all pieces together, in its order.
/// @param prepare sets a filter up
template <class TFilter>
void expectPieces(const std::function<void(TFilter*)>& prepare)
{
  vtkNew<TFilter> undivided;
  prepare(undivided);
  undivided->Update();
  const std::vector<vtkPolyData*> whole = surfacesOf(undivided->GetOutputDataObject(0));
  ASSERT_GT(whole.front()->GetNumberOfCells(), 100);
  for (const int pieces : { 1, 2, 7 })
  {
    SCOPED_TRACE(testing::Message() << undivided->GetClassName() << " in pieces: " << pieces);
    vtkNew<TFilter> divided;
    prepare(divided);
    std::vector<std::vector<std::string>> cells(whole.size());
    vtkIdType points = 0;
    for (int piece = 0; piece < pieces; ++piece)
    {
      const int ghostLevels = piece % 2; // pieces have no ghosts
      divided->UpdatePiece(piece, pieces, ghostLevels);
      EXPECT_EQ(divided->GetNumberOfExtractedPoints(), undivided->GetNumberOfExtractedPoints());
      const std::vector<vtkPolyData*> surfaces = surfacesOf(divided->GetOutputDataObject(0));
      ASSERT_EQ(surfaces.size(), whole.size());
      for (std::size_t i = 0; i < surfaces.size(); ++i)
      {
        const std::vector<std::string> some = describeCells(surfaces[i]);
        EXPECT_NEAR(static_cast<double>(some.size()),
          static_cast<double>(whole[i]->GetNumberOfCells()) / pieces, 1.0);
        cells[i].insert(cells[i].end(), some.begin(), some.end());
        points += surfaces[i]->GetNumberOfPoints();
      }
    }
    vtkIdType wholePoints = 0;
    for (std::size_t i = 0; i < whole.size(); ++i)
    {
      EXPECT_TRUE(cells[i] == describeCells(whole[i])) << "surface " << i;
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
  reader->Cloud = newCloud(6000);
  reader->Cloud->GetPointData()->AddArray(
    textsOf("name", 6000, [](vtkIdType i) { return std::to_string(i); }));
  expectPieces<TFilter>(
    [&](TFilter* filter)
    {
      filter->SetInputConnection(reader->GetOutputPort());
      filter->GenerateValues(2, 0.6, 0.8);
    });
  EXPECT_EQ(reader->Executions, 1); // all pieces are of the same, whole input

  const auto image = newImage({ 13, 13, 13 }, 1.0, { -6.5, -6.5, -6.5 });
  setScalars(image, length);
  expectPieces<TFilter>(
    [&](TFilter* filter)
    {
      filter->SetInputData(image);
      filter->SetValue(0, 5.3);
    });
  for (const bool byBlock : { false, true })
  {
    expectPieces<TFilter>(
      [&](TFilter* filter)
      {
        filter->SetInputData(blocksOf({ newCloud(3000), newCloud(4000) }));
        filter->SetContourBlocks(byBlock);
        filter->SetValue(0, 0.7);
      });
  }
}

} // namespace

TEST(Pieces, OfPointsAreTheWholeTogether)
{
  expectPiecesOfEveryInput<Isopoints>();
}

TEST(Pieces, OfTrianglesAreTheWholeTogether)
{
  expectPiecesOfEveryInput<Isosurface>();
}

TEST(Pieces, HaveTheArraysOfTheWhole)
{
  for (const double isovalue : { 0.7, 99.0 }) // the second has no surface
  {
    const auto filter = newFilter(newCloud(1000), isovalue);
    const int arrays = outputOf(filter)->GetPointData()->GetNumberOfArrays();
    for (const int piece : { 0, 1, 2 })
    {
      filter->UpdatePiece(piece, 3, 0);
      EXPECT_EQ(filter->GetOutput()->GetPointData()->GetNumberOfArrays(), arrays);
      EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints() > 0, isovalue < 1.0);
      EXPECT_EQ(filter->GetOutput()->GetNumberOfCells() > 0, isovalue < 1.0);
      for (const char* const name : { "SplatAxis", "SplatPolygon" })
      {
        vtkDataArray* const array = filter->GetOutput()->GetCellData()->GetArray(name);
        EXPECT_EQ(array->GetInformation()->Get(vtkAbstractArray::GUI_HIDE()), 1) << name;
      }
    }
  }
}

TEST(Pieces, TheWholeFollowsAPiece)
{
  const auto filter = newFilter<Isosurface>(newCloud(5000));
  const std::vector<std::string> whole = describeCells(outputOf(filter));
  filter->UpdatePiece(1, 2, 0);
  EXPECT_LT(describeCells(filter->GetOutput()).size(), whole.size());
  filter->UpdatePiece(0, 1, 0);
  EXPECT_TRUE(describeCells(filter->GetOutput()) == whole);
}
