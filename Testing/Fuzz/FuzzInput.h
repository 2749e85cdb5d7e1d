// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FuzzInput_h
#define FuzzInput_h

#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkSmartPointer.h"

#include <vector>

class ByteSource;

/// A data set or blocks of them, with arrays that may be named "f", be missing, too short or no
/// numbers, and with ghosts.
/// @param dataSets receives the data sets, in the order of the blocks
vtkSmartPointer<vtkDataObject> newInput(
  ByteSource& bytes, std::vector<vtkSmartPointer<vtkDataSet>>& dataSets);

#endif
