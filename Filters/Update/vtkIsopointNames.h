// SPDX-License-Identifier: GPL-3.0-or-later
// Lists of names that are properties of filters.
#ifndef vtkIsopointNames_h
#define vtkIsopointNames_h

#include "vtkIndent.h"

#include <algorithm>
#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

using vtkIsopointNames = std::vector<std::string>;

/// Adds a name that is not listed yet. Null adds none.
/// @returns whether the list changed
inline bool vtkAddIsopointName(vtkIsopointNames& names, const char* name)
{
  const bool isNew = name && std::find(names.begin(), names.end(), name) == names.end();
  if (isNew)
  {
    names.emplace_back(name);
  }
  return isNew;
}

/// @returns whether the list changed
inline bool vtkClearIsopointNames(vtkIsopointNames& names)
{
  const bool hadAny = !names.empty();
  names.clear();
  return hadAny;
}

/// Null if there is no name of this index.
inline const char* vtkGetIsopointName(const vtkIsopointNames& names, int i)
{
  const bool exists = i >= 0 && i < static_cast<int>(names.size());
  return exists ? names[static_cast<std::size_t>(i)].c_str() : nullptr;
}

inline void vtkPrintIsopointNames(
  std::ostream& os, vtkIndent indent, const char* property, const vtkIsopointNames& names)
{
  os << indent << property << ":";
  for (const std::string& name : names)
  {
    os << " " << name;
  }
  os << "\n";
}

#endif
