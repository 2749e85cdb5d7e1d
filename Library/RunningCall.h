// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Failure.h"

#include <atomic>

#ifndef _WIN32
#include <pthread.h>
#endif

namespace isopoint
{

/// A call of the library while it runs.
///
/// A process that is forked meanwhile has only one of the threads, but the locks that the others
/// hold: in it, calls would wait for ever.
class RunningCall
{
public:
  /// @throws UsageError in such a process
  RunningCall()
  {
    ++Count; // before the check: a fork may come between both
    if (wasForkedMeanwhile())
    {
      --Count;
      throw UsageError("This process was forked during a call: it cannot contour. Fork between"
                       " calls, or spawn processes instead.",
        UsageError::Fork);
    }
  }

  ~RunningCall() { --Count; }

  RunningCall(const RunningCall&) = delete;
  RunningCall& operator=(const RunningCall&) = delete;

  /// Whether this process was forked during a call.
  static bool wasForkedMeanwhile() { return IsForked; }

private:
  static bool watchForks()
  {
#ifndef _WIN32
    pthread_atfork(nullptr, nullptr, []() { IsForked = IsForked || Count > 0; });
#endif
    return true;
  }

  inline static std::atomic<int> Count{ 0 };
  inline static std::atomic<bool> IsForked{ false };
  inline static const bool AreForksWatched = watchForks();
};

} // namespace isopoint
