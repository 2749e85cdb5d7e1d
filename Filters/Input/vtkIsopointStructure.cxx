// SPDX-License-Identifier: GPL-3.0-or-later
#include "Input/vtkIsopointStructure.h"

#include "Input/vtkIsopointCompatibility.h"
#include "Input/vtkIsopointUsageError.h"
#include "Isopoint/Base/Team.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkDataObjectTypes.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"
#include "vtkUniformGrid.h"
#include "vtkUniformGridAMR.h"

#include <cstdlib>

namespace
{

// The same of all composites that are trees.

unsigned int countOf(vtkMultiBlockDataSet* tree)
{
  return tree->GetNumberOfBlocks();
}
unsigned int countOf(vtkPartitionedDataSetCollection* tree)
{
  return tree->GetNumberOfPartitionedDataSets();
}
unsigned int countOf(vtkPartitionedDataSet* tree)
{
  return tree->GetNumberOfPartitions();
}

void setCount(vtkMultiBlockDataSet* tree, unsigned int count)
{
  tree->SetNumberOfBlocks(count);
}
void setCount(vtkPartitionedDataSetCollection* tree, unsigned int count)
{
  tree->SetNumberOfPartitionedDataSets(count);
}
void setCount(vtkPartitionedDataSet* tree, unsigned int count)
{
  tree->SetNumberOfPartitions(count);
}

vtkDataObject* childOf(vtkMultiBlockDataSet* tree, unsigned int i)
{
  return tree->GetBlock(i);
}
vtkDataObject* childOf(vtkPartitionedDataSetCollection* tree, unsigned int i)
{
  return tree->GetPartitionedDataSet(i);
}
vtkDataObject* childOf(vtkPartitionedDataSet* tree, unsigned int i)
{
  return tree->GetPartitionAsDataObject(i);
}

void setChild(vtkMultiBlockDataSet* tree, unsigned int i, vtkDataObject* child)
{
  tree->SetBlock(i, child);
}
void setChild(vtkPartitionedDataSetCollection* tree, unsigned int i, vtkDataObject* child)
{
  tree->SetPartitionedDataSet(i, vtkPartitionedDataSet::SafeDownCast(child));
}
void setChild(vtkPartitionedDataSet* tree, unsigned int i, vtkDataObject* child)
{
  tree->SetPartition(i, child);
}

/// Calls action(tree), with the tree's own type; does nothing for other objects, an AMR among them,
/// which is a collection from VTK 9.5 on.
template <class Action>
void withTree(vtkDataObject* object, const Action& action)
{
  if (vtkUniformGridAMR::SafeDownCast(object))
  {
    return;
  }
  if (auto* const blocks = vtkMultiBlockDataSet::SafeDownCast(object))
  {
    action(blocks);
  }
  else if (auto* const collection = vtkPartitionedDataSetCollection::SafeDownCast(object))
  {
    action(collection);
  }
  else if (auto* const partitions = vtkPartitionedDataSet::SafeDownCast(object))
  {
    action(partitions);
  }
}

template <class Tree>
std::string nameOf(Tree* tree, unsigned int i)
{
  vtkInformation* const data = tree->HasMetaData(i) ? tree->GetMetaData(i) : nullptr;
  return data && data->Has(vtkCompositeDataSet::NAME())
           ? std::string(data->Get(vtkCompositeDataSet::NAME()))
           : std::string();
}

/// Calls visit(child, name) for each child of a tree, or level or box of an AMR, null or not.
/// @returns whether the object is one of these
template <class Visit>
bool forChildren(vtkDataObject* object, const Visit& visit)
{
  bool isTree = false;
  withTree(object,
    [&](auto* tree)
    {
      isTree = true;
      for (unsigned int i = 0; i < countOf(tree); ++i)
      {
        visit(childOf(tree, i), nameOf(tree, i));
      }
    });
  return isTree;
}

/// The boxes of a level of an AMR, null or not.
std::vector<vtkDataObject*> boxesOf(vtkUniformGridAMR* levels, unsigned int level)
{
  std::vector<vtkDataObject*> boxes;
  for (unsigned int box = 0; box < vtkCountGridsOfLevel(levels, level); ++box)
  {
    boxes.push_back(vtkGetGridOfLevel(levels, level, box));
  }
  return boxes;
}

/// Whether two ranks may have different numbers of children of such a composite.
bool isInPieces(int type)
{
  return type == VTK_PARTITIONED_DATA_SET || type == VTK_MULTIPIECE_DATA_SET;
}

} // namespace

vtkIsopointStructure::vtkIsopointStructure(vtkDataObject* object)
  : Type(object ? leaf : nothing)
{
  const bool isTree = forChildren(object,
    [this](vtkDataObject* child, const std::string& name)
    {
      this->Children.emplace_back(child);
      this->Children.back().Name = name;
    });
  if (auto* const levels = vtkUniformGridAMR::SafeDownCast(object))
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
  else if (isTree)
  {
    this->Type = object->GetDataObjectType();
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
  forChildren(object, [&](vtkDataObject* child, const std::string&)
    { this->Children[visited++].AddNumbers(child, next, numbers); });
  if (auto* const levels = vtkUniformGridAMR::SafeDownCast(object))
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

void vtkIsopointStructure::Merge(const vtkIsopointStructure& other)
{
  this->Merge(other, "");
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
    throw vtkIsopointUsageError(
      "The inputs of the ranks have different blocks" +
      (place.empty() ? std::string() : " at " + place) +
      ". Give all ranks the same tree of blocks, null where a rank has no data, or switch"
      " ContourBlocks off.");
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
  withTree(output,
    [&](auto* tree)
    {
      setCount(tree, static_cast<unsigned int>(this->Children.size()));
      for (unsigned int i = 0; i < this->Children.size(); ++i)
      {
        const vtkIsopointStructure& child = this->Children[i];
        if (!child.Name.empty() && nameOf(tree, i).empty())
        {
          tree->GetMetaData(i)->Set(vtkCompositeDataSet::NAME(), child.Name.c_str());
        }
        if (!child.IsComposite())
        {
          setChild(tree, i, surfaces[next++]);
          continue;
        }
        if (!childOf(tree, i))
        {
          setChild(tree, i,
            vtkSmartPointer<vtkDataObject>::Take(vtkDataObjectTypes::NewDataObject(child.Type)));
        }
        child.FillChildren(surfaces, next, childOf(tree, i));
      }
    });
}

std::vector<char> vtkIsopointStructure::Write() const
{
  std::string text;
  this->Write(text);
  return { text.begin(), text.end() };
}

void vtkIsopointStructure::Write(std::string& text) const
{
  text += std::to_string(this->Type) + ' ' + std::to_string(this->Children.size()) + ' ' +
          std::to_string(this->Name.size()) + ' ' + this->Name;
  for (const vtkIsopointStructure& child : this->Children)
  {
    child.Write(text);
  }
}

namespace
{

/// One number of what was written.
long nextNumber(const char*& text)
{
  char* end = nullptr;
  const long number = std::strtol(text, &end, 10);
  text = end + 1;
  return number;
}

} // namespace

vtkIsopointStructure vtkIsopointStructure::Read(const char*& text)
{
  vtkIsopointStructure structure;
  structure.Type = static_cast<int>(nextNumber(text));
  structure.Children.resize(static_cast<std::size_t>(nextNumber(text)));
  const long length = nextNumber(text);
  structure.Name.assign(text, static_cast<std::size_t>(length));
  text += length;
  for (vtkIsopointStructure& child : structure.Children)
  {
    child = Read(text);
  }
  return structure;
}

vtkIsopointStructure vtkMergeIsopointStructures(isopoint::Team& team, vtkDataObject* input)
{
  // The first rank merges, so that what the others receive does not grow with their number.
  const auto size = static_cast<std::size_t>(team.size());
  std::vector<std::vector<char>> messages;
  team.together(
    [&]()
    {
      messages.resize(size);
      messages.front() = vtkIsopointStructure(input).Write();
    });
  const std::vector<std::vector<char>> arrived = team.exchange(messages);
  team.together(
    [&]()
    {
      messages.assign(size, {});
      if (team.rank() == 0)
      {
        vtkIsopointStructure merged;
        for (const std::vector<char>& bytes : arrived)
        {
          const char* text = bytes.data();
          merged.Merge(vtkIsopointStructure::Read(text));
        }
        messages.assign(size, merged.Write());
      }
    });
  const std::vector<std::vector<char>> merged = team.exchange(messages);
  vtkIsopointStructure result;
  team.together(
    [&]()
    {
      const char* text = merged.front().data();
      result = vtkIsopointStructure::Read(text);
    });
  return result;
}
