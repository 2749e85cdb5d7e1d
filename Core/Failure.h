// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace isopoint
{

class ProcessGroup;

/// Invalid input or options. what() tells the user the cause, then the remedy, in a sentence each.
struct UsageError : std::runtime_error
{
  enum Kind
  {
    Argument, // a pointer, a number or the samples
    Array,    // its type, size or memory
    Option,   // out of range, or not with another one
    Order,    // another call has to come first
    Fork      // the process was forked during a call
  };

  explicit UsageError(const std::string& text, Kind ofKind = Argument)
    : std::runtime_error(text)
    , kind(ofKind)
  {
  }

  Kind kind;
};

/// Why an extraction ended without a result.
struct Failure
{
  enum Kind
  {
    None,
    Aborted,      // by the caller
    Elsewhere,    // only on another rank
    InvalidUsage, // of input or options
    OutOfMemory,  // or more than there can be
    Bug
  };
  Kind kind = None;
  std::string text{}; // for the user: the cause, then the remedy; may be empty

  UsageError::Kind usage = UsageError::Argument; // of InvalidUsage

  /// Whether to drop data kept for further extractions: memory is needed, or they may be invalid.
  bool spoilsTree() const { return this->kind == OutOfMemory || this->kind == Bug; }
};

/// For the user, of a lack of memory.
inline constexpr const char* outOfMemoryText =
  "Out of memory. Free memory, or reduce the number of samples or of places.";

/// Describes the exception that is being handled.
Failure describeException() noexcept;

/// On rank 0, the text of the lowest rank that has one, after its number; elsewhere, or if there is
/// none, empty. Of a single rank, its text. Collective.
std::string firstText(ProcessGroup& processes, const Failure& failure);

} // namespace isopoint
