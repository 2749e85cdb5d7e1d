// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/ProcessGroup.h"
#include "Core/Tree/BinaryIndex.h"
#include "Core/Tree/Loading.h"
#include "Core/Tree/Path.h"
#include "Core/Tree/SampleTree.h"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace isopoint
{

/// Sets new values of all samples that a rank holds, its own and copies: asks the ranks that have
/// read them, by id. Trees keep their shape. Collective.
template <class TSample>
class ValueExchange
{
public:
  using Value = typename TSample::Value;

  /// @param begins see SharedTree
  /// @param counts number of items by rank
  ValueExchange(ProcessGroup& processes, SampleTree<TSample>& tree,
    const std::vector<std::uint64_t>& begins, const std::vector<std::uint64_t>& counts)
    : Processes(processes)
    , Tree(tree)
    , Begins(begins)
    , FirstIds(counts.size() + 1, 0)
  {
    std::partial_sum(counts.begin(), counts.end(), this->FirstIds.begin() + 1);
  }

  /// @param read(id, position, value) of this rank's items, by local ids
  /// @throws Aborted, std::bad_alloc, FailedElsewhere, after which some values are new
  template <class Reader>
  void replace(const Execution& execution, const Reader& read)
  {
    throwIfAborted(execution);
    this->visit(rootNode);
    const std::vector<std::vector<Id>> asked = this->Processes.exchange(this->questions());
    std::vector<std::vector<Value>> answers;
    answers.reserve(asked.size());
    for (const std::vector<Id>& ids : asked)
    {
      answers.push_back(valuesOf(execution, ids, read));
    }
    const std::vector<std::vector<Value>> values = this->Processes.exchange(answers);
    answers.clear();
    this->setValues(values);
    for (const std::size_t node : this->Whole)
    {
      throwIfAborted(execution);
      recomputeRanges(this->Tree, this->Tree.nodes[node], maximumDepth + 1);
    }
    this->fetchRanges();
    this->uniteFrom(rootNode);
  }

private:
  using Id = typename TSample::Id;

  struct Range
  {
    Value minimum;
    Value maximum;
  };

  /// Lists the subtrees below a node whose samples this rank holds, and absent nodes.
  void visit(std::size_t nodeIndex)
  {
    const Node<TSample>& node = this->Tree.nodes[nodeIndex];
    if (node.isAbsent)
    {
      this->Absent.push_back(nodeIndex);
    }
    else if (this->Tree.hasOnlyOwn(node) || !node.isSplit())
    {
      this->Whole.push_back(nodeIndex);
    }
    else
    {
      this->visit(node.lowerNode());
      this->visit(node.upperNode());
    }
  }

  /// Calls action(sample, rank that has read it) for each sample that this rank holds.
  template <class Action>
  void forSamples(const Action& action)
  {
    for (const std::size_t index : this->Whole)
    {
      const Node<TSample>& node = this->Tree.nodes[index];
      for (std::size_t i = node.begin; i < node.end; ++i)
      {
        TSample& sample = this->Tree.samples[i];
        action(sample, rankAt(this->FirstIds, sample.id));
      }
    }
  }

  std::vector<std::vector<Id>> questions()
  {
    std::vector<std::size_t> counts(this->FirstIds.size() - 1, 0);
    this->forSamples([&](const TSample&, std::size_t rank) { ++counts[rank]; });
    std::vector<std::vector<Id>> ids(counts.size());
    for (std::size_t rank = 0; rank < ids.size(); ++rank)
    {
      ids[rank].reserve(counts[rank]);
    }
    this->forSamples([&](const TSample& sample, std::size_t rank)
      { ids[rank].push_back(static_cast<Id>(sample.id - this->FirstIds[rank])); });
    return ids;
  }

  template <class Reader>
  static std::vector<Value> valuesOf(
    const Execution& execution, const std::vector<Id>& ids, const Reader& read)
  {
    std::vector<Value> values(ids.size());
    forEachIndex(execution, ids.size(),
      [&](std::size_t i)
      {
        typename TSample::Coordinate position[3];
        read(ids[i], position, values[i]);
      });
    return values;
  }

  void setValues(const std::vector<std::vector<Value>>& values)
  {
    std::vector<std::size_t> next(values.size(), 0);
    this->forSamples(
      [&](TSample& sample, std::size_t rank) { sample.value = values[rank][next[rank]++]; });
  }

  /// Fetches the value ranges of absent nodes.
  void fetchRanges()
  {
    std::vector<std::vector<BinaryIndex>> questions(this->FirstIds.size() - 1);
    std::vector<std::vector<std::size_t>> nodes(questions.size());
    for (const std::size_t node : this->Absent)
    {
      const std::size_t owner = rankAt(this->Begins, this->Tree.nodes[node].begin);
      questions[owner].push_back(pathToNode(this->Tree, node).index);
      nodes[owner].push_back(node);
    }
    const std::vector<std::vector<BinaryIndex>> asked = this->Processes.exchange(questions);
    std::vector<std::vector<Range>> answers(asked.size());
    for (std::size_t rank = 0; rank < asked.size(); ++rank)
    {
      for (const BinaryIndex& index : asked[rank])
      {
        const Node<TSample>& node = this->Tree.nodes[pathTo(this->Tree, index).nodeIndex()];
        answers[rank].push_back({ node.minimum, node.maximum });
      }
    }
    const std::vector<std::vector<Range>> ranges = this->Processes.exchange(answers);
    for (std::size_t rank = 0; rank < ranges.size(); ++rank)
    {
      for (std::size_t i = 0; i < ranges[rank].size(); ++i)
      {
        Node<TSample>& node = this->Tree.nodes[nodes[rank][i]];
        node.minimum = ranges[rank][i].minimum;
        node.maximum = ranges[rank][i].maximum;
      }
    }
  }

  /// Recomputes the value ranges of nodes above those listed by visit().
  void uniteFrom(std::size_t nodeIndex)
  {
    Node<TSample>& node = this->Tree.nodes[nodeIndex];
    if (!this->Tree.hasOnlyOwn(node) && node.isSplit())
    {
      this->uniteFrom(node.lowerNode());
      this->uniteFrom(node.upperNode());
      uniteRanges(node, this->Tree.nodes[node.lowerNode()], this->Tree.nodes[node.upperNode()]);
    }
  }

  ProcessGroup& Processes;
  SampleTree<TSample>& Tree;
  const std::vector<std::uint64_t>& Begins;
  std::vector<std::uint64_t> FirstIds; // of each rank's items, and the end
  std::vector<std::size_t> Whole;      // nodes with all their samples on this rank
  std::vector<std::size_t> Absent;     // nodes
};

} // namespace isopoint
