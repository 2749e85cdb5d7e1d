// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointOptions_h
#define vtkIsopointOptions_h

#include "Core/Contour.h"
#include "Core/Options.h"

#include "vtkContourValues.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

/// The properties of a filter that makes surfaces, besides vtkIsopointSettings.
struct vtkIsopointOptions
{
  std::vector<double> GetValues() const
  {
    double* const values = this->ContourValues->GetValues();
    return { values, values + this->ContourValues->GetNumberOfContours() };
  }

  /// A text with all options, the same for equal ones.
  std::string Describe() const
  {
    std::ostringstream text;
    text << std::hexfloat << " " << this->Core.triangles << " " << this->ComputeScalars << " "
         << this->ContourBlocks;
    for (const double value : isopoint::sortedIsovalues(this->GetValues()))
    {
      text << " " << value + 0.0; // 0 and -0 are the same
    }
    isopoint::forEffectiveOptions(
      this->Core, [&](const auto& option) { text << " " << this->Core.*option.value + 0.0; });
    return text.str();
  }

  isopoint::Options Core;
  vtkContourValues* ContourValues = nullptr; // of the filter
  bool ComputeScalars = true;
  bool ContourBlocks = false;
};

/// Sets an option to a value, clamped to its range.
/// @returns whether it changed
template <class T, class TValue>
bool vtkSetIsopointOption(
  const isopoint::Option<T>& option, TValue value, vtkIsopointOptions& options)
{
  T& held = options.Core.*option.value;
  const T before = held;
  if constexpr (std::is_same_v<T, bool>)
  {
    held = value != 0;
  }
  else
  {
    held = std::clamp<T>(value, option.least, option.greatest);
  }
  return held != before;
}

/// Defines the getter of a core option, and a setter that clamps like vtkSetClampMacro().
#define vtkIsopointOptionMacro(filter, name, type, option)                                         \
  void filter::Set##name(type value)                                                               \
  {                                                                                                \
    if (vtkSetIsopointOption(option, value, *this->Options))                                       \
    {                                                                                              \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  type filter::Get##name()                                                                         \
  {                                                                                                \
    return this->Options->Core.*option.value;                                                      \
  }

/// The same for a property that is on or off.
/// @param held where it is, a bool
#define vtkIsopointSwitchMacro(filter, name, held)                                                 \
  void filter::Set##name(vtkTypeBool isOn)                                                         \
  {                                                                                                \
    if ((held) != (isOn != 0))                                                                     \
    {                                                                                              \
      (held) = isOn != 0;                                                                          \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  vtkTypeBool filter::Get##name()                                                                  \
  {                                                                                                \
    return held;                                                                                   \
  }

#endif
