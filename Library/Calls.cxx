// SPDX-License-Identifier: GPL-3.0-or-later
#include "Library/Calls.h"

#include "Core/Base/Threads.h"

#include <algorithm>
#include <cstddef>
#include <string>

#ifdef _WIN32
#include <windows.h>
#endif

namespace isopoint
{
namespace
{

/// The message of this thread's last failed call.
thread_local const char* lastError = "";
thread_local std::string lastText; // not touched where memory is lacking: its first use takes some

isopoint_status fail(isopoint_status status, std::string& message)
{
  lastText.swap(message);
  lastError = lastText.c_str();
  return status;
}

isopoint_status statusOf(UsageError::Kind kind)
{
  switch (kind)
  {
    case UsageError::Array:
      return ISOPOINT_INVALID_ARRAY;
    case UsageError::Option:
      return ISOPOINT_INVALID_OPTION;
    case UsageError::Order:
      return ISOPOINT_INVALID_ORDER;
    case UsageError::Fork:
      return ISOPOINT_FORKED;
    default:
      return ISOPOINT_INVALID_ARGUMENT;
  }
}

/// Keeps the library on Windows when a program unloads it: oneTBB's threads may still run. Linux
/// always keeps it, by CMakeLists.txt, and macOS, since it has thread_local variables.
void stayLoaded()
{
#ifdef _WIN32
  HMODULE library = nullptr;
  GetModuleHandleExW(GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_PIN,
    reinterpret_cast<LPCWSTR>(&stayLoaded), &library);
#endif
}

} // namespace

isopoint_status failWithException()
{
  Failure failure = describeException();
  switch (failure.kind)
  {
    case Failure::Aborted:
      failure.text = "Canceled.";
      return fail(ISOPOINT_CANCELED, failure.text);
    case Failure::InvalidUsage:
      return fail(statusOf(failure.usage), failure.text);
    case Failure::OutOfMemory:
      lastError = outOfMemoryText;
      return ISOPOINT_OUT_OF_MEMORY;
    default:
      return fail(ISOPOINT_INTERNAL_ERROR, failure.text);
  }
}

void setThreads(Execution& execution, std::int32_t threads)
{
  if (threads < 0)
  {
    throw UsageError("The number of threads is " + std::to_string(threads) +
                     ". Pass 0, for all cores, or a number above.");
  }
  Execution chosen;
  const std::size_t available = availableThreadsOfRank();
  const std::size_t most =
    threads > 0 ? std::min(static_cast<std::size_t>(threads), available) : available;
  if (most > 1)
  {
    stayLoaded();
    useThreads(chosen, most);
  }
  execution.parallelFor = chosen.parallelFor;
  execution.threads = chosen.threads;
}

void setCallbacks(Execution& execution, isopoint_progress_callback progress,
  isopoint_cancel_callback isCanceled, void* user)
{
  Execution chosen;
  if (progress)
  {
    chosen.progress = [progress, user](double fraction) { progress(user, fraction); };
  }
  if (isCanceled)
  {
    chosen.isAborted = [isCanceled, user]() { return isCanceled(user) != 0; };
  }
  execution.progress = chosen.progress;
  execution.isAborted = chosen.isAborted;
}

} // namespace isopoint

const char* isopoint_version(void)
{
  return ISOPOINT_VERSION;
}

int32_t isopoint_version_number(void)
{
  return ISOPOINT_VERSION_NUMBER;
}

const char* isopoint_get_error(void)
{
  return isopoint::lastError;
}
