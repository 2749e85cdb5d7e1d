// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredGradientFilter.h"

#include "Input/vtkIsopointBlocks.h"
#include "Output/vtkIsopointDerivatives.h"
#include "Output/vtkIsopointPlaces.h"
#include "Output/vtkIsopointSampleArrays.h"
#include "Update/vtkIsopointProbing.h"
#include "Update/vtkIsopointUpdate.h"

#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkUnsignedCharArray.h"

#include <sstream>

vtkStandardNewMacro(vtkScatteredGradientFilter);

vtkScatteredGradientFilter::vtkScatteredGradientFilter()
  : Probing(std::make_unique<vtkIsopointProbing>(*this->Updater))
{
  this->SetProgressText("Scattered Gradient"); // as in ParaView's menu
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

vtkScatteredGradientFilter::~vtkScatteredGradientFilter() = default;

const isopoint::SampleCounts& vtkScatteredGradientFilter::GetSampleCounts() const
{
  return this->Probing->GetCounts();
}

int vtkScatteredGradientFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* const output = vtkDataObject::GetData(outputVector);
  this->Probing->Run(
    output, [&]() { this->Compute(inputVector[0]->GetInformationObject(0), output); });
  return 1;
}

std::vector<std::string> vtkScatteredGradientFilter::ListNames() const
{
  std::vector<std::string> names;
  const auto add = [&](vtkTypeBool isWanted, const std::string& name)
  {
    if (isWanted)
    {
      names.push_back(name);
    }
  };
  add(this->ComputeGradient, this->ResultArrayName);
  add(this->ComputeDivergence, this->DivergenceArrayName);
  add(this->ComputeVorticity, this->VorticityArrayName);
  add(this->ComputeQCriterion, this->QCriterionArrayName);
  return names;
}

void vtkScatteredGradientFilter::Compute(vtkInformation* inputInfo, vtkDataObject* output)
{
  const std::vector<std::string> names = this->ListNames();
  vtkCheckIsopointNames(names);
  const vtkIsopointArrayChoice choice(
    this->GetInputArrayInformation(0), vtkIsopointArrayChoice::Tuples);
  std::ostringstream options;
  options << choice.Describe() << " " << this->Interpolation << this->ComputeGradient
          << this->ComputeDivergence << this->ComputeVorticity << this->ComputeQCriterion;
  this->Probing->Load(inputInfo, choice, options.str());
  vtkDataObject* const input = vtkDataObject::GetData(inputInfo);
  if (names.empty())
  {
    vtkCopyIsopointInput(input, output);
    return;
  }
  const vtkIsopointSampleArray array = this->Probing->FindArray(choice);
  if (this->ComputeDivergence || this->ComputeVorticity || this->ComputeQCriterion)
  {
    vtkCheckIsopointVectors(array.Components);
  }

  const std::vector<vtkIsopointBlock>& blocks = this->Probing->GetBlocks();
  std::vector<isopoint::Vector> places;
  for (const vtkIsopointBlock& block : blocks)
  {
    vtkAppendIsopointPlaces(block.Positions, places);
  }
  isopoint::ProbeOptions probing;
  probing.method = static_cast<isopoint::PlaceMethod>(this->Interpolation);
  static_assert(AFFINE == static_cast<int>(isopoint::PlaceMethod::Affine));
  const std::vector<vtkSmartPointer<vtkDoubleArray>> arrays =
    this->Derive(this->Probing->FindGradients(array, places, probing));

  vtkCopyIsopointInput(input, output);
  const std::vector<vtkDataObject*> from = vtkListIsopointLeaves(input);
  const std::vector<vtkDataObject*> to = vtkListIsopointLeaves(output);
  vtkIdType first = 0;
  for (const vtkIsopointBlock& block : blocks)
  {
    const bool areCells = block.Attributes == from[block.Leaf]->GetAttributes(vtkDataObject::CELL);
    vtkDataSetAttributes* const attributes =
      to[block.Leaf]->GetAttributes(areCells ? vtkDataObject::CELL : vtkDataObject::POINT);
    for (vtkDoubleArray* const derivatives : arrays)
    {
      vtkAddIsopointTuples(derivatives, first, block.GetNumberOfSamples(), -1, attributes);
    }
    first += block.GetNumberOfSamples();
  }
}

/// The arrays of the output.
std::vector<vtkSmartPointer<vtkDoubleArray>> vtkScatteredGradientFilter::Derive(
  vtkDoubleArray* gradients) const
{
  std::vector<vtkSmartPointer<vtkDoubleArray>> arrays;
  const auto derive = [&](vtkTypeBool isWanted, const std::string& name, auto compute)
  {
    if (isWanted)
    {
      arrays.emplace_back(compute(gradients));
      arrays.back()->SetName(name.c_str());
    }
  };
  const auto same = [](vtkDoubleArray* array) { return array; };
  derive(this->ComputeGradient, this->ResultArrayName, same);
  derive(this->ComputeDivergence, this->DivergenceArrayName, vtkComputeIsopointDivergence);
  derive(this->ComputeVorticity, this->VorticityArrayName, vtkComputeIsopointVorticity);
  derive(this->ComputeQCriterion, this->QCriterionArrayName, vtkComputeIsopointQCriterion);
  return arrays;
}

void vtkScatteredGradientFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Interpolation: " << this->Interpolation << "\n";
  os << indent << "ComputeGradient: " << this->ComputeGradient << "\n";
  os << indent << "ComputeDivergence: " << this->ComputeDivergence << "\n";
  os << indent << "ComputeVorticity: " << this->ComputeVorticity << "\n";
  os << indent << "ComputeQCriterion: " << this->ComputeQCriterion << "\n";
  os << indent << "ResultArrayName: " << this->ResultArrayName << "\n";
  os << indent << "DivergenceArrayName: " << this->DivergenceArrayName << "\n";
  os << indent << "VorticityArrayName: " << this->VorticityArrayName << "\n";
  os << indent << "QCriterionArrayName: " << this->QCriterionArrayName << "\n";
}
