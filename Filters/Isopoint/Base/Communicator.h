// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Communicator_h
#define isopoint_Communicator_h

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isopoint
{

/// Bytes that are sent, or room for those that are received; owned by the caller.
struct OutgoingBytes
{
  const void* bytes = nullptr;
  std::size_t count = 0;
};
struct IncomingBytes
{
  void* bytes = nullptr;
  std::size_t count = 0;
};

enum class Reduction
{
  Sum, // modulo 2^64
  Maximum
};

/// How the processes that extract one cloud together, the ranks, exchange data. Every function is
/// collective: all ranks call the same ones in the same order, each from one thread, and each call
/// returns once this rank's part is done. None of them fails but by ending the program.
class Communicator
{
public:
  Communicator() = default;
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;
  virtual ~Communicator() = default;

  /// The number of this rank, below size().
  virtual int rank() const = 0;

  /// At least 1.
  virtual int size() const = 0;

  /// Replaces each of `count` numbers by that number's sum or maximum over all ranks.
  virtual void allReduce(std::uint64_t* numbers, std::size_t count, Reduction reduction) = 0;

  /// Sends outgoing[r] to each rank r and receives incoming[r] from it, this rank included, of any
  /// size.
  /// @param outgoing, incoming one entry for each rank; the sizes agree with those of the others
  virtual void exchange(
    const std::vector<OutgoingBytes>& outgoing, const std::vector<IncomingBytes>& incoming) = 0;
};

} // namespace isopoint

#endif
