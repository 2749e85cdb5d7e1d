// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <mutex>
#include <shared_mutex>
#include <unordered_map>

namespace isopoint
{

/// Values computed on demand and shared by all threads, by index.
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
    {
      const std::shared_lock<std::shared_mutex> lock(this->Mutex);
      const auto found = this->Values.find(index);
      if (found != this->Values.end())
      {
        return found->second;
      }
    }
    const T value = compute();
    const std::lock_guard<std::shared_mutex> lock(this->Mutex);
    return this->Values.emplace(index, value).first->second;
  }

private:
  std::shared_mutex Mutex;
  std::unordered_map<std::size_t, T> Values;
};

} // namespace isopoint
