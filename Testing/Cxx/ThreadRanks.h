// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/ProcessGroup.h"

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

/// Ranks that are threads of one process, with all that they share.
class ThreadRanks
{
public:
  /// What the rank of the calling thread has exchanged, apart from reductions.
  struct Traffic
  {
    std::uint64_t sent; // bytes to other ranks
    std::uint64_t exchanges;
  };
  inline static thread_local Traffic traffic{};

  explicit ThreadRanks(int size)
    : Size(size)
    , Outgoing(static_cast<std::size_t>(size))
  {
    this->Reduced.reserve(std::size_t{ 1 } << 18); // so that no exchange lacks memory
  }

  /// Calls the function once for each rank, all at the same time, each with its communicator.
  void run(const std::function<void(isopoint::Communicator&)>& work)
  {
    std::vector<std::thread> threads;
    for (int rank = 0; rank < this->Size; ++rank)
    {
      threads.emplace_back(
        [this, rank, &work]()
        {
          Link link(*this, rank);
          work(link);
        });
    }
    for (std::thread& thread : threads)
    {
      thread.join();
    }
  }

private:
  class Link : public isopoint::Communicator
  {
  public:
    Link(ThreadRanks& ranks, int rank)
      : Ranks(ranks)
      , Rank(rank)
    {
    }

    int rank() const override { return this->Rank; }
    int size() const override { return this->Ranks.Size; }

    void allReduce(
      std::uint64_t* numbers, std::size_t count, isopoint::Reduction reduction) override
    {
      this->Ranks.await(
        [&]()
        {
          std::vector<std::uint64_t>& all = this->Ranks.Reduced;
          if (this->Ranks.Arrived == 0)
          {
            all.assign(numbers, numbers + count);
            return;
          }
          for (std::size_t i = 0; i < count; ++i)
          {
            all.at(i) = reduction == isopoint::Reduction::Sum ? all.at(i) + numbers[i]
                                                              : std::max(all.at(i), numbers[i]);
          }
        });
      std::copy_n(this->Ranks.Reduced.begin(), count, numbers);
      this->Ranks.await([]() {});
    }

    void exchange(const std::vector<isopoint::OutgoingBytes>& outgoing,
      const std::vector<isopoint::IncomingBytes>& incoming) override
    {
      this->Ranks.await(
        [&]() { this->Ranks.Outgoing[static_cast<std::size_t>(this->Rank)] = &outgoing; });
      ++traffic.exchanges;
      for (std::size_t from = 0; from < incoming.size(); ++from)
      {
        traffic.sent += from == static_cast<std::size_t>(this->Rank) ? 0 : outgoing[from].count;
        const isopoint::OutgoingBytes& message =
          this->Ranks.Outgoing[from]->at(static_cast<std::size_t>(this->Rank));
        if (message.count != incoming[from].count)
        {
          std::abort(); // the ranks disagree
        }
        if (message.count > 0)
        {
          std::memcpy(incoming[from].bytes, message.bytes, message.count);
        }
      }
      this->Ranks.await([]() {});
    }

  private:
    ThreadRanks& Ranks;
    const int Rank;
  };

  /// Does work under a lock, then waits until all ranks have done theirs. Allocates no memory.
  template <class Work>
  void await(const Work& work)
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    work();
    const std::size_t turn = this->Turn;
    if (++this->Arrived == this->Size)
    {
      this->Arrived = 0;
      ++this->Turn;
      this->Next.notify_all();
      return;
    }
    this->Next.wait(lock, [&]() { return turn != this->Turn; });
  }

  const int Size;
  std::mutex Mutex;
  std::condition_variable Next;
  int Arrived = 0;
  std::size_t Turn = 0;
  std::vector<std::uint64_t> Reduced;
  std::vector<const std::vector<isopoint::OutgoingBytes>*> Outgoing;
};
