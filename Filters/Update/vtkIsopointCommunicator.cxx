// SPDX-License-Identifier: GPL-3.0-or-later
#include "Update/vtkIsopointCommunicator.h"

#include "Core/Base/Threads.h"

#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"
#include "vtkType.h"

#include <vtksys/SystemInformation.hxx>

#include <algorithm>
#include <cstring>
#include <functional>
#include <string>

namespace
{

constexpr int tag = 72671; // of messages between the ranks of one filter

constexpr std::size_t reducedAtOnce = std::size_t{ 1 } << 13;

} // namespace

vtkIsopointCommunicator::vtkIsopointCommunicator()
  : OwnNumbers(reducedAtOnce)
  , AllNumbers(reducedAtOnce)
{
}

vtkIsopointCommunicator::~vtkIsopointCommunicator() = default;

void vtkIsopointCommunicator::SetController(vtkMultiProcessController* controller)
{
  this->Controller = controller;
}

vtkMultiProcessController* vtkIsopointCommunicator::GetController() const
{
  return this->Controller;
}

int vtkIsopointCommunicator::rank() const
{
  return this->Controller ? this->Controller->GetLocalProcessId() : 0;
}

int vtkIsopointCommunicator::size() const
{
  return this->Controller ? this->Controller->GetNumberOfProcesses() : 1;
}

void vtkIsopointCommunicator::allReduce(
  std::uint64_t* numbers, std::size_t count, isopoint::Reduction reduction)
{
  if (this->size() == 1)
  {
    return;
  }
  const int operation =
    reduction == isopoint::Reduction::Sum ? vtkCommunicator::SUM_OP : vtkCommunicator::MAX_OP;
  for (std::size_t done = 0; done < count; done += reducedAtOnce)
  {
    const std::size_t length = std::min(reducedAtOnce, count - done);
    std::copy_n(numbers + done, length, this->OwnNumbers.begin());
    this->Controller->AllReduce(
      this->OwnNumbers.data(), this->AllNumbers.data(), static_cast<vtkIdType>(length), operation);
    std::copy_n(this->AllNumbers.begin(), length, numbers + done);
  }
}

void vtkIsopointCommunicator::exchange(const std::vector<isopoint::OutgoingBytes>& outgoing,
  const std::vector<isopoint::IncomingBytes>& incoming)
{
  const int own = this->rank();
  const int count = this->size();
  const auto at = [](int rank) { return static_cast<std::size_t>(rank); };
  if (outgoing[at(own)].count > 0)
  {
    std::memcpy(incoming[at(own)].bytes, outgoing[at(own)].bytes, outgoing[at(own)].count);
  }
  // In each turn the ranks form pairs, in which the lower one sends first.
  for (int turn = 0; turn < count; ++turn)
  {
    const int other = (turn - own + count) % count;
    if (own < other)
    {
      this->Send(outgoing[at(other)], other);
    }
    if (own != other)
    {
      this->Receive(incoming[at(other)], other);
    }
    if (own > other)
    {
      this->Send(outgoing[at(other)], other);
    }
  }
}

namespace
{

/// MPI counts bytes in an int.
constexpr std::size_t largestPart = std::size_t{ 1 } << 30;

template <class Action>
void forParts(std::size_t count, const Action& action)
{
  for (std::size_t done = 0; done < count; done += largestPart)
  {
    action(done, static_cast<vtkIdType>(std::min(largestPart, count - done)));
  }
}

} // namespace

void vtkIsopointCommunicator::Send(const isopoint::OutgoingBytes& message, int rank)
{
  const char* const bytes = static_cast<const char*>(message.bytes);
  forParts(message.count, [&](std::size_t begin, vtkIdType length)
    { this->Controller->Send(bytes + begin, length, rank, tag); });
}

void vtkIsopointCommunicator::Receive(const isopoint::IncomingBytes& message, int rank)
{
  char* const bytes = static_cast<char*>(message.bytes);
  forParts(message.count, [&](std::size_t begin, vtkIdType length)
    { this->Controller->Receive(bytes + begin, length, rank, tag); });
}

std::size_t vtkCountIsopointRanksOnCores(isopoint::ProcessGroup& processes)
{
  if (processes.size() == 1)
  {
    return 1;
  }
  vtksys::SystemInformation system;
  system.RunOSCheck();
  const char* const name = system.GetHostname();
  const std::uint64_t own = std::hash<std::string>()((name ? name : "") + isopoint::boundCores());
  const std::vector<std::uint64_t> all = processes.gather(own);
  return static_cast<std::size_t>(std::count(all.begin(), all.end(), own));
}
