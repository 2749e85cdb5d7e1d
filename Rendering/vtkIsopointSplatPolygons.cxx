// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatPolygons.h"

#include "vtkIsopointSplatMesh.h"
#include "vtkIsopointSplatShapes.h"
#include "vtkIsopointVertexCells.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataPipeline.h"
#include "vtkDataSet.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
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
#include "vtkType.h"
#include "vtkVersionMacros.h"

#include <algorithm>
#include <cerrno>
#include <limits>
#include <new>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkIsopointSplatPolygons);

namespace
{

void setGeometry(const vtkIsopointSplatMesh& mesh, int pointType, vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(pointType);
  points->SetNumberOfPoints(mesh.NumberOfVertices());
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(mesh.NumberOfVertices());
  vtkSMPTools::For(0, mesh.NumberOfVertices(),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        points->SetPoint(i, mesh.Vertices[static_cast<std::size_t>(i)].Place.GetData());
        normals->SetTypedTuple(i, mesh.Vertices[static_cast<std::size_t>(i)].Normal.GetData());
      }
    });
  output->SetPoints(points);
  output->GetPointData()->SetNormals(normals);
}

void setTriangles(const vtkIsopointSplatMesh& mesh, vtkPolyData* output)
{
  const vtkIdType count = mesh.NumberOfTriangles();
  vtkNew<vtkCellArray> triangles;
  if (std::max(3 * count, mesh.NumberOfVertices()) < std::numeric_limits<vtkTypeInt32>::max())
  {
    triangles->Use32BitStorage(); // half of the memory
  }
  triangles->AllocateExact(count, 3 * count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    triangles->InsertNextCell(3, mesh.Corners.data() + 3 * i);
  }
  output->SetPolys(triangles);
}

/// Calls of(begin, end) for ranges that make up all tuples of an array.
template <class Function>
void forTuples(vtkAbstractArray* array, vtkIdType tuples, const Function& of)
{
  // Eight values of a bit array share a byte; strings change a state of their array.
  if (vtkDataArray::SafeDownCast(array) && array->GetDataType() != VTK_BIT)
  {
    vtkSMPTools::For(0, tuples, of);
  }
  else
  {
    of(0, tuples);
  }
}

vtkSmartPointer<vtkAbstractArray> emptyLike(vtkAbstractArray* array, vtkIdType tuples)
{
  const auto copy = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
  copy->SetName(array->GetName());
  copy->SetNumberOfComponents(array->GetNumberOfComponents());
  copy->CopyComponentNames(array);
  copy->SetNumberOfTuples(tuples);
  return copy;
}

/// An array of points at the vertices: real numbers are the mean of those of the points that meet
/// there, others those of the first point.
vtkSmartPointer<vtkAbstractArray> atVertices(
  vtkAbstractArray* array, const vtkIsopointSplatMesh& mesh)
{
  const vtkIdType count = mesh.NumberOfVertices();
  const auto copy = emptyLike(array, count);
  const bool isReal = array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
  vtkDataArray* const from = isReal ? vtkDataArray::SafeDownCast(array) : nullptr;
  vtkDataArray* const to = vtkDataArray::SafeDownCast(copy);
  forTuples(array, count,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType vertex = begin; vertex < end; ++vertex)
      {
        const auto i = static_cast<std::size_t>(vertex);
        if (mesh.MeetsAt[i] != vertex)
        {
          continue;
        }
        const vtkIdType meeting = mesh.FirstMeeting[i + 1] - mesh.FirstMeeting[i];
        const vtkIdType* const points =
          mesh.MeetingPoints.data() + static_cast<std::size_t>(mesh.FirstMeeting[i]);
        copy->SetTuple(vertex, points[0], array);
        for (int component = 0; from && meeting > 1 && component < from->GetNumberOfComponents();
             ++component)
        {
          double sum = 0.0;
          for (vtkIdType k = 0; k < meeting; ++k)
          {
            sum += from->GetComponent(points[k], component);
          }
          to->SetComponent(vertex, component, sum / static_cast<double>(meeting));
        }
      }
    });
  forTuples(array, count,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType vertex = begin; vertex < end; ++vertex)
      {
        const vtkIdType first = mesh.MeetsAt[static_cast<std::size_t>(vertex)];
        if (first != vertex)
        {
          copy->SetTuple(vertex, first, copy);
        }
      }
    });
  return copy;
}

/// An array of cells at the triangles.
vtkSmartPointer<vtkAbstractArray> atTriangles(
  vtkAbstractArray* array, const vtkIsopointSplatMesh& mesh, const vtkIsopointVertexCells& cells)
{
  const auto copy = emptyLike(array, mesh.NumberOfTriangles());
  forTuples(array, static_cast<vtkIdType>(mesh.FirstTriangles.size()) - 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType point = begin; point < end; ++point)
      {
        const auto i = static_cast<std::size_t>(point);
        for (vtkIdType k = mesh.FirstTriangles[i]; k < mesh.FirstTriangles[i + 1]; ++k)
        {
          copy->SetTuple(k, cells.Any(point), array);
        }
      }
    });
  return copy;
}

/// An array of ids of points, each repeated from one offset to the next.
template <class IdOf>
vtkSmartPointer<vtkIdTypeArray> repeatedIds(
  const char* name, const std::vector<vtkIdType>& offsets, const IdOf& idOf)
{
  const auto array = vtkSmartPointer<vtkIdTypeArray>::New();
  array->SetName(name);
  array->SetNumberOfValues(offsets.back());
  for (std::size_t i = 0; i + 1 < offsets.size(); ++i)
  {
    for (vtkIdType k = offsets[i]; k < offsets[i + 1]; ++k)
    {
      array->SetValue(k, idOf(static_cast<vtkIdType>(i)));
    }
  }
  return array;
}

/// Whether an array says how a splat is drawn, and nothing about its point.
bool isOfSplat(vtkDataSetAttributes* attributes, vtkAbstractArray* array)
{
  const std::string name = array->GetName() ? array->GetName() : "";
  return array == attributes->GetNormals() || name == "SplatAxis" || name == "SplatPolygon" ||
         name == "Normals" || name == vtkDataSetAttributes::GhostArrayName() ||
         name == "vtkOriginalPointIds" || name == "vtkOriginalCellIds";
}

/// @param copied(array) the array at vertices or triangles
template <class Copied>
void copyArrays(vtkDataSetAttributes* from, vtkDataSetAttributes* to, const Copied& copied)
{
  for (int i = 0; i < from->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* const array = from->GetAbstractArray(i);
    if (isOfSplat(from, array))
    {
      continue;
    }
    const int added = to->AddArray(copied(array));
    // Ids that are to be unique are no longer.
    const int attribute = from->IsArrayAnAttribute(i);
    if (attribute >= 0 && attribute != vtkDataSetAttributes::GLOBALIDS &&
        attribute != vtkDataSetAttributes::PEDIGREEIDS)
    {
      to->SetActiveAttribute(added, attribute);
    }
  }
}

/// Whether each drawn point has a vertex cell.
bool haveVertices(const vtkIsopointVertexCells& cells, const vtkIsopointSplatMesh& mesh)
{
  for (std::size_t i = 0; i + 1 < mesh.FirstTriangles.size(); ++i)
  {
    if (mesh.FirstTriangles[i] < mesh.FirstTriangles[i + 1] &&
        cells.Any(static_cast<vtkIdType>(i)) < 0)
    {
      return false;
    }
  }
  return true;
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
  this->ErrorCode = vtkErrorCode::NoError;
  bool isDone = true;
  try
  {
    if (const auto data = vtkDataSet::SafeDownCast(input))
    {
      isDone = this->MakePolygons(data, vtkPolyData::SafeDownCast(output));
    }
    else if (const auto blocks = vtkCompositeDataSet::SafeDownCast(input))
    {
      const auto polygons = vtkCompositeDataSet::SafeDownCast(output);
      polygons->CopyStructure(blocks);
      const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
      const auto all = static_cast<double>(input->GetNumberOfElements(vtkDataObject::POINT));
      double done = 0.0;
      for (iterator->InitTraversal(); isDone && !iterator->IsDoneWithTraversal();
           iterator->GoToNextItem())
      {
        if (const auto block = vtkDataSet::SafeDownCast(iterator->GetCurrentDataObject()))
        {
          const auto count = static_cast<double>(block->GetNumberOfPoints());
          this->SetProgressShiftScale(done / std::max(all, 1.0), count / std::max(all, 1.0));
          done += count;
          vtkNew<vtkPolyData> made;
          isDone = this->MakePolygons(block, made);
          polygons->SetDataSet(iterator, made);
        }
      }
    }
  }
  catch (const std::bad_alloc&)
  {
    isDone = false;
    this->ErrorCode = ENOMEM;
    vtkErrorMacro("Out of memory: the splats of "
                  << input->GetNumberOfElements(vtkDataObject::POINT)
                  << " points are not drawn. Close other data, or pass fewer points.");
  }
  if (!isDone)
  {
    output->Initialize();
  }
  this->SetProgressShiftScale(0.0, 1.0);
  return 1;
}

//------------------------------------------------------------------------------
bool vtkIsopointSplatPolygons::MakePolygons(vtkDataSet* input, vtkPolyData* output)
{
  output->GetFieldData()->ShallowCopy(input->GetFieldData());
  const vtkIdType count = input->GetNumberOfPoints();
  if (count == 0)
  {
    return true;
  }
  const vtkIsopointVertexCells cells(input);
  const vtkIsopointSplatShapes shapes(
    input, cells, this->RadiusArrayName, this->Radius, this->RadiusScale);
  const std::string problem = shapes.Problem();
  if (!problem.empty())
  {
    vtkWarningMacro(<< problem);
  }
  double first[3];
  input->GetPoint(0, first); // fills what data sets compute at the first call
  const auto step = [this](double share)
  {
    this->UpdateProgress(share);
    return !this->GetAbortExecute();
  };
  // The shares of the time that parts take.
  constexpr double withMesh = 0.6;
  constexpr double withTriangles = 0.65;
  constexpr double withPoints = 0.95;
  vtkIsopointSplatMesh mesh;
  if (!mesh.Build(shapes, count, [&step](double share) { return step(withMesh * share); }))
  {
    return false;
  }
  setGeometry(mesh, typeOfPoints(input), output);
  setTriangles(mesh, output);
  if (!step(withTriangles))
  {
    return false;
  }
  copyArrays(input->GetPointData(), output->GetPointData(),
    [&mesh](vtkAbstractArray* array) { return atVertices(array, mesh); });
  output->GetPointData()->AddArray(
    repeatedIds("vtkOriginalPointIds", mesh.FirstVertices, [](vtkIdType point) { return point; }));
  if (!step(withPoints))
  {
    return false;
  }
  if (haveVertices(cells, mesh))
  {
    copyArrays(input->GetCellData(), output->GetCellData(),
      [&](vtkAbstractArray* array) { return atTriangles(array, mesh, cells); });
    output->GetCellData()->AddArray(repeatedIds("vtkOriginalCellIds", mesh.FirstTriangles,
      [&cells](vtkIdType point) { return cells.Any(point); }));
  }
  return true;
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
