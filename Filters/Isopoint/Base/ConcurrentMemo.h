// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_ConcurrentMemo_h
#define isopoint_ConcurrentMemo_h

#include <cstddef>
#include <mutex>
#include <unordered_map>

namespace isopoint
{

/// What was computed for nodes of a tree, each about once for all threads that share it.
template <class T>
class ConcurrentMemo
{
public:
  /// O(1) but for the first time a nodeIndex is asked for. From any thread.
  /// @param compute() its value; threads that ask at once may each compute it
  /// @throws std::bad_alloc, and what compute() does
  template <class Compute>
  T at(std::size_t nodeIndex, const Compute& compute)
  {
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      const auto found = this->Values.find(nodeIndex);
      if (found != this->Values.end())
      {
        return found->second;
      }
    }
    const T value = compute();
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return this->Values.emplace(nodeIndex, value).first->second;
  }

private:
  std::mutex Mutex;
  std::unordered_map<std::size_t, T> Values; // by nodeIndex
};

} // namespace isopoint

#endif
