// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Team_h
#define isopoint_Team_h

#include "Isopoint/Base/Communicator.h"
#include "Isopoint/Base/Execution.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <vector>

namespace isopoint
{

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

/// Ranks that work together: none of them goes on where another one fails, so that all of them
/// reach the same exchanges. All functions are collective.
class Team
{
public:
  explicit Team(Communicator& communicator)
    : Link(communicator)
  {
  }

  /// What together() tells the other ranks of a failure. A step in its place tells this or more.
  static constexpr std::uint64_t failed = 2;

  int rank() const { return this->Link.rank(); }
  int size() const { return this->Link.size(); }
  const Traffic& traffic() const { return this->Counted; }

  /// Does this rank's share of some work, without any exchange in it, and returns once that of all
  /// ranks is done.
  /// @throws what the work throws; else, if that of any other rank threw, Aborted if it was aborted
  /// or FailedElsewhere
  template <class Work>
  void together(const Work& work)
  {
    std::exception_ptr own;
    std::uint64_t failure = none;
    try
    {
      work();
    }
    catch (const Aborted&)
    {
      own = std::current_exception();
      failure = aborted;
    }
    catch (...)
    {
      own = std::current_exception();
      failure = failed;
    }
    this->Link.allReduce(&failure, 1, Reduction::Maximum);
    // What is larger is of a rank that failed between such steps.
    if (failure >= failed && own)
    {
      std::rethrow_exception(own);
    }
    if (failure >= failed)
    {
      throw FailedElsewhere();
    }
    if (failure == aborted)
    {
      throw Aborted();
    }
  }

  void sum(std::vector<std::uint64_t>& numbers)
  {
    this->Link.allReduce(numbers.data(), numbers.size(), Reduction::Sum);
  }
  void maximum(std::vector<std::uint64_t>& numbers)
  {
    this->Link.allReduce(numbers.data(), numbers.size(), Reduction::Maximum);
  }
  std::uint64_t sum(std::uint64_t number)
  {
    this->Link.allReduce(&number, 1, Reduction::Sum);
    return number;
  }
  std::uint64_t maximum(std::uint64_t number)
  {
    this->Link.allReduce(&number, 1, Reduction::Maximum);
    return number;
  }
  bool isAny(bool mine) { return this->maximum(mine ? 1 : 0) != 0; }

  /// The number of each rank.
  std::vector<std::uint64_t> gather(std::uint64_t number)
  {
    std::vector<std::uint64_t> all(static_cast<std::size_t>(this->size()), 0);
    all[static_cast<std::size_t>(this->rank())] = number;
    this->sum(all);
    return all;
  }

  /// Sends a list to each rank. @returns the lists of each rank for this one
  /// @param outgoing one list for each rank, of trivially copyable elements
  /// @throws std::bad_alloc or FailedElsewhere, before anything is sent
  template <class T>
  std::vector<std::vector<T>> exchange(const std::vector<std::vector<T>>& outgoing)
  {
    const std::size_t count = outgoing.size();
    std::vector<std::vector<T>> received;
    std::vector<std::uint64_t> outgoingSizes;
    std::vector<std::uint64_t> sizes;
    std::vector<OutgoingBytes> from;
    std::vector<IncomingBytes> to;
    this->together(
      [&]()
      {
        sizes.resize(count);
        from.resize(count);
        to.resize(count);
        received.resize(count);
        for (std::size_t i = 0; i < count; ++i)
        {
          outgoingSizes.push_back(outgoing[i].size());
        }
      });
    this->exchangeSizes(outgoingSizes, sizes, from, to);
    this->together(
      [&]()
      {
        for (std::size_t i = 0; i < count; ++i)
        {
          received[i].resize(static_cast<std::size_t>(sizes[i]));
          from[i] = { outgoing[i].data(), outgoing[i].size() * sizeof(T) };
          to[i] = { received[i].data(), received[i].size() * sizeof(T) };
        }
      });
    this->exchange(from, to);
    return received;
  }

  /// Sends a list to all ranks. @returns the lists of all ranks, in their order
  /// @param own of trivially copyable elements
  /// @throws std::bad_alloc or FailedElsewhere, before anything is sent
  template <class T>
  std::vector<std::vector<T>> gather(const std::vector<T>& own)
  {
    std::vector<std::vector<T>> all;
    std::vector<std::uint64_t> sizes;
    std::vector<OutgoingBytes> from;
    std::vector<IncomingBytes> to;
    this->together(
      [&]()
      {
        const auto count = static_cast<std::size_t>(this->size());
        all.resize(count);
        sizes.resize(count, 0);
        from.resize(count, { own.data(), own.size() * sizeof(T) });
        to.resize(count);
      });
    sizes[static_cast<std::size_t>(this->rank())] = own.size();
    this->sum(sizes);
    this->together(
      [&]()
      {
        for (std::size_t i = 0; i < all.size(); ++i)
        {
          all[i].resize(static_cast<std::size_t>(sizes[i]));
          to[i] = { all[i].data(), all[i].size() * sizeof(T) };
        }
      });
    this->exchange(from, to);
    return all;
  }

  /// Sends and receives memory of known sizes.
  void exchange(
    const std::vector<OutgoingBytes>& outgoing, const std::vector<IncomingBytes>& incoming)
  {
    for (std::size_t i = 0; i < outgoing.size(); ++i)
    {
      if (i != static_cast<std::size_t>(this->rank()))
      {
        this->Counted.sent += outgoing[i].count;
        this->Counted.received += incoming[i].count;
      }
    }
    ++this->Counted.rounds;
    this->Link.exchange(outgoing, incoming);
  }

private:
  static constexpr std::uint64_t none = 0;
  static constexpr std::uint64_t aborted = 1;

  void exchangeSizes(const std::vector<std::uint64_t>& outgoing,
    std::vector<std::uint64_t>& incoming, std::vector<OutgoingBytes>& from,
    std::vector<IncomingBytes>& to)
  {
    for (std::size_t i = 0; i < outgoing.size(); ++i)
    {
      from[i] = { &outgoing[i], sizeof(std::uint64_t) };
      to[i] = { &incoming[i], sizeof(std::uint64_t) };
    }
    this->Link.exchange(from, to);
  }

  Communicator& Link;
  Traffic Counted;
};

} // namespace isopoint

#endif
