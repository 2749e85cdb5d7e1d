// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SlotMemory_h
#define isopoint_SlotMemory_h

#include <cstddef>
#include <mutex>
#include <unordered_map>

namespace isopoint
{

/// What was computed for nodes of a tree, each about once for all threads that share it.
template <class T>
class SlotMemory
{
public:
  /// O(1) but for the first time a slot is asked for. From any thread.
  /// @param compute() its value; threads that ask at once may each compute it
  /// @throws std::bad_alloc, and what compute() does
  template <class Compute>
  T at(std::size_t slot, const Compute& compute)
  {
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      const auto found = this->Values.find(slot);
      if (found != this->Values.end())
      {
        return found->second;
      }
    }
    const T value = compute();
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return this->Values.emplace(slot, value).first->second;
  }

private:
  std::mutex Mutex;
  std::unordered_map<std::size_t, T> Values; // by slot
};

} // namespace isopoint

#endif
