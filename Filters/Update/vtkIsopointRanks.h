// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointRanks_h
#define vtkIsopointRanks_h

#include "Core/Base/Team.h"

#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstdint>
#include <vector>

class vtkMultiProcessController;

/**
 * The ranks of a controller of VTK, as the core sees them; without one, this rank alone. Messages
 * may have any size: they are sent in parts.
 */
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
  // Memory for sums and maxima, which must not be lacking on one rank alone.
  std::vector<unsigned long long> OwnNumbers;
  std::vector<unsigned long long> AllNumbers;
};

/**
 * Whether VTK's global controller has several processes.
 */
bool vtkHasOtherProcesses();

/**
 * The number of ranks that run on the same cores as this rank, itself included. Collective.
 */
std::size_t vtkCountIsopointRanksOnCores(isopoint::Team& team);

#endif
