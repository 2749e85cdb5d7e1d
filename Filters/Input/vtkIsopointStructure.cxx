// SPDX-License-Identifier: GPL-3.0-or-later
#include "Input/vtkIsopointStructure.h"

#include "Common/vtkIsopointCompatibility.h"
#include "Core/Base/ProcessGroup.h"
#include "Core/Failure.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTypes.h"
#include "vtkInformation.h"
#include "vtkPolyData.h"
#include "vtkUniformGridAMR.h"

namespace
{

/// Gives access to protected member functions.
struct Tree : vtkDataObjectTree
{
  static constexpr auto getCount = &Tree::GetNumberOfChildren;
  static constexpr auto setCount = &Tree::SetNumberOfChildren;
  static constexpr auto getChild = &Tree::GetChild;
  static constexpr auto setChild = &Tree::SetChild;
  static constexpr auto hasInformation = &Tree::HasChildMetaData;
  static constexpr auto getInformation = &Tree::GetChildMetaData;
};

/// The object as a tree of blocks, or null. An AMR is none, even since VTK 9.5.
vtkDataObjectTree* treeOf(vtkDataObject* object)
{
  return vtkUniformGridAMR::SafeDownCast(object) ? nullptr
                                                 : vtkDataObjectTree::SafeDownCast(object);
}

std::string nameOf(vtkDataObjectTree* tree, unsigned int child)
{
  vtkInformation* const data =
    (tree->*Tree::hasInformation)(child) ? (tree->*Tree::getInformation)(child) : nullptr;
  return data && data->Has(vtkCompositeDataSet::NAME())
           ? std::string(data->Get(vtkCompositeDataSet::NAME()))
           : std::string();
}

/// The boxes of a level of an AMR, or nulls.
std::vector<vtkDataObject*> boxesOf(vtkUniformGridAMR* levels, unsigned int level)
{
  std::vector<vtkDataObject*> boxes;
  for (unsigned int box = 0; box < vtkCountGridsOfLevel(levels, level); ++box)
  {
    boxes.push_back(vtkGetGridOfLevel(levels, level, box));
  }
  return boxes;
}

/// Whether ranks may have different numbers of children of a composite of this type.
bool isInPieces(int type)
{
  return type == VTK_PARTITIONED_DATA_SET || type == VTK_MULTIPIECE_DATA_SET;
}

} // namespace

vtkIsopointStructure::vtkIsopointStructure(vtkDataObject* object)
  : Type(object ? leaf : nothing)
{
  if (auto* const tree = treeOf(object))
  {
    this->Type = tree->GetDataObjectType();
    for (unsigned int i = 0; i < (tree->*Tree::getCount)(); ++i)
    {
      this->Children.emplace_back((tree->*Tree::getChild)(i));
      this->Children.back().Name = nameOf(tree, i);
    }
  }
  else if (auto* const levels = vtkUniformGridAMR::SafeDownCast(object))
  {
    this->Type = levels->GetDataObjectType();
    for (unsigned int level = 0; level < levels->GetNumberOfLevels(); ++level)
    {
      vtkIsopointStructure boxes;
      boxes.Type = VTK_MULTIBLOCK_DATA_SET;
      for (vtkDataObject* const box : boxesOf(levels, level))
      {
        boxes.Children.emplace_back(box);
      }
      this->Children.push_back(boxes);
    }
  }
}

std::size_t vtkIsopointStructure::GetNumberOfLeaves() const
{
  std::size_t count = this->IsComposite() ? 0 : 1;
  for (const vtkIsopointStructure& child : this->Children)
  {
    count += child.GetNumberOfLeaves();
  }
  return count;
}

std::vector<std::size_t> vtkIsopointStructure::GetNumbersOf(vtkDataObject* object) const
{
  std::vector<std::size_t> numbers;
  std::size_t next = 0;
  this->AddNumbers(object, next, numbers);
  return numbers;
}

void vtkIsopointStructure::AddNumbers(
  vtkDataObject* object, std::size_t& next, std::vector<std::size_t>& numbers) const
{
  if (!this->IsComposite())
  {
    if (object)
    {
      numbers.push_back(next);
    }
    ++next;
    return;
  }
  std::size_t visited = 0;
  if (auto* const tree = treeOf(object))
  {
    for (; visited < (tree->*Tree::getCount)(); ++visited)
    {
      this->Children[visited].AddNumbers(
        (tree->*Tree::getChild)(static_cast<unsigned int>(visited)), next, numbers);
    }
  }
  else if (auto* const levels = vtkUniformGridAMR::SafeDownCast(object))
  {
    for (; visited < levels->GetNumberOfLevels(); ++visited)
    {
      const std::vector<vtkDataObject*> boxes = boxesOf(levels, static_cast<unsigned int>(visited));
      const std::vector<vtkIsopointStructure>& known = this->Children[visited].Children;
      for (std::size_t box = 0; box < known.size(); ++box)
      {
        known[box].AddNumbers(box < boxes.size() ? boxes[box] : nullptr, next, numbers);
      }
    }
  }
  for (; visited < this->Children.size(); ++visited)
  {
    next += this->Children[visited].GetNumberOfLeaves();
  }
}

void vtkIsopointStructure::Merge(const vtkIsopointStructure& other, const std::string& place)
{
  if (this->Name.empty())
  {
    this->Name = other.Name;
  }
  if (other.Type == nothing)
  {
    return;
  }
  const bool isUnknown =
    this->Type == nothing || (this->Type == other.Type && this->Children.empty());
  const bool haveSameCount = this->Children.size() == other.Children.size() ||
                             other.Children.empty() || isInPieces(this->Type);
  if (!isUnknown && (this->Type != other.Type || !haveSameCount))
  {
    throw isopoint::UsageError(
      "The inputs of the ranks have different blocks" +
      (place.empty() ? std::string() : " at " + place) +
      ". Give all ranks the same tree of blocks, null where a rank has no data, or contour"
      " all blocks as one cloud.");
  }
  this->Type = other.Type;
  for (std::size_t i = 0; i < other.Children.size(); ++i)
  {
    if (i == this->Children.size())
    {
      this->Children.push_back(other.Children[i]);
    }
    else
    {
      this->Children[i].Merge(other.Children[i], place + "/" + std::to_string(i));
    }
  }
}

void vtkIsopointStructure::Fill(vtkDataObject* input,
  const std::vector<vtkSmartPointer<vtkPolyData>>& surfaces, vtkCompositeDataSet* output) const
{
  if (!vtkUniformGridAMR::SafeDownCast(input))
  {
    output->CopyStructure(vtkCompositeDataSet::SafeDownCast(input));
  }
  std::size_t next = 0;
  this->FillChildren(surfaces, next, output);
}

void vtkIsopointStructure::FillChildren(const std::vector<vtkSmartPointer<vtkPolyData>>& surfaces,
  std::size_t& next, vtkDataObject* output) const
{
  vtkDataObjectTree* const tree = treeOf(output);
  (tree->*Tree::setCount)(static_cast<unsigned int>(this->Children.size()));
  for (unsigned int i = 0; i < this->Children.size(); ++i)
  {
    const vtkIsopointStructure& child = this->Children[i];
    if (!child.Name.empty() && nameOf(tree, i).empty())
    {
      (tree->*Tree::getInformation)(i)->Set(vtkCompositeDataSet::NAME(), child.Name.c_str());
    }
    if (!child.IsComposite())
    {
      (tree->*Tree::setChild)(i, surfaces[next++]);
      continue;
    }
    if (!(tree->*Tree::getChild)(i))
    {
      (tree->*Tree::setChild)(
        i, vtkSmartPointer<vtkDataObject>::Take(vtkDataObjectTypes::NewDataObject(child.Type)));
    }
    child.FillChildren(surfaces, next, (tree->*Tree::getChild)(i));
  }
}

void vtkIsopointStructure::Write(isopoint::ByteBuffer& bytes) const
{
  isopoint::append(bytes, this->Type);
  isopoint::appendText(bytes, this->Name);
  isopoint::append(bytes, this->Children.size());
  for (const vtkIsopointStructure& child : this->Children)
  {
    child.Write(bytes);
  }
}

vtkIsopointStructure vtkIsopointStructure::Read(isopoint::ByteReader& bytes)
{
  vtkIsopointStructure structure;
  structure.Type = bytes.read<int>();
  structure.Name = bytes.readText();
  structure.Children.resize(bytes.read<std::size_t>());
  for (vtkIsopointStructure& child : structure.Children)
  {
    child = Read(bytes);
  }
  return structure;
}

vtkIsopointStructure vtkMergeIsopointStructures(
  isopoint::ProcessGroup& processes, vtkDataObject* input)
{
  // Only the first rank merges, so that messages do not grow with the number of ranks.
  std::vector<isopoint::ByteBuffer> messages(static_cast<std::size_t>(processes.size()));
  vtkIsopointStructure(input).Write(messages.front());
  const std::vector<isopoint::ByteBuffer> arrived = processes.exchange(messages);
  isopoint::ByteBuffer merged;
  if (processes.rank() == 0)
  {
    vtkIsopointStructure structure;
    for (const isopoint::ByteBuffer& bytes : arrived)
    {
      isopoint::ByteReader reader(bytes);
      structure.Merge(vtkIsopointStructure::Read(reader));
    }
    structure.Write(merged);
  }
  const isopoint::ByteBuffer ofFirst = processes.gather(merged).front();
  isopoint::ByteReader reader(ofFirst);
  return vtkIsopointStructure::Read(reader);
}
