// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

namespace isopoint
{

/// Values computed on demand and shared by all threads, by index. Known values are read without a
/// lock. Memory: 16 values for each block of 16 indices with a known value, and a pointer for each
/// block up to four times the greatest index.
/// @tparam T default constructible and copyable
template <class T>
class ConcurrentMemo
{
public:
  /// The value of an index, computed at the first request; O(1) afterwards. Thread-safe.
  /// @param compute() the value; threads that ask at the same time may each compute it
  /// @throws std::bad_alloc, and whatever compute() throws
  template <class Compute>
  T at(std::size_t index, const Compute& compute)
  {
    Block& block = this->blockAt(index / blockSize);
    const std::size_t slot = index % blockSize;
    if (!block.isKnown[slot].load(std::memory_order_acquire))
    {
      const T value = compute();
      const std::lock_guard<std::mutex> lock(this->Mutex);
      if (!block.isKnown[slot].load(std::memory_order_relaxed))
      {
        block.values[slot] = value;
        block.isKnown[slot].store(true, std::memory_order_release);
      }
    }
    return block.values[slot];
  }

private:
  static constexpr std::size_t blockSize = 16;

  struct Block
  {
    std::array<T, blockSize> values;
    std::array<std::atomic<bool>, blockSize> isKnown{};
  };

  /// Rows of blocks never move; each is four times as long as the one before.
  static constexpr std::size_t rowCount = 27;
  static constexpr std::size_t firstRowSize = 1024;
  using Row = std::vector<std::atomic<Block*>>;

  Block& blockAt(std::size_t number)
  {
    std::size_t row = 0;
    std::size_t size = firstRowSize;
    for (; number >= size; ++row, size *= 4)
    {
      number -= size;
    }
    const Row* const known = this->Rows[row].load(std::memory_order_acquire);
    Block* const block = known ? (*known)[number].load(std::memory_order_acquire) : nullptr;
    return block ? *block : this->makeBlock(row, size, number);
  }

  Block& makeBlock(std::size_t row, std::size_t size, std::size_t number)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (!this->RowMemory[row])
    {
      this->RowMemory[row] = std::make_unique<Row>(size);
      this->Rows[row].store(this->RowMemory[row].get(), std::memory_order_release);
    }
    std::atomic<Block*>& slot = (*this->RowMemory[row])[number];
    if (!slot.load(std::memory_order_relaxed))
    {
      this->BlockMemory.push_back(std::make_unique<Block>());
      slot.store(this->BlockMemory.back().get(), std::memory_order_release);
    }
    return *slot.load(std::memory_order_relaxed);
  }

  std::mutex Mutex; // for changes
  std::array<std::atomic<Row*>, rowCount> Rows{};
  std::array<std::unique_ptr<Row>, rowCount> RowMemory;
  std::vector<std::unique_ptr<Block>> BlockMemory;
};

} // namespace isopoint
