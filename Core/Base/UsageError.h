// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_UsageError_h
#define isopoint_UsageError_h

#include <stdexcept>

namespace isopoint
{

/// Invalid input or options. what() is the message for the user: a sentence that names the cause
/// and one that names the remedy.
struct UsageError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

} // namespace isopoint

#endif
