// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_NodeExchange_h
#define isopoint_NodeExchange_h

#include "Isopoint/Base/Team.h"
#include "Isopoint/Extraction/NarrowBand.h"
#include "Isopoint/Ranks/ByteBuffer.h"
#include "Isopoint/Ranks/NodeWriter.h"
#include "Isopoint/Tree/Path.h"
#include "Isopoint/Tree/SampleTree.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

namespace isopoint
{

/// Fetches what searches in a rank's tree miss from the ranks that hold it, in rounds in which all
/// ranks ask and answer. All functions are collective.
template <class TSample>
class NodeExchange : public BandPeers
{
public:
  /// @param begins see SharedTree
  NodeExchange(Team& team, SampleTree<TSample>& tree, const std::vector<std::uint64_t>& begins)
    : Ranks(team)
    , Tree(tree)
    , Begins(begins)
    , Pool(tree)
  {
  }

  Team& team() { return this->Ranks; }
  const SampleTree<TSample>& tree() const { return this->Tree; }

  bool isAny(bool mine) override { return this->Ranks.isAny(mine); }

  bool fetchNodes(std::vector<MissingNode>& missing, int depth) override
  {
    if (!this->Ranks.isAny(!missing.empty()))
    {
      return false;
    }
    const auto ranks = static_cast<std::size_t>(this->Ranks.size());
    std::map<std::size_t, std::vector<Region>> boxes; // by node
    std::vector<ByteBuffer> questions;
    std::vector<std::vector<std::size_t>> asked; // nodes, of each rank
    this->Ranks.together(
      [&]()
      {
        for (const MissingNode& node : missing)
        {
          boxes[node.nodeIndex].push_back(node.box);
        }
        missing.clear();
        questions.resize(ranks);
        asked.resize(ranks);
        this->ask(boxes, depth, questions, asked);
      });
    const std::vector<ByteBuffer> received = this->Ranks.exchange(questions);
    std::vector<ByteBuffer> answers;
    this->Ranks.together([&]() { answers = this->answer(received); });
    const std::vector<ByteBuffer> found = this->Ranks.exchange(answers);
    this->Ranks.together(
      [&]()
      {
        NodeReader<TSample> reader(this->Tree, this->Pool);
        for (std::size_t rank = 0; rank < ranks; ++rank)
        {
          ByteReader in(found[rank]);
          for (const std::size_t node : asked[rank])
          {
            reader.read(node, in);
          }
        }
      });
    return true;
  }

  /// Fetches all samples that are missing, or splits this rank's own nodes down to leaves.
  /// @returns whether any rank missed any
  bool fetch(std::vector<MissingNode>& missing)
  {
    return this->fetchNodes(missing, maximumDepth + 1);
  }

  /// The rank that holds a place in the order of the tree.
  std::size_t ownerOf(std::uint64_t place) const { return rankAt(this->Begins, place); }

private:
  void runTogether(const std::function<void()>& work) override { this->Ranks.together(work); }

  /// Writes the questions for each rank: node, depth, boxes. What is missing of this rank's own
  /// nodes is split at once.
  void ask(std::map<std::size_t, std::vector<Region>>& boxes, int depth,
    std::vector<ByteBuffer>& questions, std::vector<std::vector<std::size_t>>& asked)
  {
    NodeWriter<TSample> writer(this->Tree, this->Pool);
    for (auto& [nodeIndex, touching] : boxes)
    {
      const Node<TSample> node = this->Tree.nodes[nodeIndex];
      if (!node.isAbsent)
      {
        writer.refine(nodeIndex, touching);
        continue;
      }
      const std::size_t owner = this->ownerOf(node.begin);
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
    NodeWriter<TSample> writer(this->Tree, this->Pool);
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

  Team& Ranks;
  SampleTree<TSample>& Tree;
  const std::vector<std::uint64_t>& Begins;
  PairPool<TSample> Pool;
};

} // namespace isopoint

#endif
