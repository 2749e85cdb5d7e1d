// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/ProcessGroup.h"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace isopoint
{

/// Numbers of items of all ranks, which only the rank of an item has. All functions are collective.
class ItemNumbers
{
public:
  /// @param itemCounts of each rank
  /// @param ids of the items that this rank needs, in any order
  ItemNumbers(ProcessGroup& processes, const std::vector<std::uint64_t>& itemCounts,
    const std::vector<std::uint64_t>& ids)
    : Processes(processes)
    , Asked(itemCounts.size())
  {
    std::vector<std::uint64_t> begins(itemCounts.size() + 1, 0);
    std::partial_sum(itemCounts.begin(), itemCounts.end(), begins.begin() + 1);
    for (const std::uint64_t id : ids)
    {
      const std::size_t rank = rankAt(begins, id);
      this->Asked[rank].push_back(id - begins[rank]);
      this->Ranks.push_back(rank);
    }
    this->Wanted = processes.exchange(this->Asked);
  }

  /// @param read(ids, count, numbers) reads numbers of this rank's items by local ids
  /// @returns the numbers of the items that this rank needs
  template <class Read>
  std::vector<double> fetch(const Read& read)
  {
    std::vector<std::vector<double>> answers(this->Wanted.size());
    for (std::size_t rank = 0; rank < answers.size(); ++rank)
    {
      answers[rank].resize(this->Wanted[rank].size());
      read(this->Wanted[rank].data(), this->Wanted[rank].size(), answers[rank].data());
    }
    const std::vector<std::vector<double>> found = this->Processes.exchange(answers);
    std::vector<std::size_t> next(found.size(), 0);
    std::vector<double> numbers;
    numbers.reserve(this->Ranks.size());
    for (const std::size_t rank : this->Ranks)
    {
      numbers.push_back(found[rank][next[rank]++]);
    }
    return numbers;
  }

private:
  ProcessGroup& Processes;
  std::vector<std::vector<std::uint64_t>> Asked;  // by rank: local ids of items
  std::vector<std::vector<std::uint64_t>> Wanted; // by rank: this rank's items that it needs
  std::vector<std::size_t> Ranks;                 // of each item
};

} // namespace isopoint
