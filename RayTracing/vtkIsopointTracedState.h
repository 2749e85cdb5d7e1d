// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointTracedState_h
#define vtkIsopointTracedState_h

#include <ios>
#include <sstream>
#include <string>

/// A text that differs if any of its values differ.
class vtkIsopointTracedState
{
public:
  vtkIsopointTracedState() { this->Text << std::hexfloat; }

  template <class... Values>
  void Add(const Values&... values)
  {
    ((this->Text << values << ' '), ...);
  }

  std::string Get() const { return this->Text.str(); }

private:
  std::ostringstream Text;
};

#endif
