// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/ProcessGroup.h"
#include "Core/Ranks/ByteBuffer.h"
#include "Core/Ranks/NodeWriter.h"
#include "Core/Tree/Path.h"
#include "Core/Tree/SampleTree.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace isopoint
{

/// Fetches missing nodes from the ranks that hold them, in rounds in which all ranks ask and
/// answer. All functions are collective.
template <class TSample>
class NodeExchange
{
public:
  /// @param begins see SharedTree
  NodeExchange(
    ProcessGroup& processes, SampleTree<TSample>& tree, const std::vector<std::uint64_t>& begins)
    : Processes(processes)
    , Tree(tree)
    , Begins(begins)
  {
  }

  /// See SingleRank::fetchNodes(). A depth below all leaves fetches samples. Splits own nodes.
  bool fetchNodes(std::vector<MissingNode>& missing, int depth)
  {
    if (!this->Processes.isAny(!missing.empty()))
    {
      return false;
    }
    std::map<std::size_t, std::vector<Region>> boxes; // by node
    for (const MissingNode& node : missing)
    {
      boxes[node.nodeIndex].push_back(node.box);
    }
    missing.clear();
    const auto ranks = static_cast<std::size_t>(this->Processes.size());
    std::vector<ByteBuffer> questions(ranks);
    std::vector<std::vector<std::size_t>> asked(ranks); // nodes, by rank
    this->ask(boxes, depth, questions, asked);
    const std::vector<ByteBuffer> answers = this->answer(this->Processes.exchange(questions));
    const std::vector<ByteBuffer> found = this->Processes.exchange(answers);
    NodeReader<TSample> reader(this->Tree);
    for (std::size_t rank = 0; rank < ranks; ++rank)
    {
      ByteReader in(found[rank]);
      for (const std::size_t node : asked[rank])
      {
        reader.read(node, in);
      }
    }
    return true;
  }

private:
  /// Writes the questions for each rank: node, depth, boxes. Splits missing nodes of this rank.
  void ask(std::map<std::size_t, std::vector<Region>>& boxes, int depth,
    std::vector<ByteBuffer>& questions, std::vector<std::vector<std::size_t>>& asked)
  {
    NodeWriter<TSample> writer(this->Tree);
    for (auto& [nodeIndex, touching] : boxes)
    {
      const Node<TSample> node = this->Tree.nodes[nodeIndex];
      if (!node.isAbsent)
      {
        writer.refine(nodeIndex, touching);
        continue;
      }
      const std::size_t owner = rankAt(this->Begins, node.begin);
      ByteBuffer& question = questions[owner];
      append(question, pathToNode(this->Tree, nodeIndex).index);
      append(question, depth);
      append(question, static_cast<std::uint64_t>(touching.size()));
      append(question, touching.data(), touching.size());
      asked[owner].push_back(nodeIndex);
    }
  }

  std::vector<ByteBuffer> answer(const std::vector<ByteBuffer>& questions)
  {
    std::vector<ByteBuffer> answers(questions.size());
    NodeWriter<TSample> writer(this->Tree);
    for (std::size_t rank = 0; rank < questions.size(); ++rank)
    {
      ByteReader in(questions[rank]);
      while (!in.isAtEnd())
      {
        const auto index = in.read<BinaryIndex>();
        const int depth = in.read<int>();
        std::vector<Region> boxes(in.read<std::uint64_t>());
        in.read(boxes.data(), boxes.size());
        writer.write(index, depth, boxes, answers[rank]);
      }
    }
    return answers;
  }

  ProcessGroup& Processes;
  SampleTree<TSample>& Tree;
  const std::vector<std::uint64_t>& Begins;
};

} // namespace isopoint
