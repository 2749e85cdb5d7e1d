// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatPolygons.h"

#include "vtkIsopointSplatShapes.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataPipeline.h"
#include "vtkDataSet.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkVersionMacros.h"

#include <algorithm>
#include <limits>
#include <new>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkIsopointSplatPolygons);

namespace
{

/// How many vertices and triangles lie before those of each point; one more entry at the end.
struct Offsets
{
  std::vector<vtkIdType> Vertices;
  std::vector<vtkIdType> Triangles;
};

Offsets offsetsOf(const vtkIsopointSplatShapes& shapes, vtkIdType count)
{
  Offsets offsets;
  offsets.Vertices.resize(static_cast<std::size_t>(count) + 1, 0);
  offsets.Triangles.resize(static_cast<std::size_t>(count) + 1, 0);
  vtkSMPTools::For(0, count,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType point = begin; point < end; ++point)
      {
        const vtkIsopointSplatFan fan = shapes.Fan(point);
        offsets.Vertices[static_cast<std::size_t>(point) + 1] = fan.Vertices;
        offsets.Triangles[static_cast<std::size_t>(point) + 1] = fan.Triangles;
      }
    });
  for (std::size_t i = 1; i < offsets.Vertices.size(); ++i)
  {
    offsets.Vertices[i] += offsets.Vertices[i - 1];
    offsets.Triangles[i] += offsets.Triangles[i - 1];
  }
  return offsets;
}

void setGeometry(const vtkIsopointSplatShapes& shapes, const Offsets& offsets, int pointType,
  vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(pointType);
  points->SetNumberOfPoints(offsets.Vertices.back());
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(offsets.Vertices.back());
  vtkSMPTools::For(0, static_cast<vtkIdType>(offsets.Vertices.size()) - 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType point = begin; point < end; ++point)
      {
        const vtkIsopointSplatFan fan = shapes.Fan(point);
        const vtkIdType first = offsets.Vertices[static_cast<std::size_t>(point)];
        for (int i = 0; i < fan.Vertices; ++i)
        {
          points->SetPoint(first + i, fan.Places[static_cast<std::size_t>(i)].GetData());
          normals->SetTuple(first + i, fan.Normals[static_cast<std::size_t>(i)].GetData());
        }
      }
    });
  output->SetPoints(points);
  output->GetPointData()->SetNormals(normals);
}

/// @tparam TArray of 32 bits where these suffice: half of the memory
template <class TArray>
void setTriangles(
  const vtkIsopointSplatShapes& shapes, const Offsets& offsets, vtkPolyData* output)
{
  using Value = typename TArray::ValueType;
  const vtkIdType count = offsets.Triangles.back();
  vtkNew<TArray> ends;
  ends->SetNumberOfValues(count + 1);
  vtkNew<TArray> corners;
  corners->SetNumberOfValues(3 * count);
  vtkSMPTools::For(0, static_cast<vtkIdType>(offsets.Vertices.size()) - 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType point = begin; point < end; ++point)
      {
        const vtkIsopointSplatFan fan = shapes.Fan(point);
        const vtkIdType firstVertex = offsets.Vertices[static_cast<std::size_t>(point)];
        const vtkIdType firstTriangle = offsets.Triangles[static_cast<std::size_t>(point)];
        for (int i = 0; i < fan.Triangles; ++i)
        {
          ends->SetValue(firstTriangle + i, static_cast<Value>(3 * (firstTriangle + i)));
          for (int corner = 0; corner < 3; ++corner)
          {
            corners->SetValue(3 * (firstTriangle + i) + corner,
              static_cast<Value>(firstVertex + vtkIsopointSplatCorner(fan, i, corner)));
          }
        }
      }
    });
  ends->SetValue(count, static_cast<Value>(3 * count));
  vtkNew<vtkCellArray> triangles;
  triangles->SetData(ends, corners);
  output->SetPolys(triangles);
}

/// A copy of an array, in which a tuple is repeated from one offset to the next.
/// @param sources the tuples; null: 0, 1, 2, ...
vtkSmartPointer<vtkAbstractArray> repeated(vtkAbstractArray* array,
  const std::vector<vtkIdType>& offsets, const std::vector<vtkIdType>* sources)
{
  const auto copy = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
  copy->SetName(array->GetName());
  copy->SetNumberOfComponents(array->GetNumberOfComponents());
  copy->CopyComponentNames(array);
  copy->SetNumberOfTuples(offsets.back());
  const auto fill = [&](vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType point = begin; point < end; ++point)
    {
      const auto i = static_cast<std::size_t>(point);
      for (vtkIdType tuple = offsets[i]; tuple < offsets[i + 1]; ++tuple)
      {
        copy->SetTuple(tuple, sources ? (*sources)[i] : point, array);
      }
    }
  };
  const auto count = static_cast<vtkIdType>(offsets.size()) - 1;
  if (vtkDataArray::SafeDownCast(array))
  {
    vtkSMPTools::For(0, count, fill);
  }
  else
  {
    fill(0, count); // strings change a state of their array
  }
  return copy;
}

void setIds(vtkDataSetAttributes* attributes, const char* name,
  const std::vector<vtkIdType>& offsets, const std::vector<vtkIdType>* sources)
{
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName(name);
  ids->SetNumberOfValues(offsets.back());
  vtkSMPTools::For(0, static_cast<vtkIdType>(offsets.size()) - 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType point = begin; point < end; ++point)
      {
        const auto i = static_cast<std::size_t>(point);
        for (vtkIdType tuple = offsets[i]; tuple < offsets[i + 1]; ++tuple)
        {
          ids->SetValue(tuple, sources ? (*sources)[i] : point);
        }
      }
    });
  attributes->AddArray(ids);
}

/// Whether an array says how a splat is drawn, and nothing about its point.
bool isOfSplat(vtkDataSetAttributes* attributes, vtkAbstractArray* array)
{
  const std::string name = array->GetName() ? array->GetName() : "";
  return array == attributes->GetNormals() || name == "SplatAxis" || name == "SplatPolygon" ||
         name == "Normals" || name == vtkDataSetAttributes::GhostArrayName() ||
         name == "vtkOriginalPointIds" || name == "vtkOriginalCellIds";
}

void repeatArrays(vtkDataSetAttributes* from, const std::vector<vtkIdType>& offsets,
  const std::vector<vtkIdType>* sources, vtkDataSetAttributes* to)
{
  for (int i = 0; i < from->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* const array = from->GetAbstractArray(i);
    if (isOfSplat(from, array))
    {
      continue;
    }
    const int added = to->AddArray(repeated(array, offsets, sources));
    // Ids that are to be unique are no longer.
    const int attribute = from->IsArrayAnAttribute(i);
    if (attribute >= 0 && attribute != vtkDataSetAttributes::GLOBALIDS &&
        attribute != vtkDataSetAttributes::PEDIGREEIDS)
    {
      to->SetActiveAttribute(added, attribute);
    }
  }
}

/// The first vertex cell of each point, or nothing if a drawn point has none.
std::vector<vtkIdType> vertexCells(vtkDataSet* data, const Offsets& offsets)
{
  std::vector<vtkIdType> cells(static_cast<std::size_t>(data->GetNumberOfPoints()), -1);
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    const int type = data->GetCellType(cell);
    if (type != VTK_VERTEX && type != VTK_POLY_VERTEX)
    {
      continue;
    }
    data->GetCellPoints(cell, points);
    for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
    {
      vtkIdType& own = cells[static_cast<std::size_t>(points->GetId(i))];
      own = own < 0 ? cell : own;
    }
  }
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    if (cells[i] < 0 && offsets.Triangles[i] < offsets.Triangles[i + 1])
    {
      return {};
    }
  }
  return cells;
}

int typeOfPoints(vtkDataSet* data)
{
  const auto points = vtkPointSet::SafeDownCast(data);
  return points && points->GetPoints() ? points->GetPoints()->GetDataType() : VTK_DOUBLE;
}

} // namespace

//------------------------------------------------------------------------------
vtkIsopointSplatPolygons::vtkIsopointSplatPolygons()
  : RadiusArrayName(nullptr)
{
  this->SetRadiusArrayName("Radius");
}

//------------------------------------------------------------------------------
vtkIsopointSplatPolygons::~vtkIsopointSplatPolygons()
{
  this->SetRadiusArrayName(nullptr);
}

//------------------------------------------------------------------------------
int vtkIsopointSplatPolygons::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

//------------------------------------------------------------------------------
vtkExecutive* vtkIsopointSplatPolygons::CreateDefaultExecutive()
{
  return vtkCompositeDataPipeline::New();
}

//------------------------------------------------------------------------------
int vtkIsopointSplatPolygons::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* const input = vtkDataObject::GetData(inputVector[0]);
  int type = VTK_POLY_DATA;
  if (vtkCompositeDataSet::SafeDownCast(input))
  {
    type = VTK_MULTIBLOCK_DATA_SET;
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
    // ParaView's geometry representation takes no such collections before.
    if (input->IsA("vtkPartitionedDataSetCollection"))
    {
      type = VTK_PARTITIONED_DATA_SET_COLLECTION;
    }
#endif
  }
  return vtkDataObjectAlgorithm::SetOutputDataObject(
    type, outputVector->GetInformationObject(0), /*exact=*/true);
}

//------------------------------------------------------------------------------
int vtkIsopointSplatPolygons::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* const input = vtkDataObject::GetData(inputVector[0]);
  vtkDataObject* const output = vtkDataObject::GetData(outputVector);
  try
  {
    if (const auto data = vtkDataSet::SafeDownCast(input))
    {
      this->MakePolygons(data, vtkPolyData::SafeDownCast(output));
    }
    else if (const auto blocks = vtkCompositeDataSet::SafeDownCast(input))
    {
      const auto polygons = vtkCompositeDataSet::SafeDownCast(output);
      polygons->CopyStructure(blocks);
      const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
      for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
      {
        if (const auto block = vtkDataSet::SafeDownCast(iterator->GetCurrentDataObject()))
        {
          vtkNew<vtkPolyData> made;
          this->MakePolygons(block, made);
          polygons->SetDataSet(iterator, made);
        }
      }
    }
  }
  catch (const std::bad_alloc&)
  {
    output->Initialize();
    vtkErrorMacro("Out of memory: the splats of "
                  << input->GetNumberOfElements(vtkDataObject::POINT)
                  << " points are not drawn. Close other data, or pass fewer points.");
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkIsopointSplatPolygons::MakePolygons(vtkDataSet* input, vtkPolyData* output)
{
  output->SetFieldData(input->GetFieldData());
  const vtkIdType count = input->GetNumberOfPoints();
  if (count == 0)
  {
    return;
  }
  const vtkIsopointSplatShapes shapes(
    input, this->RadiusArrayName, this->Radius, this->RadiusScale);
  const std::string problem = shapes.Problem();
  if (!problem.empty())
  {
    vtkWarningMacro(<< problem);
  }
  double first[3];
  input->GetPoint(0, first); // fills what data sets compute at the first call
  const Offsets offsets = offsetsOf(shapes, count);
  setGeometry(shapes, offsets, typeOfPoints(input), output);
  if (std::max(3 * offsets.Triangles.back(), offsets.Vertices.back()) <
      std::numeric_limits<vtkTypeInt32>::max())
  {
    setTriangles<vtkTypeInt32Array>(shapes, offsets, output);
  }
  else
  {
    setTriangles<vtkTypeInt64Array>(shapes, offsets, output);
  }
  repeatArrays(input->GetPointData(), offsets.Vertices, nullptr, output->GetPointData());
  setIds(output->GetPointData(), "vtkOriginalPointIds", offsets.Vertices, nullptr);
  const std::vector<vtkIdType> cells = vertexCells(input, offsets);
  if (!cells.empty())
  {
    repeatArrays(input->GetCellData(), offsets.Triangles, &cells, output->GetCellData());
    setIds(output->GetCellData(), "vtkOriginalCellIds", offsets.Triangles, &cells);
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatPolygons::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RadiusArrayName: " << (this->RadiusArrayName ? this->RadiusArrayName : "(none)")
     << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "RadiusScale: " << this->RadiusScale << "\n";
}
