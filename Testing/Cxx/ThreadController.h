// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "vtkCommunicator.h"
#include "vtkDummyController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

/// Messages between ranks that are threads of one process: each is handed over while its receiver
/// waits, so that none takes memory.
class ThreadMailbox
{
public:
  /// Hands bytes over, once the receiver is there, and waits for it to have copied them.
  void send(int from, int to, const void* bytes, std::size_t count)
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    Slot& slot = this->Slots[static_cast<std::size_t>(16 * from + to)];
    this->Changed.wait(lock, [&]() { return slot.bytes == nullptr; });
    slot.bytes = bytes;
    slot.count = count;
    this->Changed.notify_all();
    this->Changed.wait(lock, [&]() { return slot.bytes == nullptr; });
  }

  /// @returns the number of bytes received
  std::size_t receive(int from, int to, void* bytes, std::size_t most)
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    Slot& slot = this->Slots[static_cast<std::size_t>(16 * from + to)];
    this->Changed.wait(lock, [&]() { return slot.bytes != nullptr; });
    const std::size_t count = std::min(most, slot.count);
    std::memcpy(bytes, slot.bytes, count);
    slot.bytes = nullptr;
    this->Changed.notify_all();
    return count;
  }

private:
  struct Slot
  {
    const void* bytes = nullptr;
    std::size_t count = 0;
  };

  std::mutex Mutex;
  std::condition_variable Changed;
  std::vector<Slot> Slots = std::vector<Slot>(16 * 16);
};

/// One of up to 16 ranks that are threads.
class ThreadCommunicator : public vtkCommunicator
{
public:
  static ThreadCommunicator* New();
  vtkTypeMacro(ThreadCommunicator, vtkCommunicator);

  void connect(ThreadMailbox& mailbox, int rank, int size)
  {
    this->Mailbox = &mailbox;
    this->LocalProcessId = rank;
    this->MaximumNumberOfProcesses = size;
    this->NumberOfProcesses = size;
  }

  int SendVoidArray(
    const void* data, vtkIdType length, int type, int remoteHandle, int /*tag*/) override
  {
    this->Mailbox->send(this->LocalProcessId, remoteHandle, data, bytesOf(length, type));
    return 1;
  }

  int ReceiveVoidArray(
    void* data, vtkIdType maxlength, int type, int remoteHandle, int /*tag*/) override
  {
    const std::size_t count =
      this->Mailbox->receive(remoteHandle, this->LocalProcessId, data, bytesOf(maxlength, type));
    this->Count = static_cast<vtkIdType>(count / bytesOf(1, type));
    return 1;
  }

  /// Of unsigned 64-bit numbers, a few at a time; takes no memory.
  int AllReduceVoidArray(
    const void* sent, void* received, vtkIdType length, int /*type*/, int operation) override
  {
    constexpr vtkIdType few = 256;
    const auto* const own = static_cast<const std::uint64_t*>(sent);
    auto* const all = static_cast<std::uint64_t*>(received);
    for (vtkIdType begin = 0; begin < length; begin += few)
    {
      const vtkIdType count = std::min(few, length - begin);
      std::copy_n(own + begin, count, all + begin);
      this->reduceAtFirst(all + begin, count, operation == SUM_OP);
    }
    return 1;
  }

private:
  void reduceAtFirst(std::uint64_t* numbers, vtkIdType count, bool isSum)
  {
    const auto bytes = static_cast<std::size_t>(count) * sizeof(std::uint64_t);
    if (this->LocalProcessId > 0)
    {
      this->Mailbox->send(this->LocalProcessId, 0, numbers, bytes);
      this->Mailbox->receive(0, this->LocalProcessId, numbers, bytes);
      return;
    }
    for (int rank = 1; rank < this->NumberOfProcesses; ++rank)
    {
      std::uint64_t others[256];
      this->Mailbox->receive(rank, 0, others, bytes);
      for (vtkIdType i = 0; i < count; ++i)
      {
        numbers[i] = isSum ? numbers[i] + others[i] : std::max(numbers[i], others[i]);
      }
    }
    for (int rank = 1; rank < this->NumberOfProcesses; ++rank)
    {
      this->Mailbox->send(0, rank, numbers, bytes);
    }
  }

  static std::size_t bytesOf(vtkIdType length, int type)
  {
    const int size = vtkAbstractArray::GetDataTypeSize(type);
    return static_cast<std::size_t>(length) * static_cast<std::size_t>(size);
  }

  ThreadMailbox* Mailbox = nullptr;
};

vtkStandardNewMacro(ThreadCommunicator);

/// Calls work(controller) on each of some ranks, all at the same time.
inline void onThreadControllers(
  int size, const std::function<void(vtkMultiProcessController*)>& work)
{
  ThreadMailbox mailbox;
  std::vector<std::thread> threads;
  for (int rank = 0; rank < size; ++rank)
  {
    threads.emplace_back(
      [&mailbox, &work, rank, size]()
      {
        vtkNew<ThreadCommunicator> communicator;
        communicator->connect(mailbox, rank, size);
        vtkNew<vtkDummyController> controller;
        controller->SetCommunicator(communicator);
        work(controller);
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
}
