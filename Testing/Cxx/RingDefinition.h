// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "BruteForce.h"

#include "Core/Base/Vector.h"
#include "Core/Fit/LocalFit.h"

/// The definition of the samples around edges, and of their spacing, which docs/algorithm.md
/// outlines in 10.1: from all pairs of cells, independently of the core. Quadratic.
namespace ringdefinition
{

using bruteforce::Cell;
using bruteforce::Region;

/// Numbers of cells, in order.
using Cells = std::vector<std::size_t>;

class Rings
{
public:
  explicit Rings(const clouds::Cloud& cloud)
    : All(bruteforce::Tree(cloud).cells)
    , Neighbors(bruteforce::neighborhoods(this->All))
  {
    for (std::size_t c = 0; c < this->All.size(); ++c)
    {
      this->Numbers[this->All[c].id] = c;
      this->sortAsSearched(c, this->Neighbors[c]);
    }
  }

  const std::vector<Cell>& cells() const { return this->All; }

  /// The cell of the sample with this id, the lowest of coincident ones.
  std::size_t cellOf(std::uint64_t id) const { return this->Numbers.at(id); }

  /// The neighbors of a cell, in the order of the search.
  const Cells& neighborsOf(std::size_t cell) const { return this->Neighbors[cell]; }

  Cells firstRing(std::size_t a, std::size_t b) const
  {
    Cells cells;
    for (const std::size_t end : { std::min(a, b), std::max(a, b) })
    {
      addOnce(cells, { end });
      addOnce(cells, this->takenAt(end, a, b));
    }
    return cells;
  }

  Cells secondRing(std::size_t a, std::size_t b, double isovalue) const
  {
    Cells cells = this->firstRing(a, b);
    if (cells.size() > 128)
    {
      return cells;
    }
    for (const std::size_t end : { std::min(a, b), std::max(a, b) })
    {
      for (const std::size_t neighbor : this->takenAt(end, a, b))
      {
        if ((this->All[neighbor].value < isovalue) != (this->All[end].value < isovalue) &&
            !this->areTooMany(neighbor))
        {
          addOnce(cells, this->Neighbors[neighbor]);
        }
      }
    }
    return cells;
  }

  double spacing(std::size_t a, std::size_t b) const
  {
    double sum = 0.0;
    double count = 0.0;
    for (const std::size_t end : { std::min(a, b), std::max(a, b) })
    {
      const Cells taken = this->takenAt(end, a, b);
      if (!taken.empty())
      {
        sum += this->spacingAt(end, taken);
        count += 1.0;
      }
    }
    return sum / count;
  }

  std::vector<isopoint::FitSample> samplesOf(const Cells& cells) const
  {
    std::vector<isopoint::FitSample> samples;
    for (const std::size_t cell : cells)
    {
      samples.push_back({ this->All[cell].position, this->All[cell].value });
    }
    return samples;
  }

private:
  double spacingAt(std::size_t end, Cells taken) const
  {
    const auto offsetTo = [&](std::size_t cell)
    { return bruteforce::difference(this->All[cell].position, this->All[end].position); };
    const auto distanceTo = [&](std::size_t cell) { return isopoint::lengthOf(offsetTo(cell)); };
    const auto towards = [&](std::size_t cell) { return isopoint::directionOf(offsetTo(cell)); };
    std::stable_sort(taken.begin(), taken.end(),
      [&](std::size_t a, std::size_t b) { return distanceTo(a) < distanceTo(b); });
    const std::size_t rank = 2 * (taken.size() + 1) / 5;
    const double usual = rank > 0 ? distanceTo(taken[rank - 1]) : 0.0;
    const auto first = towards(taken[0]);
    const auto second = std::find_if(taken.begin() + 1, taken.end(),
      [&](std::size_t cell)
      { return std::abs(isopoint::dot(towards(cell), first)) < 0.86602540378443865; });
    if (second == taken.end())
    {
      return usual;
    }
    const auto normal = isopoint::directionOf(isopoint::cross(towards(*second), first));
    const auto third = std::find_if(second + 1, taken.end(),
      [&](std::size_t cell) { return std::abs(isopoint::dot(towards(cell), normal)) > 0.5; });
    return third == taken.end() ? usual : std::min(usual, 1.2 * distanceTo(*third));
  }

  static void addOnce(Cells& cells, const Cells& more)
  {
    for (const std::size_t cell : more)
    {
      if (std::find(cells.begin(), cells.end(), cell) == cells.end())
      {
        cells.push_back(cell);
      }
    }
  }

  bool areTooMany(std::size_t cell) const { return this->Neighbors[cell].size() > 256; }

  /// The neighbors of an end of the edge {a, b} that are taken.
  Cells takenAt(std::size_t end, std::size_t a, std::size_t b) const
  {
    if (!this->areTooMany(end))
    {
      return this->Neighbors[end];
    }
    return this->areTooMany(a) && this->areTooMany(b) ? this->representativesAt(end) : Cells{};
  }

  std::size_t commonTurns(std::size_t a, std::size_t b) const
  {
    const std::vector<bool>& one = this->All[a].path;
    const std::vector<bool>& other = this->All[b].path;
    return static_cast<std::size_t>(
      std::mismatch(one.begin(), one.end(), other.begin(), other.end()).first - one.begin());
  }

  /// By the ancestor whose plane is between, the nearest first, and then by the order of the tree.
  void sortAsSearched(std::size_t cell, Cells& neighbors) const
  {
    std::sort(neighbors.begin(), neighbors.end());
    std::stable_sort(neighbors.begin(), neighbors.end(),
      [&](std::size_t one, std::size_t other)
      { return this->commonTurns(cell, one) > this->commonTurns(cell, other); });
  }

  /// A node: its cells are [begin, end), its depth is the number of turns that these share.
  struct Node
  {
    std::size_t begin;
    std::size_t end;
    std::size_t depth;
  };

  std::pair<Node, Node> childrenOf(const Node& node) const
  {
    std::size_t middle = node.begin;
    while (!this->All[middle].path[node.depth])
    {
      ++middle;
    }
    return { { node.begin, middle, node.depth + 1 }, { middle, node.end, node.depth + 1 } };
  }

  bool touches(std::size_t cell, const Node& node) const
  {
    Region whole = this->All[node.begin].region;
    for (std::size_t c = node.begin; c < node.end; ++c)
    {
      whole.add(this->All[c].region);
    }
    return bruteforce::touch(this->All[cell].region, whole);
  }

  /// Whether the bounding box of a node's samples has a small diagonal from a cell's sample.
  bool isSmall(std::size_t cell, const Node& node) const
  {
    Region box{ this->All[node.begin].position, this->All[node.begin].position };
    for (std::size_t c = node.begin; c < node.end; ++c)
    {
      box.add({ this->All[c].position, this->All[c].position });
    }
    bruteforce::Vector nearest{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double own = this->All[cell].position[axis];
      nearest[axis] = std::max({ 0.0, box.lower[axis] - own, own - box.upper[axis] });
    }
    const bruteforce::Vector diagonal = bruteforce::difference(box.upper, box.lower);
    return bruteforce::dot(diagonal, diagonal) < 0.2 * 0.2 * bruteforce::dot(nearest, nearest);
  }

  /// @param isOne whether only the first cell that touches is wanted
  void addRepresentatives(
    std::size_t cell, const Node& node, Cells& found, bool isOne = false) const
  {
    if (node.end - node.begin == 1)
    {
      found.push_back(node.begin);
      return;
    }
    const auto [lower, upper] = this->childrenOf(node);
    const bool touchesLower = this->touches(cell, lower);
    const bool touchesUpper = this->touches(cell, upper);
    if (touchesLower)
    {
      this->addRepresentatives(
        cell, lower, found, isOne || (touchesUpper && this->isSmall(cell, node)));
    }
    if (touchesUpper && !(touchesLower && (isOne || this->isSmall(cell, node))))
    {
      this->addRepresentatives(cell, upper, found, isOne);
    }
  }

  /// Of the subtrees across the planes of the ancestors, the nearest first.
  Cells representativesAt(std::size_t cell) const
  {
    std::vector<Node> siblings; // from the root down
    Node node{ 0, this->All.size(), 0 };
    while (node.end - node.begin > 1)
    {
      const auto [lower, upper] = this->childrenOf(node);
      const bool isUpper = cell >= upper.begin;
      siblings.push_back(isUpper ? lower : upper);
      node = isUpper ? upper : lower;
    }
    Cells found;
    for (auto sibling = siblings.rbegin(); sibling != siblings.rend(); ++sibling)
    {
      if (this->touches(cell, *sibling))
      {
        this->addRepresentatives(cell, *sibling, found);
      }
    }
    return found;
  }

  std::vector<Cell> All;
  std::vector<Cells> Neighbors;
  std::map<std::uint64_t, std::size_t> Numbers; // of cells, by the ids of their samples
};

} // namespace ringdefinition
