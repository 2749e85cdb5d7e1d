// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_NodeExchange_h
#define isopoint_NodeExchange_h

#include "Core/Base/Team.h"
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

/// Fetches what searches in a rank's tree miss from the ranks that hold it, in rounds in which all
/// ranks ask and answer. All functions are collective.
template <class TSample>
class NodeExchange
{
public:
  /// @param begins see SharedTree
  NodeExchange(Team& team, SampleTree<TSample>& tree, const std::vector<std::uint64_t>& begins)
    : Group(team)
    , Tree(tree)
    , Begins(begins)
  {
  }

  /// Fetches the nodes of a depth below the missing ones, as far as they touch their boxes, with
  /// their ranges of values; samples, for a depth below all leaves. What is missing of this rank's
  /// own nodes is split. Empties the list. @returns whether any rank missed any
  bool fetchNodes(std::vector<MissingNode>& missing, int depth)
  {
    if (!this->Group.isAny(!missing.empty()))
    {
      return false;
    }
    std::map<std::size_t, std::vector<Region>> boxes; // by node
    for (const MissingNode& node : missing)
    {
      boxes[node.nodeIndex].push_back(node.box);
    }
    missing.clear();
    const auto ranks = static_cast<std::size_t>(this->Group.size());
    std::vector<ByteBuffer> questions(ranks);
    std::vector<std::vector<std::size_t>> asked(ranks); // nodes, of each rank
    this->ask(boxes, depth, questions, asked);
    const std::vector<ByteBuffer> answers = this->answer(this->Group.exchange(questions));
    const std::vector<ByteBuffer> found = this->Group.exchange(answers);
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
  /// Writes the questions for each rank: node, depth, boxes. What is missing of this rank's own
  /// nodes is split at once.
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
      append(question, pathToLeaf(this->Tree, nodeIndex).index);
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
        std::vector<Region> boxes(static_cast<std::size_t>(in.read<std::uint64_t>()));
        in.read(boxes.data(), boxes.size());
        writer.write(index, depth, boxes, answers[rank]);
      }
    }
    return answers;
  }

  Team& Group;
  SampleTree<TSample>& Tree;
  const std::vector<std::uint64_t>& Begins;
};

} // namespace isopoint

#endif
