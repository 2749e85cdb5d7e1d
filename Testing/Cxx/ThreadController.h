// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ThreadRanks.h"

#include "vtkCommunicator.h"
#include "vtkDummyController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

/// Messages between ranks that are threads of one process. Each is copied while its receiver waits,
/// so that none allocates memory.
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

  void connect(ThreadMailbox& mailbox, isopoint::Communicator& ranks)
  {
    this->Mailbox = &mailbox;
    this->Ranks = &ranks;
    this->LocalProcessId = ranks.rank();
    this->MaximumNumberOfProcesses = this->NumberOfProcesses = ranks.size();
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

  /// Of unsigned 64-bit numbers.
  int AllReduceVoidArray(
    const void* sent, void* received, vtkIdType length, int /*type*/, int operation) override
  {
    const auto count = static_cast<std::size_t>(length);
    auto* const numbers = static_cast<std::uint64_t*>(received);
    std::copy_n(static_cast<const std::uint64_t*>(sent), count, numbers);
    this->Ranks->allReduce(numbers, count,
      operation == SUM_OP ? isopoint::Reduction::Sum : isopoint::Reduction::Maximum);
    return 1;
  }

private:
  static std::size_t bytesOf(vtkIdType length, int type)
  {
    const int size = vtkAbstractArray::GetDataTypeSize(type);
    return static_cast<std::size_t>(length) * static_cast<std::size_t>(size);
  }

  ThreadMailbox* Mailbox = nullptr;
  isopoint::Communicator* Ranks = nullptr;
};

vtkStandardNewMacro(ThreadCommunicator);

/// Calls work(controller) on each of some ranks, all at the same time.
inline void onThreadControllers(
  int size, const std::function<void(vtkMultiProcessController*)>& work)
{
  ThreadMailbox mailbox;
  ThreadRanks(size).run(
    [&](isopoint::Communicator& ranks)
    {
      vtkNew<ThreadCommunicator> communicator;
      communicator->connect(mailbox, ranks);
      vtkNew<vtkDummyController> controller;
      controller->SetCommunicator(communicator);
      work(controller);
    });
}
