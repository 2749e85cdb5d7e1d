// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Hash.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace isopoint
{

/// Memory to send or to receive into; the caller owns it.
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

/// Transport between the ranks, the processes that extract one cloud together. Every function is
/// collective: all ranks call the same functions in the same order, each from one thread. A call
/// returns once this rank's part is done; a failed one ends the program.
class Communicator
{
public:
  Communicator() = default;
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;
  virtual ~Communicator() = default;

  /// In [0, size()).
  virtual int rank() const = 0;

  virtual int size() const = 0;

  /// Replaces each of `count` numbers by its sum or maximum over all ranks.
  virtual void allReduce(std::uint64_t* numbers, std::size_t count, Reduction reduction) = 0;

  /// Sends outgoing[r] to and receives incoming[r] from each rank r, this rank included.
  /// @param outgoing, incoming one entry per rank, of any size that sender and receiver agree on
  virtual void exchange(
    const std::vector<OutgoingBytes>& outgoing, const std::vector<IncomingBytes>& incoming) = 0;
};

/// Maps finite doubles to integers in the same order; -0 and 0 map to one number.
inline std::uint64_t orderedKey(double number)
{
  constexpr std::uint64_t sign = std::uint64_t{ 1 } << 63;
  const std::uint64_t bits = bitsOf(number == 0.0 ? 0.0 : number);
  return (bits & sign) != 0 ? ~bits : bits | sign;
}

/// The inverse of orderedKey().
inline double fromOrderedKey(std::uint64_t key)
{
  constexpr std::uint64_t sign = std::uint64_t{ 1 } << 63;
  const std::uint64_t bits = (key & sign) != 0 ? key & ~sign : ~key;
  double number = 0.0;
  std::memcpy(&number, &bits, sizeof(number));
  return number;
}

/// Thrown on ranks that did not fail, if another rank failed.
struct FailedElsewhere : std::runtime_error
{
  FailedElsewhere()
    : std::runtime_error("another rank failed")
  {
  }
};

/// The rank whose part contains a number.
/// @param begins begins of the ranks' parts, ascending from 0; the last end may follow
/// @param number below the last end
inline std::size_t rankAt(const std::vector<std::uint64_t>& begins, std::uint64_t number)
{
  return static_cast<std::size_t>(
    std::upper_bound(begins.begin(), begins.end(), number) - begins.begin() - 1);
}

/// A process group. Work runs inside runCollectively(); all functions but rank() and size() are
/// collective and are called from there. A rank may throw anywhere. Every collective function first
/// reduces a status by maximum. If a rank has failed, all others throw here, before they send any
/// data. The cost is negligible in a group of one rank.
class ProcessGroup
{
public:
  explicit ProcessGroup(Communicator& communicator)
    : Transport(communicator)
  {
  }

  int rank() const { return this->Transport.rank(); }
  int size() const { return this->Transport.size(); }

  /// Runs work that may call collective functions. It throws on all ranks or on none.
  /// @throws whatever `work` throws; if only another rank's work threw, Aborted or FailedElsewhere
  template <class Work>
  void runCollectively(const Work& work)
  {
    this->IsOver = false;
    try
    {
      work();
      this->reduceStatus();
    }
    catch (const Aborted&)
    {
      this->reportFailure(aborted);
      throw;
    }
    catch (...)
    {
      this->reportFailure(failed);
      throw;
    }
  }

  bool isAny(bool mine) { return this->reduceStatus(mine ? 1 : 0) != 0; }

  void maximum(std::vector<std::uint64_t>& numbers) { this->reduce(numbers, Reduction::Maximum); }
  void sum(std::vector<std::uint64_t>& numbers) { this->reduce(numbers, Reduction::Sum); }
  std::uint64_t maximum(std::uint64_t number) { return this->reduced(number, Reduction::Maximum); }
  std::uint64_t sum(std::uint64_t number) { return this->reduced(number, Reduction::Sum); }

  /// The number of each rank.
  std::vector<std::uint64_t> gather(std::uint64_t number)
  {
    std::vector<std::uint64_t> all(this->count(), 0);
    all[this->index()] = number;
    this->sum(all);
    return all;
  }

  /// Sends one list to each rank. @returns the lists that the ranks sent to this one
  template <class T>
  std::vector<std::vector<T>> exchange(const std::vector<std::vector<T>>& outgoing)
  {
    static_assert(std::is_trivially_copyable_v<T>, "elements are sent by their bytes");
    const std::size_t count = this->count();
    std::vector<std::uint64_t> ownSizes(count);
    std::vector<std::uint64_t> sizes(count);
    std::vector<OutgoingBytes> from(count);
    std::vector<IncomingBytes> to(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      ownSizes[i] = outgoing[i].size();
      from[i] = { &ownSizes[i], sizeof(std::uint64_t) };
      to[i] = { &sizes[i], sizeof(std::uint64_t) };
    }
    this->exchange(from, to);
    std::vector<std::vector<T>> received(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      received[i].resize(sizes[i]);
      from[i] = { outgoing[i].data(), outgoing[i].size() * sizeof(T) };
      to[i] = { received[i].data(), received[i].size() * sizeof(T) };
    }
    this->exchange(from, to);
    return received;
  }

  /// Sends a list to all ranks. @returns the lists of all ranks
  template <class T>
  std::vector<std::vector<T>> gather(const std::vector<T>& own)
  {
    static_assert(std::is_trivially_copyable_v<T>, "elements are sent by their bytes");
    const std::vector<std::uint64_t> sizes = this->gather(std::uint64_t{ own.size() });
    const std::vector<OutgoingBytes> from(sizes.size(), { own.data(), own.size() * sizeof(T) });
    std::vector<IncomingBytes> to(sizes.size());
    std::vector<std::vector<T>> all(sizes.size());
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      all[i].resize(sizes[i]);
      to[i] = { all[i].data(), all[i].size() * sizeof(T) };
    }
    this->exchange(from, to);
    return all;
  }

  /// Sends and receives memory of known sizes; see Communicator::exchange().
  void exchange(
    const std::vector<OutgoingBytes>& outgoing, const std::vector<IncomingBytes>& incoming)
  {
    this->reduceStatus();
    this->Transport.exchange(outgoing, incoming);
  }

private:
  static constexpr std::uint64_t aborted = std::uint64_t{ 1 } << 63;
  static constexpr std::uint64_t failed = aborted + 1;

  std::size_t index() const { return static_cast<std::size_t>(this->rank()); }
  std::size_t count() const { return static_cast<std::size_t>(this->size()); }

  /// Makes the next collective function of the other ranks throw, unless they know of the failure.
  void reportFailure(std::uint64_t failure)
  {
    if (!this->IsOver)
    {
      this->Transport.allReduce(&failure, 1, Reduction::Maximum);
      this->IsOver = true;
    }
  }

  /// The maximum over all ranks; throws if a rank has failed.
  /// @param number below `aborted`
  std::uint64_t reduceStatus(std::uint64_t number = 0)
  {
    this->Transport.allReduce(&number, 1, Reduction::Maximum);
    this->IsOver = number >= aborted;
    if (number == failed)
    {
      throw FailedElsewhere();
    }
    if (number == aborted)
    {
      throw Aborted();
    }
    return number;
  }

  std::uint64_t reduced(std::uint64_t number, Reduction reduction)
  {
    this->reduceStatus();
    this->Transport.allReduce(&number, 1, reduction);
    return number;
  }

  void reduce(std::vector<std::uint64_t>& numbers, Reduction reduction)
  {
    this->reduceStatus();
    this->Transport.allReduce(numbers.data(), numbers.size(), reduction);
  }

  Communicator& Transport;
  bool IsOver = false; // all ranks know of the failure
};

} // namespace isopoint
