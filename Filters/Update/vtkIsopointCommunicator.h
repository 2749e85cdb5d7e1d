// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointCommunicator_h
#define vtkIsopointCommunicator_h

#include "Core/Base/ProcessGroup.h"

#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstdint>
#include <vector>

class vtkMultiProcessController;

/// Connects the core to a VTK controller, or to this rank alone. Splits large messages into parts.
class vtkIsopointCommunicator : public isopoint::Communicator
{
public:
  vtkIsopointCommunicator();
  ~vtkIsopointCommunicator() override;

  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() const;

  int rank() const override;
  int size() const override;
  void allReduce(std::uint64_t* numbers, std::size_t count, isopoint::Reduction reduction) override;
  void exchange(const std::vector<isopoint::OutgoingBytes>& outgoing,
    const std::vector<isopoint::IncomingBytes>& incoming) override;

private:
  void Send(const isopoint::OutgoingBytes& message, int rank);
  void Receive(const isopoint::IncomingBytes& message, int rank);

  vtkSmartPointer<vtkMultiProcessController> Controller;
  // Preallocated for sums and maxima, so that no single rank can run out of memory there.
  std::vector<unsigned long long> OwnNumbers;
  std::vector<unsigned long long> AllNumbers;
};

/// The number of ranks that share cores with this rank, including itself. Collective.
std::size_t vtkCountIsopointRanksOnCores(isopoint::ProcessGroup& processes);

#endif
