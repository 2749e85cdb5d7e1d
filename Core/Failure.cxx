// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Failure.h"

#include "Core/Base/Execution.h"
#include "Core/Base/ProcessGroup.h"
#include "Core/Extraction/TetrahedraLimit.h"
#include "Core/Tree/BinaryIndex.h"

#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <stdexcept>
#include <vector>

namespace isopoint
{

namespace
{

Failure describe()
{
  try
  {
    throw;
  }
  catch (const Aborted&)
  {
    return { Failure::Aborted, {} };
  }
  catch (const FailedElsewhere&)
  {
    return { Failure::Elsewhere, {} };
  }
  catch (const UsageError& error)
  {
    return { Failure::InvalidUsage, error.what(), error.kind };
  }
  catch (const TreeTooLarge& error)
  {
    return { Failure::InvalidUsage, std::string("Cannot build the tree of the samples (") +
                                      error.what() +
                                      "). Merge coincident samples or reduce the number of"
                                      " samples." };
  }
  catch (const TooManyTetrahedra& error)
  {
    return { Failure::InvalidUsage, std::string("The samples have too many tetrahedra (") +
                                      error.what() +
                                      "), because they lie on curves. Extract points instead of"
                                      " triangles, probe values, average samples along the curves,"
                                      " or interpolate with radial basis functions." };
  }
  catch (const std::length_error&)
  {
    return { Failure::OutOfMemory, outOfMemoryText }; // of lists that no memory could hold
  }
  catch (const std::bad_alloc&)
  {
    return { Failure::OutOfMemory, outOfMemoryText };
  }
  catch (const std::exception& error)
  {
    return { Failure::Bug, std::string("The extraction failed unexpectedly (") + error.what() +
                             "). Report this as a bug, with the input." };
  }
  catch (...)
  {
    return { Failure::Bug,
      "The extraction failed unexpectedly. Report this as a bug, with the input." };
  }
}

} // namespace

Failure describeException() noexcept
{
  try
  {
    return describe();
  }
  catch (const std::bad_alloc&)
  {
    return { Failure::OutOfMemory, "Out of memory." }; // fits in the string without an allocation
  }
  catch (...)
  {
    return { Failure::Bug, {} };
  }
}

std::string firstText(ProcessGroup& processes, const Failure& failure)
{
  if (processes.size() == 1)
  {
    return failure.text;
  }
  const auto size = static_cast<std::uint64_t>(processes.size());
  const auto own = static_cast<std::uint64_t>(processes.rank());
  const std::uint64_t lowest = size - processes.maximum(failure.text.empty() ? 0 : size - own);
  if (lowest == size)
  {
    return {};
  }
  std::vector<std::vector<char>> outgoing(size);
  if (lowest == own)
  {
    outgoing.front().assign(failure.text.begin(), failure.text.end());
  }
  const std::vector<std::vector<char>> arrived = processes.exchange(outgoing);
  const std::vector<char>& text = arrived[lowest];
  return text.empty()
           ? std::string()
           : "Rank " + std::to_string(lowest) + ": " + std::string(text.begin(), text.end());
}

} // namespace isopoint
