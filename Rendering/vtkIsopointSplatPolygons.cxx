// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatPolygons.h"

#include "vtkIsopointSplatShapes.h"
#include "vtkIsopointVertexCells.h"

#include "Common/vtkIsopointArrays.h"
#include "Common/vtkIsopointSMPTools.h"
#include "Core/Base/Execution.h"
#include "Core/SplatMesh/SplatMesh.h"

#include "vtkAOSDataArrayTemplate.h"
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
#include "vtkSmartPointer.h"
#include "vtkType.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkVersionMacros.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <limits>
#include <new>
#include <set>
#include <string>

vtkStandardNewMacro(vtkIsopointSplatPolygons);

namespace
{

using isopoint::Execution;
using isopoint::SplatMesh;

void reportProgress(const Execution& execution, double share)
{
  execution.progress(share);
  isopoint::throwIfAborted(execution);
}

void setGeometry(
  const Execution& execution, const SplatMesh& mesh, int pointType, vtkPolyData* output)
{
  const auto count = static_cast<vtkIdType>(mesh.vertices.size());
  vtkNew<vtkPoints> points;
  points->SetDataType(pointType);
  vtkAllocateTuples(points->GetData(), count);
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  vtkAllocateTuples(normals, count);
  isopoint::forEachIndex(execution, mesh.vertices.size(),
    [&](std::size_t i)
    {
      points->SetPoint(static_cast<vtkIdType>(i), mesh.vertices[i].position.data());
      normals->SetTypedTuple(static_cast<vtkIdType>(i), mesh.vertices[i].normal.data());
    });
  output->SetPoints(points);
  output->GetPointData()->SetNormals(normals);
}

/// @tparam TArray vtkTypeInt32Array or vtkTypeInt64Array
template <class TArray>
void setTriangles(const Execution& execution, const SplatMesh& mesh, vtkPolyData* output)
{
  using Number = typename TArray::ValueType;
  const auto count = static_cast<vtkIdType>(mesh.triangles.size());
  vtkNew<TArray> offsets;
  vtkNew<TArray> connectivity;
  vtkAllocateTuples(offsets, count + 1);
  vtkAllocateTuples(connectivity, 3 * count);
  Number* const ends = offsets->GetPointer(0);
  Number* const corners = connectivity->GetPointer(0);
  ends[0] = 0;
  isopoint::forEachIndex(execution, mesh.triangles.size(),
    [&](std::size_t i)
    {
      ends[i + 1] = 3 * (static_cast<Number>(i) + 1);
      std::transform(mesh.triangles[i].begin(), mesh.triangles[i].end(), corners + 3 * i,
        [](std::size_t vertex) { return static_cast<Number>(vertex); });
    });
  vtkNew<vtkCellArray> triangles;
  triangles->SetData(offsets, connectivity);
  output->SetPolys(triangles);
}

/// Calls of(tuple) for each tuple of an array.
template <class Function>
void forTuples(
  const Execution& execution, vtkAbstractArray* array, std::size_t tuples, const Function& of)
{
  // Eight values of a bit array share a byte, and string arrays change internal state.
  const bool mayShare = vtkDataArray::SafeDownCast(array) && array->GetDataType() != VTK_BIT;
  isopoint::forEachIndex(mayShare ? execution : Execution{}, tuples, of);
}

/// Averages values of points at the vertices.
/// @returns false if the array has another type or memory layout
template <class T>
bool setMeans(
  const Execution& execution, const SplatMesh& mesh, vtkAbstractArray* array, vtkAbstractArray* to)
{
  const auto values = vtkAOSDataArrayTemplate<T>::FastDownCast(array);
  const auto means = vtkAOSDataArrayTemplate<T>::FastDownCast(to);
  if (values && means)
  {
    const auto components = static_cast<std::size_t>(values->GetNumberOfComponents());
    const T* const numbers = values->GetPointer(0);
    isopoint::meansAtVertices(
      execution, mesh, components,
      [&](std::size_t point, std::size_t i) { return numbers[components * point + i]; },
      means->GetPointer(0));
  }
  return values && means;
}

/// An array of points at the vertices. Real numbers are averaged over the points that meet there;
/// other values are those of the first point.
vtkSmartPointer<vtkAbstractArray> atVertices(
  const Execution& execution, vtkAbstractArray* array, const SplatMesh& mesh)
{
  const auto copy = vtkNewArrayLike(array, static_cast<vtkIdType>(mesh.vertices.size()));
  if (setMeans<float>(execution, mesh, array, copy) ||
      setMeans<double>(execution, mesh, array, copy))
  {
    return copy;
  }
  vtkDataArray* const reals = vtkIsReal(array) ? vtkDataArray::SafeDownCast(array) : nullptr;
  vtkDataArray* const means = vtkDataArray::SafeDownCast(copy);
  forTuples(execution, array, mesh.vertices.size(),
    [&](std::size_t vertex)
    {
      const auto tuple = static_cast<vtkIdType>(vertex);
      copy->SetTuple(tuple, static_cast<vtkIdType>(mesh.firstPointAt(vertex)), array);
      for (int i = 0; reals && i < reals->GetNumberOfComponents(); ++i)
      {
        means->SetComponent(tuple, i,
          mesh.meanAt(vertex, [&](std::size_t point)
            { return reals->GetComponent(static_cast<vtkIdType>(point), i); }));
      }
    });
  return copy;
}

/// @param idOf(i) the id at index i
template <class IdOf>
vtkSmartPointer<vtkIdTypeArray> newIds(
  const Execution& execution, const char* name, std::size_t count, const IdOf& idOf)
{
  const auto array = vtkSmartPointer<vtkIdTypeArray>::New();
  array->SetName(name);
  vtkAllocateTuples(array, static_cast<vtkIdType>(count));
  isopoint::forEachIndex(execution, count,
    [&](std::size_t i)
    { array->SetValue(static_cast<vtkIdType>(i), static_cast<vtkIdType>(idOf(i))); });
  return array;
}

/// Whether an array describes the shape of a splat rather than its point.
bool isOfSplat(vtkDataSetAttributes* attributes, vtkAbstractArray* array)
{
  static const std::set<std::string> names{ vtkSplatAxisArrayName, vtkSplatPolygonArrayName,
    "Normals", vtkDataSetAttributes::GhostArrayName(), vtkOriginalPointIdsArrayName,
    vtkOriginalCellIdsArrayName };
  return array == attributes->GetNormals() ||
         (array->GetName() && names.count(array->GetName()) > 0);
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
    const int attribute = from->IsArrayAnAttribute(i);
    const bool areUniqueIds = attribute == vtkDataSetAttributes::GLOBALIDS ||
                              attribute == vtkDataSetAttributes::PEDIGREEIDS;
    vtkAddAttribute(areUniqueIds ? -1 : attribute, copied(array), to); // they are repeated now
  }
}

} // namespace

vtkIsopointSplatPolygons::vtkIsopointSplatPolygons()
  : RadiusArrayName(nullptr)
{
  this->SetRadiusArrayName(vtkRadiusArrayName);
}

vtkIsopointSplatPolygons::~vtkIsopointSplatPolygons()
{
  this->SetRadiusArrayName(nullptr);
}

void vtkIsopointSplatPolygons::SetRadiusScale(double scale)
{
  if (scale < 0.0)
  {
    vtkWarningMacro("The radius scale " << scale
                                        << " is negative: nothing is drawn. Set it to 1 for"
                                        << " splats that close the surface.");
  }
  const double clamped = std::max(scale, 0.0);
  if (clamped != this->RadiusScale)
  {
    this->RadiusScale = clamped;
    this->Modified();
  }
}

int vtkIsopointSplatPolygons::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

vtkExecutive* vtkIsopointSplatPolygons::CreateDefaultExecutive()
{
  return vtkCompositeDataPipeline::New();
}

int vtkIsopointSplatPolygons::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* const input = vtkDataObject::GetData(inputVector[0]);
  int type = VTK_POLY_DATA;
  if (vtkCompositeDataSet::SafeDownCast(input))
  {
    type = VTK_MULTIBLOCK_DATA_SET;
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
    // Before VTK 9.3, ParaView's geometry representation does not accept such collections.
    if (input->IsA("vtkPartitionedDataSetCollection"))
    {
      type = VTK_PARTITIONED_DATA_SET_COLLECTION;
    }
#endif
  }
  return vtkDataObjectAlgorithm::SetOutputDataObject(
    type, outputVector->GetInformationObject(0), /*exact=*/true);
}

int vtkIsopointSplatPolygons::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* const input = vtkDataObject::GetData(inputVector[0]);
  vtkDataObject* const output = vtkDataObject::GetData(outputVector);
  this->ErrorCode = vtkErrorCode::NoError;
  std::set<std::string> problems; // each once, of all blocks
  try
  {
    if (const auto data = vtkDataSet::SafeDownCast(input))
    {
      problems.insert(this->MakePolygons(data, vtkPolyData::SafeDownCast(output)));
    }
    else if (const auto blocks = vtkCompositeDataSet::SafeDownCast(input))
    {
      const auto polygons = vtkCompositeDataSet::SafeDownCast(output);
      polygons->CopyStructure(blocks);
      const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
      const auto all = static_cast<double>(input->GetNumberOfElements(vtkDataObject::POINT));
      double done = 0.0;
      for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
      {
        if (const auto block = vtkDataSet::SafeDownCast(iterator->GetCurrentDataObject()))
        {
          const auto count = static_cast<double>(block->GetNumberOfPoints());
          this->SetProgressShiftScale(done / std::max(all, 1.0), count / std::max(all, 1.0));
          done += count;
          vtkNew<vtkPolyData> made;
          problems.insert(this->MakePolygons(block, made));
          polygons->SetDataSet(iterator, made);
        }
      }
    }
  }
  catch (const isopoint::Aborted&)
  {
    output->Initialize();
  }
  catch (const std::bad_alloc&)
  {
    output->Initialize();
    this->ErrorCode = ENOMEM;
    vtkErrorMacro("Out of memory: the splats of "
                  << input->GetNumberOfElements(vtkDataObject::POINT)
                  << " points are not drawn. Close other data, or pass fewer points.");
  }
  this->SetProgressShiftScale(0.0, 1.0);
  problems.erase("");
  for (const std::string& problem : problems)
  {
    vtkWarningMacro(<< problem);
  }
  return 1;
}

std::string vtkIsopointSplatPolygons::MakePolygons(vtkDataSet* input, vtkPolyData* output)
{
  output->GetFieldData()->ShallowCopy(input->GetFieldData());
  const vtkIdType count = input->GetNumberOfPoints();
  if (count == 0)
  {
    return {};
  }
  const vtkIsopointVertexCells cells(input);
  const vtkIsopointSplatShapes shapes(
    input, cells, this->RadiusArrayName, this->Radius, this->RadiusScale);
  double first[3];
  input->GetPoint(0, first); // computes what data sets cache
  const Execution execution = vtkMakeSMPExecution(this);
  // Shares of the progress.
  constexpr double withMesh = 0.6;
  constexpr double withTriangles = 0.65;
  constexpr double withPoints = 0.95;
  const SplatMesh mesh = isopoint::buildSplatMesh(isopoint::partOf(execution, 0.0, withMesh),
    static_cast<std::size_t>(count),
    [&shapes](std::size_t point) { return shapes.Fan(static_cast<vtkIdType>(point)); });
  setGeometry(execution, mesh, vtkGetTypeOfPoints(input), output);
  const bool areFew = std::max(3 * mesh.triangles.size(), mesh.vertices.size()) <
                      std::numeric_limits<vtkTypeInt32>::max(); // half of the memory
  areFew ? setTriangles<vtkTypeInt32Array>(execution, mesh, output)
         : setTriangles<vtkTypeInt64Array>(execution, mesh, output);
  reportProgress(execution, withTriangles);
  copyArrays(input->GetPointData(), output->GetPointData(),
    [&](vtkAbstractArray* array) { return atVertices(execution, array, mesh); });
  output->GetPointData()->AddArray(newIds(execution, vtkOriginalPointIdsArrayName,
    mesh.vertices.size(), [&mesh](std::size_t vertex) { return mesh.pointOfVertex[vertex]; }));
  reportProgress(execution, withPoints);
  const auto cellIds = newIds(execution, vtkOriginalCellIdsArrayName, mesh.triangles.size(),
    [&](std::size_t triangle)
    { return cells.Any(static_cast<vtkIdType>(mesh.pointOfTriangle(triangle))); });
  const vtkIdType* const ids = cellIds->GetPointer(0);
  if (std::any_of(ids, ids + mesh.triangles.size(), [](vtkIdType cell) { return cell < 0; }))
  {
    return shapes.Problem();
  }
  copyArrays(input->GetCellData(), output->GetCellData(),
    [&](vtkAbstractArray* array)
    {
      const auto copy = vtkNewArrayLike(array, static_cast<vtkIdType>(mesh.triangles.size()));
      forTuples(execution, array, mesh.triangles.size(),
        [&](std::size_t triangle)
        { copy->SetTuple(static_cast<vtkIdType>(triangle), ids[triangle], array); });
      return copy;
    });
  output->GetCellData()->AddArray(cellIds);
  return shapes.Problem();
}

void vtkIsopointSplatPolygons::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RadiusArrayName: " << (this->RadiusArrayName ? this->RadiusArrayName : "(none)")
     << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "RadiusScale: " << this->RadiusScale << "\n";
}
