// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredIsopointFilter.h"

#include "Isopoint/Neighbors/AngleCriterion.h"
#include "Isopoint/IsosurfaceExtractor.h"
#include "Isopoint/Splat/SplatGeometry.h"
#include "Isopoint/Extraction/Thinning.h"
#include "vtkIsopointAllocation.h"
#include "vtkIsopointArrays.h"
#include "vtkIsopointBlocks.h"
#include "vtkIsopointExecution.h"
#include "vtkIsopointGathering.h"
#include "vtkIsopointGeometry.h"
#include "vtkIsopointInput.h"
#include "vtkIsopointPlacement.h"

#include "vtkCellArray.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkContourValues.h"
#include "vtkDataSet.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUniformGridAMR.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <map>
#include <new>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace
{

using isopoint::Execution;

vtkSmartPointer<vtkPoints> newOutputPoints(vtkDataSet* input, int precision, vtkIdType count)
{
  const bool single = precision == vtkAlgorithm::SINGLE_PRECISION ||
                      (precision == vtkAlgorithm::DEFAULT_PRECISION && vtkHasFloatPositions(input));
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(single ? VTK_FLOAT : VTK_DOUBLE);
  vtkAllocateTuples(points->GetData(), count);
  return points;
}

vtkSmartPointer<vtkCellArray> newVertices(vtkIdType count)
{
  vtkNew<vtkIdTypeArray> offsets;
  vtkNew<vtkIdTypeArray> connectivity;
  vtkAllocateTuples(offsets, count + 1);
  vtkAllocateTuples(connectivity, count);
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

/// An empty output for a composite input that is contoured block by block.
vtkSmartPointer<vtkDataObject> newCompositeFor(vtkDataObject* input)
{
  return vtkUniformGridAMR::SafeDownCast(input)
           ? vtkSmartPointer<vtkDataObject>(vtkSmartPointer<vtkMultiBlockDataSet>::New())
           : vtkSmartPointer<vtkDataObject>::Take(input->NewInstance());
}

/// Gives an output the structure of an input, and in place of its leaves surfaces (null for none),
/// in the order of their traversal.
void setLeaves(vtkDataObject* input, const std::vector<vtkSmartPointer<vtkPolyData>>& surfaces,
  vtkCompositeDataSet* output)
{
  std::size_t leaf = 0;
  if (auto* const levels = vtkUniformGridAMR::SafeDownCast(input))
  {
    for (unsigned int level = 0; level < levels->GetNumberOfLevels(); ++level)
    {
      vtkNew<vtkMultiBlockDataSet> boxes;
      boxes->SetNumberOfBlocks(levels->GetNumberOfDataSets(level));
      vtkMultiBlockDataSet::SafeDownCast(output)->SetBlock(level, boxes);
      for (unsigned int box = 0; box < levels->GetNumberOfDataSets(level); ++box)
      {
        if (levels->GetDataSet(level, box))
        {
          boxes->SetBlock(box, surfaces[leaf++]);
        }
      }
    }
    return;
  }
  auto* const composite = vtkCompositeDataSet::SafeDownCast(input);
  output->CopyStructure(composite);
  const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    if (surfaces[leaf])
    {
      output->SetDataSet(iterator, surfaces[leaf]);
    }
    ++leaf;
  }
}

} // namespace

/// The tree of one cloud.
class vtkScatteredIsopointFilter::KeptTree
{
public:
  isopoint::IsosurfaceExtractor Extractor;
  vtkIsopointState LoadedFrom;
};

/// What an update leaves for the next one.
class vtkScatteredIsopointFilter::Internals
{
public:
  /// What is wanted of fits around isopoints, if anything: splats need the samples' spacing, and
  /// thinning what they tell of sheets.
  static std::optional<isopoint::FitRequest> FitRequestOf(const vtkScatteredIsopointFilter& filter)
  {
    using isopoint::FitOrder;
    using isopoint::FitRequest;
    const vtkIsopointGeometry::Arrays wanted = WantedGeometry(filter);
    const auto request = [&](FitOrder highest) {
      return FitRequest{ highest, wanted.IsProjected };
    };
    switch (filter.Projection)
    {
      case LINEAR_FIT:
        return request(FitOrder::Linear);
      case QUADRATIC_FIT:
        return request(FitOrder::Quadratic);
      case CUBIC_FIT:
        return request(FitOrder::Cubic);
      case CREASE_FIT:
        return request(FitOrder::Crease);
      default:
        if (wanted.Gradients || filter.MinimumSpacing > 0.0 ||
            (wanted.NeedsSplats() && filter.NormalMethod == NORMALS_FROM_FIELD))
        {
          return request(FitOrder::Cubic);
        }
        return wanted.NeedsSplats() || wanted.ProjectionOrder
                 ? std::optional<FitRequest>(request(FitOrder::None))
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

  vtkIsopointBlocks Input;
  std::map<std::size_t, KeptTree> Trees; // by leaf, where blocks are contoured by themselves

  void Clear()
  {
    this->Trees.clear();
    this->Input = vtkIsopointBlocks();
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
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkHyperTreeGrid");
  return 1;
}

int vtkScatteredIsopointFilter::FillOutputPortInformation(int, vtkInformation* info)
{
  // Poly data, or a composite of poly data.
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
  return 1;
}

vtkTypeBool vtkScatteredIsopointFilter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    return this->Superclass::ProcessRequest(request, inputVector, outputVector);
  }
  vtkDataObject* const input = vtkDataObject::GetData(inputVector[0]);
  vtkDataObject* const output = vtkDataObject::GetData(outputVector);
  const vtkSmartPointer<vtkDataObject> wanted =
    this->ContourBlocks && vtkCompositeDataSet::SafeDownCast(input)
      ? newCompositeFor(input)
      : vtkSmartPointer<vtkDataObject>(vtkSmartPointer<vtkPolyData>::New());
  if (!output || std::strcmp(output->GetClassName(), wanted->GetClassName()) != 0)
  {
    outputVector->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), wanted);
  }
  return 1;
}

int vtkScatteredIsopointFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->NumberOfSkippedSamples = 0;
  this->NumberOfUnprojectedPoints = 0;
  vtkDataObject* const output = vtkDataObject::GetData(outputVector);
  this->ExtractSafely(vtkDataObject::GetData(inputVector[0]), output);
  this->SetProgressShiftScale(0.0, 1.0);
  this->Kept->Input.ReleaseInput();
  if (!this->KeepTree)
  {
    this->Kept->Clear();
  }
  return 1;
}

void vtkScatteredIsopointFilter::ExtractSafely(vtkDataObject* input, vtkDataObject* output)
{
  std::string problem;
  try
  {
    this->CheckParameters();
    vtkIsopointBlocks& blocks = this->Kept->Input;
    blocks.Collect(vtkMakeIsopointExecution(this, this->UseAllCores != 0), input,
      vtkIsopointArrayChoice(this->GetInputArrayInformation(0)));
    this->NumberOfSkippedSamples = blocks.GetNumberOfPointsWithoutArray();
    const std::size_t count = blocks.GetBlocks().size();
    if (auto* const surface = vtkPolyData::SafeDownCast(output))
    {
      this->Kept->Trees.erase(this->Kept->Trees.upper_bound(0), this->Kept->Trees.end());
      this->ExtractBlocks(0, count, this->Kept->Trees[0], surface);
      return;
    }
    this->Kept->Trees.erase(
      this->Kept->Trees.lower_bound(blocks.GetNumberOfLeaves()), this->Kept->Trees.end());
    std::vector<vtkSmartPointer<vtkPolyData>> surfaces;
    for (std::size_t i = 0; i < count; ++i)
    {
      const double share = 1.0 / static_cast<double>(count);
      this->SetProgressShiftScale(share * static_cast<double>(i), share);
      const std::size_t leaf = blocks.GetBlocks()[i].Leaf;
      surfaces.resize(leaf);
      surfaces.push_back(vtkSmartPointer<vtkPolyData>::New());
      this->ExtractBlocks(i, i + 1, this->Kept->Trees[leaf], surfaces.back());
    }
    surfaces.resize(blocks.GetNumberOfLeaves());
    setLeaves(input, surfaces, vtkCompositeDataSet::SafeDownCast(output));
    return;
  }
  catch (const isopoint::Aborted&)
  {
  }
  catch (const vtkUnusableIsopointInput& error)
  {
    problem = error.what();
  }
  catch (const std::bad_alloc&)
  {
    this->Kept->Clear();
    problem = "Out of memory. Close other data, set KeepTree off, or pass fewer points.";
  }
  catch (const std::exception& error)
  {
    this->Kept->Clear();
    problem = std::string("Cannot contour these points: ") + error.what() + ".";
  }
  output->Initialize();
  if (!problem.empty())
  {
    vtkErrorMacro(<< problem);
  }
}

void vtkScatteredIsopointFilter::CheckParameters()
{
  const double* const values = this->ContourValues->GetValues();
  const vtkIdType valueCount = this->ContourValues->GetNumberOfContours();
  if (std::any_of(values, values + valueCount, [](double value) { return std::isnan(value); }))
  {
    throw vtkUnusableIsopointInput("An isovalue is not a number. See SetValue().");
  }
  if (!(this->Angle >= 0.0 && this->Angle <= 180.0))
  {
    std::ostringstream message;
    message << "The angle is " << this->Angle
            << "; it must be within 0 and 180 degrees. See SetAngle().";
    throw vtkUnusableIsopointInput(message.str());
  }
  if (!(this->GapFactor >= 0.0) || std::isinf(this->GapFactor))
  {
    std::ostringstream message;
    message << "The gap factor is " << this->GapFactor
            << "; it must be 0, which drops nothing, or a positive number. See SetGapFactor().";
    throw vtkUnusableIsopointInput(message.str());
  }
  if (std::isnan(this->MinimumSpacing))
  {
    throw vtkUnusableIsopointInput("The minimum spacing is not a number. See SetMinimumSpacing().");
  }
}

void vtkScatteredIsopointFilter::ExtractBlocks(
  std::size_t begin, std::size_t end, KeptTree& kept, vtkPolyData* output)
{
  constexpr double loadingShare = 0.1;
  constexpr double extractionShare = 0.7;
  const Execution execution = vtkMakeIsopointExecution(this, this->UseAllCores != 0);
  const std::vector<vtkIsopointBlock>& all = this->Kept->Input.GetBlocks();
  const std::vector<vtkIsopointBlock> blocks(all.begin() + static_cast<std::ptrdiff_t>(begin),
    all.begin() + static_cast<std::ptrdiff_t>(end));

  const vtkIsopointState state = this->Kept->Input.GetState(begin, end);
  if (state != kept.LoadedFrom)
  {
    kept.LoadedFrom.clear();
    vtkLoadIsopointInput(execution, blocks, kept.Extractor);
    kept.LoadedFrom = state;
  }
  this->NumberOfSkippedSamples += static_cast<vtkIdType>(kept.Extractor.skippedCount());
  for (const vtkIsopointBlock& block : blocks)
  {
    this->NumberOfSkippedSamples -= block.Fillers;
  }
  this->UpdateProgress(loadingShare);

  const double* const values = this->ContourValues->GetValues();
  const std::set<double> isovalues(values, values + this->ContourValues->GetNumberOfContours());
  std::vector<vtkContouredIsosurface> surfaces;
  std::size_t pointCount = 0;
  for (const double isovalue : isovalues)
  {
    const double share = (extractionShare - loadingShare) / static_cast<double>(isovalues.size());
    const double begin = loadingShare + share * static_cast<double>(surfaces.size());
    surfaces.push_back(
      { isovalue, kept.Extractor.extract(vtkMakeIsopointStep(execution, this, begin, begin + share),
                    isovalue, this->Angle, this->GapFactor, Internals::FitRequestOf(*this)) });
    isopoint::thin(execution, this->MinimumSpacing, surfaces.back().Surface);
    pointCount += surfaces.back().Surface.points.size();
    isopoint::throwIfAborted(execution);
  }

  const vtkIsopointGathering gathering(blocks, surfaces);
  vtkDataSet* const input = gathering.GetBlock().Positions;
  vtkDataArray* const scalars = gathering.GetBlock().Scalars;
  const auto count = static_cast<vtkIdType>(pointCount);
  const vtkSmartPointer<vtkPoints> points =
    newOutputPoints(input, this->OutputPointsPrecision, count);
  const vtkIsopointGeometry::Arrays wanted = Internals::WantedGeometry(*this);
  const isopoint::SampleExtents extents = kept.Extractor.sampleExtents();
  vtkIsopointGeometry geometry(wanted, count);
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
    isopoint::SurfacePoints placed = vtkPlaceIsopoints(execution, input, scalars, surface);
    placed.extents = extents;
    std::vector<isopoint::Splat> splats;
    if (wanted.NeedsSplats())
    {
      splats = isopoint::computeSplats(step, placed,
        { this->NumberOfNeighbors, this->NormalMethod == NORMALS_FROM_FIELD,
          wanted.NeedsShapes() });
    }
    geometry.Append(placed, splats, points);
    point += static_cast<vtkIdType>(placed.positions.size());
    isopoint::throwIfAborted(execution);
  }
  this->NumberOfUnprojectedPoints +=
    this->Projection == NO_PROJECTION ? count : geometry.GetNumberWithoutFit();

  output->SetPoints(points);
  output->SetVerts(newVertices(count));
  vtkPointData* const pointData = output->GetPointData();
  vtkInterpolateIsopointArrays(
    execution, gathering.GetBlock().Attributes, scalars, surfaces, pointData);
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
  os << indent << "MinimumSpacing: " << this->MinimumSpacing << "\n";
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
  os << indent << "ContourBlocks: " << onOff(this->ContourBlocks) << "\n";
  os << indent << "KeepTree: " << onOff(this->KeepTree) << "\n";
  os << indent << "UseAllCores: " << onOff(this->UseAllCores) << "\n";
  os << indent << "NumberOfSkippedSamples: " << this->NumberOfSkippedSamples << "\n";
}
