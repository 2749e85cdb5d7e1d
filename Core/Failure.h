// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Failure_h
#define isopoint_Failure_h

#include <string>

namespace isopoint
{

class Team;

/// Why an extraction ended without a result.
struct Failure
{
  enum Kinds
  {
    None,
    Aborted,      // by the caller
    Elsewhere,    // on another rank alone
    InvalidUsage, // input or options that cannot be used
    OutOfMemory,
    Bug
  };
  Kinds kind = None;
  std::string text; // for the user: the cause, then the remedy; empty where there is nothing to say

  /// Whether what was kept for further extractions is to be dropped: memory is needed, or it may be
  /// unsound.
  bool spoilsTree() const { return this->kind == OutOfMemory || this->kind == Bug; }
};

/// Describes the exception that is being handled.
Failure describeException() noexcept;

/// The text of the lowest rank that has one, preceded by the number of that rank, on rank 0; empty
/// on all others, and if none has one. Of a single rank its own text. Collective.
std::string firstText(Team& team, const Failure& failure);

} // namespace isopoint

#endif
