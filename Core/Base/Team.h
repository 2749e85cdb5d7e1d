// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Team_h
#define isopoint_Team_h

#include "Core/Base/Execution.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <type_traits>
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

/// A whole number for each finite double, so that the numbers compare as the doubles do; that of -0
/// is that of 0.
inline std::uint64_t orderedKey(double number)
{
  constexpr std::uint64_t sign = std::uint64_t{ 1 } << 63;
  const double normalized = number == 0.0 ? 0.0 : number;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &normalized, sizeof(bits));
  return (bits & sign) != 0 ? ~bits : bits | sign;
}

/// The double of a number.
inline double fromOrderedKey(std::uint64_t key)
{
  constexpr std::uint64_t sign = std::uint64_t{ 1 } << 63;
  const std::uint64_t bits = (key & sign) != 0 ? key & ~sign : ~key;
  double number = 0.0;
  std::memcpy(&number, &bits, sizeof(number));
  return number;
}

/// Thrown on the ranks that did not fail themselves, where another one did.
struct FailedElsewhere : std::runtime_error
{
  FailedElsewhere()
    : std::runtime_error("another rank failed")
  {
  }
};

/// What a rank has sent and received since its Team was made.
struct Traffic
{
  std::uint64_t sent = 0;     // bytes to other ranks, except for those of sums and maxima
  std::uint64_t received = 0; // likewise
  std::uint64_t rounds = 0;   // exchanges in which any rank sent anything
};

/// The rank in whose part a number is. @param begins of the ranks' parts, ascending, the first 0;
/// an end may follow. The number is below that
inline std::size_t rankAt(const std::vector<std::uint64_t>& begins, std::uint64_t number)
{
  return static_cast<std::size_t>(
    std::upper_bound(begins.begin(), begins.end(), number) - begins.begin() - 1);
}

/// Ranks that work together. Work runs inside together(); all other functions but rank(), size()
/// and traffic() are collective, and are called from there.
///
/// A rank may throw anywhere. Every collective function begins with a maximum of one number for
/// each rank, in which a rank that threw takes part in its place, with a number above all others:
/// the ranks that reach the function throw as well, before anything is sent. A team of one rank
/// costs next to nothing.
class Team
{
public:
  explicit Team(Communicator& communicator)
    : Channel(communicator)
  {
  }

  int rank() const { return this->Channel.rank(); }
  int size() const { return this->Channel.size(); }
  const Traffic& traffic() const { return this->Counted; }

  /// Does work that all ranks do, with collective functions in any place.
  /// @throws what the work throws; else, if that of any other rank threw, Aborted if it was aborted
  /// or FailedElsewhere. So it throws on all ranks, or on none
  template <class Work>
  void together(const Work& work)
  {
    this->IsOver = false;
    try
    {
      work();
      this->agree();
    }
    catch (const Aborted&)
    {
      this->tell(aborted);
      throw;
    }
    catch (...)
    {
      this->tell(failed);
      throw;
    }
  }

  bool isAny(bool mine) { return this->agree(mine ? 1 : 0) != 0; }

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

  /// Sends a list to each rank. @returns the lists of each rank for this one
  /// @param outgoing one list for each rank
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
    this->agree();
    this->Channel.exchange(from, to);
    std::vector<std::vector<T>> received(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      received[i].resize(static_cast<std::size_t>(sizes[i]));
      from[i] = { outgoing[i].data(), outgoing[i].size() * sizeof(T) };
      to[i] = { received[i].data(), received[i].size() * sizeof(T) };
    }
    this->exchange(from, to);
    return received;
  }

  /// Sends a list to all ranks. @returns the lists of all ranks, in their order
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
      all[i].resize(static_cast<std::size_t>(sizes[i]));
      to[i] = { all[i].data(), all[i].size() * sizeof(T) };
    }
    this->exchange(from, to);
    return all;
  }

  /// Sends and receives memory of known sizes.
  void exchange(
    const std::vector<OutgoingBytes>& outgoing, const std::vector<IncomingBytes>& incoming)
  {
    this->agree();
    for (std::size_t i = 0; i < outgoing.size(); ++i)
    {
      if (i != this->index())
      {
        this->Counted.sent += outgoing[i].count;
        this->Counted.received += incoming[i].count;
      }
    }
    ++this->Counted.rounds;
    this->Channel.exchange(outgoing, incoming);
  }

private:
  static constexpr std::uint64_t aborted = std::uint64_t{ 1 } << 63;
  static constexpr std::uint64_t failed = aborted + 1;

  std::size_t index() const { return static_cast<std::size_t>(this->rank()); }
  std::size_t count() const { return static_cast<std::size_t>(this->size()); }

  /// Lets the next collective function of the other ranks throw, unless they have.
  void tell(std::uint64_t failure)
  {
    if (!this->IsOver)
    {
      this->Channel.allReduce(&failure, 1, Reduction::Maximum);
      this->IsOver = true;
    }
  }

  /// The maximum of all ranks' numbers, unless a rank has failed.
  /// @param number below `aborted`
  std::uint64_t agree(std::uint64_t number = 0)
  {
    this->Channel.allReduce(&number, 1, Reduction::Maximum);
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
    this->agree();
    this->Channel.allReduce(&number, 1, reduction);
    return number;
  }

  void reduce(std::vector<std::uint64_t>& numbers, Reduction reduction)
  {
    this->agree();
    this->Channel.allReduce(numbers.data(), numbers.size(), reduction);
  }

  Communicator& Channel;
  Traffic Counted;
  bool IsOver = false; // all ranks know that the work has failed
};

} // namespace isopoint

#endif
