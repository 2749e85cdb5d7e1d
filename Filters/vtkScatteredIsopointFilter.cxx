// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredIsopointFilter.h"

#include "Isopoint/AngleCriterion.h"
#include "Isopoint/IsosurfaceExtractor.h"
#include "Isopoint/SplatGeometry.h"
#include "vtkIsopointArrays.h"
#include "vtkIsopointExecution.h"
#include "vtkIsopointGeometry.h"
#include "vtkIsopointInput.h"
#include "vtkIsopointPlacement.h"

#include "vtkCellArray.h"
#include "vtkCompositeDataSet.h"
#include "vtkContourValues.h"
#include "vtkDataSet.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace
{

using isopoint::Execution;

/// What the tree was built from: the modification times of the objects that positions, scalars and
/// ghosts belong to. Each is unique among all objects, so equal ones mean the same objects,
/// unchanged; a maximum over several would not.
struct InputState
{
  std::vector<vtkMTimeType> Times;

  InputState() = default;

  InputState(vtkDataSet* input, vtkDataArray* scalars)
    : Times{ input->vtkObject::GetMTime(), scalars->GetMTime() }
  {
    if (auto* const pointSet = vtkPointSet::SafeDownCast(input))
    {
      this->Add(pointSet->GetPoints());
    }
    if (auto* const grid = vtkRectilinearGrid::SafeDownCast(input))
    {
      this->Add(grid->GetXCoordinates());
      this->Add(grid->GetYCoordinates());
      this->Add(grid->GetZCoordinates());
    }
    this->Add(input->GetPointData()->GetArray(vtkDataSetAttributes::GhostArrayName()));
  }

  void Add(vtkObject* object) { this->Times.push_back(object ? object->GetMTime() : 0); }

  bool operator==(const InputState& other) const { return this->Times == other.Times; }
};

vtkSmartPointer<vtkPoints> newOutputPoints(vtkDataSet* input, int precision, vtkIdType count)
{
  auto* const pointSet = vtkPointSet::SafeDownCast(input);
  const bool inputIsFloat =
    pointSet && pointSet->GetPoints() && pointSet->GetPoints()->GetDataType() == VTK_FLOAT;
  const bool single = precision == vtkAlgorithm::SINGLE_PRECISION ||
                      (precision == vtkAlgorithm::DEFAULT_PRECISION && inputIsFloat);
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(single ? VTK_FLOAT : VTK_DOUBLE);
  points->SetNumberOfPoints(count);
  return points;
}

vtkSmartPointer<vtkCellArray> newVertices(vtkIdType count)
{
  vtkNew<vtkIdTypeArray> offsets;
  vtkNew<vtkIdTypeArray> connectivity;
  offsets->SetNumberOfValues(count + 1);
  connectivity->SetNumberOfValues(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    offsets->SetValue(i, i);
    connectivity->SetValue(i, i);
  }
  offsets->SetValue(count, count);
  auto vertices = vtkSmartPointer<vtkCellArray>::New();
  vertices->SetData(offsets, connectivity);
  return vertices;
}

/// The names of a data set's point arrays, for an error message.
std::string arrayNames(vtkPointData* pointData)
{
  std::ostringstream names;
  for (int i = 0; i < pointData->GetNumberOfArrays(); ++i)
  {
    const char* const name = pointData->GetArrayName(i);
    names << (i > 0 ? ", " : "") << (name ? name : "(unnamed)");
  }
  return pointData->GetNumberOfArrays() > 0 ? names.str() : std::string("none");
}

} // namespace

class vtkScatteredIsopointFilter::Internals
{
public:
  /// What is wanted of fits around isopoints, if anything: splats need the samples' spacing.
  static std::optional<isopoint::FitRequest> FitRequestOf(const vtkScatteredIsopointFilter& filter)
  {
    using isopoint::FitOrder;
    const bool needsSplats = filter.ComputeNormals || filter.ComputeRadii ||
                             filter.ComputeSplatAxes || filter.ComputeSplatClips;
    const bool needsGradients =
      filter.ComputeGradients || (needsSplats && filter.NormalMethod == NORMALS_FROM_FIELD);
    switch (filter.Projection)
    {
      case LINEAR_FIT:
        return isopoint::FitRequest{ FitOrder::Linear, true };
      case QUADRATIC_FIT:
        return isopoint::FitRequest{ FitOrder::Quadratic, true };
      default:
        if (needsGradients)
        {
          return isopoint::FitRequest{ FitOrder::Quadratic, false };
        }
        return needsSplats || filter.ComputeProjectionOrders
                 ? std::optional<isopoint::FitRequest>({ FitOrder::None, false })
                 : std::nullopt;
    }
  }

  static vtkIsopointGeometry::Arrays WantedGeometry(const vtkScatteredIsopointFilter& filter)
  {
    vtkIsopointGeometry::Arrays wanted;
    wanted.Normals = filter.ComputeNormals != 0;
    wanted.Radius = filter.ComputeRadii != 0;
    wanted.SplatAxes = filter.ComputeSplatAxes != 0;
    wanted.SplatClip = filter.ComputeSplatClips != 0;
    wanted.Gradients = filter.ComputeGradients != 0;
    wanted.ProjectionOrder = filter.ComputeProjectionOrders != 0;
    wanted.IsProjected = filter.Projection != NO_PROJECTION;
    return wanted;
  }

  isopoint::IsosurfaceExtractor Extractor;
  InputState LoadedFrom;

  void Clear()
  {
    this->Extractor.clear();
    this->LoadedFrom = InputState();
  }
};

vtkStandardNewMacro(vtkScatteredIsopointFilter);

vtkScatteredIsopointFilter::vtkScatteredIsopointFilter()
  : Angle(isopoint::defaultAngle)
  , NumberOfNeighbors(isopoint::defaultNeighborCount)
  , Kept(new Internals)
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

vtkScatteredIsopointFilter::~vtkScatteredIsopointFilter() = default;

void vtkScatteredIsopointFilter::SetValue(int i, double value)
{
  this->ContourValues->SetValue(i, value);
}

double vtkScatteredIsopointFilter::GetValue(int i)
{
  return this->ContourValues->GetValue(i);
}

double* vtkScatteredIsopointFilter::GetValues()
{
  return this->ContourValues->GetValues();
}

void vtkScatteredIsopointFilter::GetValues(double* contourValues)
{
  this->ContourValues->GetValues(contourValues);
}

void vtkScatteredIsopointFilter::SetNumberOfContours(int number)
{
  this->ContourValues->SetNumberOfContours(number);
}

vtkIdType vtkScatteredIsopointFilter::GetNumberOfContours()
{
  return this->ContourValues->GetNumberOfContours();
}

void vtkScatteredIsopointFilter::GenerateValues(int numContours, double range[2])
{
  this->ContourValues->GenerateValues(numContours, range);
}

void vtkScatteredIsopointFilter::GenerateValues(int numContours, double rangeStart, double rangeEnd)
{
  this->ContourValues->GenerateValues(numContours, rangeStart, rangeEnd);
}

vtkMTimeType vtkScatteredIsopointFilter::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->ContourValues->GetMTime());
}

int vtkScatteredIsopointFilter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  // Taken, only to be refused with one clear error instead of being contoured block by block.
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

int vtkScatteredIsopointFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* const output = vtkPolyData::GetData(outputVector);
  this->NumberOfSkippedSamples = 0;
  this->NumberOfUnprojectedPoints = 0;
  if (vtkCompositeDataSet::GetData(inputVector[0]))
  {
    vtkErrorMacro(<< "The input is made of blocks. Merge them first (vtkAppendFilter, or ParaView's"
                  << " Merge Blocks), so that the surface runs across their borders.");
  }
  else if (vtkDataSet* const input = vtkDataSet::GetData(inputVector[0]))
  {
    vtkDataArray* const scalars =
      this->IsUsable(input) ? this->GetContouredArray(inputVector, input) : nullptr;
    if (scalars)
    {
      this->ExtractSafely(input, scalars, output);
    }
  }
  if (!this->KeepTree)
  {
    this->Kept->Clear();
  }
  return 1;
}

void vtkScatteredIsopointFilter::ExtractSafely(
  vtkDataSet* input, vtkDataArray* scalars, vtkPolyData* output)
{
  try
  {
    this->Extract(input, scalars, output);
  }
  catch (const isopoint::Aborted&)
  {
    output->Initialize();
  }
  catch (const std::bad_alloc&)
  {
    this->Kept->Clear();
    output->Initialize();
    vtkErrorMacro(<< "Out of memory while contouring " << input->GetNumberOfPoints()
                  << " points. Close other data, set KeepTree off, or pass fewer points.");
  }
  catch (const std::exception& error)
  {
    this->Kept->Clear();
    output->Initialize();
    vtkErrorMacro(<< "Cannot contour these points: " << error.what() << ".");
  }
}

bool vtkScatteredIsopointFilter::IsUsable(vtkDataSet* input)
{
  const double* const values = this->ContourValues->GetValues();
  const vtkIdType valueCount = this->ContourValues->GetNumberOfContours();
  if (std::any_of(values, values + valueCount, [](double value) { return std::isnan(value); }))
  {
    vtkErrorMacro(<< "An isovalue is not a number. See SetValue().");
    return false;
  }
  if (!(this->Angle >= 0.0 && this->Angle <= 180.0))
  {
    vtkErrorMacro(<< "The angle is " << this->Angle
                  << "; it must be within 0 and 180 degrees. See SetAngle().");
    return false;
  }
  if (!(this->GapFactor >= 0.0) || std::isinf(this->GapFactor))
  {
    vtkErrorMacro(<< "The gap factor is " << this->GapFactor
                  << "; it must be 0, which drops nothing, or a positive number. See"
                  << " SetGapFactor().");
    return false;
  }
  if (input->GetNumberOfPoints() == 0)
  {
    vtkErrorMacro(<< "The input has no points. Connect a data set with points and a scalar array.");
    return false;
  }
  return true;
}

vtkDataArray* vtkScatteredIsopointFilter::GetContouredArray(
  vtkInformationVector** inputVector, vtkDataSet* input)
{
  vtkInformation* const wanted = this->GetInputArrayInformation(0);
  const char* const name = wanted->Get(vtkDataObject::FIELD_NAME());
  int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  // ParaView passes an empty name where nothing was chosen.
  const bool isChosen = name && *name;
  vtkAbstractArray* const array =
    isChosen || !name ? this->GetInputAbstractArrayToProcess(0, inputVector, association)
                      : input->GetPointData()->GetScalars();
  const std::string remedy = " Choose one with SetInputArrayToProcess(); the point arrays are: " +
                             arrayNames(input->GetPointData()) + ".";
  if (!array)
  {
    if (isChosen)
    {
      vtkErrorMacro(<< "The input has no point array named \"" << name << "\"." << remedy);
    }
    else
    {
      vtkErrorMacro(<< "The input has no active point scalars." << remedy);
    }
    return nullptr;
  }
  const std::string described =
    std::string("The array \"") + (array->GetName() ? array->GetName() : "") + "\" ";
  if (association != vtkDataObject::FIELD_ASSOCIATION_POINTS ||
      array->GetNumberOfTuples() != input->GetNumberOfPoints())
  {
    vtkErrorMacro(<< described << "does not belong to the points. For cell data, take the cell"
                  << " centers first (vtkCellCenters, or ParaView's Cell Centers).");
    return nullptr;
  }
  auto* const scalars = vtkDataArray::SafeDownCast(array);
  if (!scalars)
  {
    vtkErrorMacro(<< described << "holds no numbers." << remedy);
    return nullptr;
  }
  if (scalars->GetNumberOfComponents() != 1)
  {
    vtkErrorMacro(<< described << "has " << scalars->GetNumberOfComponents()
                  << " components where a scalar is needed. Take one component or the magnitude"
                  << " first (vtkArrayCalculator, or ParaView's Calculator).");
    return nullptr;
  }
  return scalars;
}

void vtkScatteredIsopointFilter::Extract(
  vtkDataSet* input, vtkDataArray* scalars, vtkPolyData* output)
{
  constexpr double loadingShare = 0.1;
  constexpr double extractionShare = 0.7;
  const Execution execution = vtkMakeIsopointExecution(this, this->UseAllCores != 0);

  const InputState state(input, scalars);
  if (!(state == this->Kept->LoadedFrom))
  {
    this->Kept->LoadedFrom = InputState();
    vtkLoadIsopointInput(execution, input, scalars, this->Kept->Extractor);
    this->Kept->LoadedFrom = state;
  }
  this->NumberOfSkippedSamples = static_cast<vtkIdType>(this->Kept->Extractor.skippedCount());
  this->UpdateProgress(loadingShare);

  const double* const values = this->ContourValues->GetValues();
  const std::set<double> isovalues(values, values + this->ContourValues->GetNumberOfContours());
  std::vector<vtkContouredIsosurface> surfaces;
  std::size_t pointCount = 0;
  for (const double isovalue : isovalues)
  {
    const double share = (extractionShare - loadingShare) / static_cast<double>(isovalues.size());
    const double begin = loadingShare + share * static_cast<double>(surfaces.size());
    surfaces.push_back({ isovalue,
      this->Kept->Extractor.extract(vtkMakeIsopointStep(execution, this, begin, begin + share),
        isovalue, this->Angle, this->GapFactor, Internals::FitRequestOf(*this)) });
    pointCount += surfaces.back().Surface.points.size();
    isopoint::throwIfAborted(execution);
  }

  const auto count = static_cast<vtkIdType>(pointCount);
  const vtkSmartPointer<vtkPoints> points =
    newOutputPoints(input, this->OutputPointsPrecision, count);
  vtkIsopointGeometry geometry(Internals::WantedGeometry(*this), count);
  vtkIdType point = 0;
  for (vtkContouredIsosurface& surface : surfaces)
  {
    const auto shareUpTo = [=](std::size_t points)
    {
      return extractionShare + (1.0 - extractionShare) * static_cast<double>(points) /
                                 static_cast<double>(std::max<std::size_t>(pointCount, 1));
    };
    const auto before = static_cast<std::size_t>(point);
    const Execution step = vtkMakeIsopointStep(
      execution, this, shareUpTo(before), shareUpTo(before + surface.Surface.points.size()));
    const isopoint::SurfacePoints placed = vtkPlaceIsopoints(execution, input, scalars, surface);
    std::vector<isopoint::Splat> splats;
    if (geometry.NeedsSplats())
    {
      splats = isopoint::computeSplats(
        step, placed, { this->NumberOfNeighbors, this->NormalMethod == NORMALS_FROM_FIELD });
    }
    geometry.Append(placed, splats, points);
    point += static_cast<vtkIdType>(placed.positions.size());
    isopoint::throwIfAborted(execution);
  }
  this->NumberOfUnprojectedPoints =
    this->Projection == NO_PROJECTION ? count : geometry.GetNumberWithoutFit();

  output->SetPoints(points);
  output->SetVerts(newVertices(count));
  vtkPointData* const pointData = output->GetPointData();
  vtkInterpolateIsopointArrays(execution, input->GetPointData(), scalars, surfaces, pointData);
  if (this->ComputeScalars)
  {
    vtkAddContouredArray(scalars, surfaces, pointData);
  }
  for (const std::string& name : geometry.AddTo(pointData))
  {
    vtkWarningMacro(<< "The input's array \"" << name
                    << "\" gives way to the computed one of that name. Switch that one off or"
                    << " rename the input's to keep it.");
  }
  this->UpdateProgress(1.0);
}

void vtkScatteredIsopointFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto onOff = [](vtkTypeBool flag) { return flag ? "On" : "Off"; };
  os << indent << "Contour values:\n";
  this->ContourValues->PrintSelf(os, indent.GetNextIndent());
  os << indent << "Angle: " << this->Angle << "\n";
  os << indent << "GapFactor: " << this->GapFactor << "\n";
  os << indent << "ComputeNormals: " << onOff(this->ComputeNormals) << "\n";
  os << indent << "ComputeRadii: " << onOff(this->ComputeRadii) << "\n";
  os << indent << "ComputeScalars: " << onOff(this->ComputeScalars) << "\n";
  os << indent << "NumberOfNeighbors: " << this->NumberOfNeighbors << "\n";
  os << indent << "Projection: " << this->Projection << "\n";
  os << indent << "NormalMethod: " << this->NormalMethod << "\n";
  os << indent << "ComputeGradients: " << onOff(this->ComputeGradients) << "\n";
  os << indent << "ComputeSplatAxes: " << onOff(this->ComputeSplatAxes) << "\n";
  os << indent << "ComputeSplatClips: " << onOff(this->ComputeSplatClips) << "\n";
  os << indent << "ComputeProjectionOrders: " << onOff(this->ComputeProjectionOrders) << "\n";
  os << indent << "NumberOfUnprojectedPoints: " << this->NumberOfUnprojectedPoints << "\n";
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
  os << indent << "KeepTree: " << onOff(this->KeepTree) << "\n";
  os << indent << "UseAllCores: " << onOff(this->UseAllCores) << "\n";
  os << indent << "NumberOfSkippedSamples: " << this->NumberOfSkippedSamples << "\n";
}
