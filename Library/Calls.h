// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Library/isopoint.h"

#include "Core/Base/Execution.h"
#include "Core/Failure.h"
#include "Library/RunningCall.h"

#include <cstdint>
#include <string>

namespace isopoint
{

/// Converts the current exception to a status and to the text of isopoint_get_error().
isopoint_status failWithException();

/// Runs a function; no exception leaves the library.
template <class Function>
isopoint_status attempt(const Function& function)
{
  try
  {
    function();
    return ISOPOINT_OK;
  }
  catch (...)
  {
    return failWithException();
  }
}

/// Runs a call, unless this process was forked during another.
template <class Call>
isopoint_status run(const Call& call)
{
  return attempt(
    [&]()
    {
      const RunningCall running;
      call();
    });
}

/// Frees an object, unless a lock may forbid it.
template <class T>
void destroy(T* object)
{
  if (!RunningCall::wasForkedMeanwhile())
  {
    delete object;
  }
}

/// @throws UsageError if a pointer is null
inline void require(const void* pointer, const char* name)
{
  if (!pointer)
  {
    throw UsageError(std::string("The ") + name + " is null. Pass one.");
  }
}

/// Runs a call on an object, unless it is null.
template <class Call>
isopoint_status runOn(const void* object, const char* name, const Call& call)
{
  return run(
    [&]()
    {
      require(object, name);
      call();
    });
}

/// Sets the threads of an execution. @param threads maximum number, or 0 for all cores
/// @throws UsageError if it is negative
void setThreads(Execution& execution, std::int32_t threads);

/// Sets the callbacks of an execution. @param progress, isCanceled may be null
void setCallbacks(Execution& execution, isopoint_progress_callback progress,
  isopoint_cancel_callback isCanceled, void* user);

} // namespace isopoint
