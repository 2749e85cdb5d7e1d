// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkScatteredIsopointFilterInternals_h
#define vtkScatteredIsopointFilterInternals_h

#include "Isopoint/Base/Team.h"
#include "Isopoint/IsosurfaceExtractor.h"
#include "vtkIsopointBlocks.h"
#include "vtkIsopointFindings.h"
#include "vtkIsopointInputState.h"
#include "vtkIsopointRanks.h"
#include "vtkScatteredIsopointFilter.h"

#include "vtkAlgorithm.h"
#include "vtkMultiProcessController.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>

/// The tree of one cloud, and the state of the input it was loaded from.
class vtkScatteredIsopointFilter::KeptTree
{
public:
  isopoint::IsosurfaceExtractor Extractor;
  vtkIsopointInputState LoadedFrom;
};

/// What is kept from one update to the next.
class vtkScatteredIsopointFilter::Internals
{
public:
  vtkSmartPointer<vtkMultiProcessController> Controller;
  std::unique_ptr<vtkIsopointCommunicator> Link; // to other ranks, if there are any
  std::unique_ptr<isopoint::Team> Team;          // of them
  int GhostLevels = 0;                           // that are requested of the output
  vtkIsopointBlocks Input;
  vtkIsopointFindings Findings;            // of the current update
  std::set<std::string> Reported;          // causes of messages in the last update
  vtkWeakPointer<vtkAlgorithm> ReportedOf; // the producer of its input
  std::map<std::size_t, KeptTree> Trees;   // by leaf if blocks are contoured separately, else one

  void Clear()
  {
    this->Trees.clear();
    this->Input = vtkIsopointBlocks();
  }
};

#endif
