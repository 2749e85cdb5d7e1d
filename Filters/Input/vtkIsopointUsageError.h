// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointUsageError_h
#define vtkIsopointUsageError_h

#include <stdexcept>

/**
 * Invalid input or options. what() is the message for the user: a sentence that names the cause and
 * one that names the remedy.
 */
struct vtkIsopointUsageError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/**
 * There is nothing to contour, which on one of several ranks is no error unless it is so on all.
 */
struct vtkIsopointNothingError : vtkIsopointUsageError
{
  using vtkIsopointUsageError::vtkIsopointUsageError;
};

#endif
