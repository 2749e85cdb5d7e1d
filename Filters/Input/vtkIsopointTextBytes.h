// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointTextBytes_h
#define vtkIsopointTextBytes_h

#include "Core/Ranks/ByteBuffer.h"

#include <cstddef>
#include <string>

/**
 * Texts among the values of a message between ranks.
 */
inline void vtkAppendText(isopoint::ByteBuffer& buffer, const std::string& text)
{
  isopoint::append(buffer, text.size());
  isopoint::append(buffer, text.data(), text.size());
}

inline std::string vtkReadText(isopoint::ByteReader& reader)
{
  std::string text(reader.read<std::size_t>(), ' ');
  reader.read(text.data(), text.size());
  return text;
}

#endif
