// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace isopoint
{

/// A message of concatenated, trivially copyable values between ranks of one machine type.
using ByteBuffer = std::vector<unsigned char>;

template <class T>
void append(ByteBuffer& buffer, const T* values, std::size_t count)
{
  static_assert(std::is_trivially_copyable<T>::value, "values are sent by their bytes");
  const auto* const bytes = reinterpret_cast<const unsigned char*>(values);
  buffer.insert(buffer.end(), bytes, bytes + count * sizeof(T));
}

template <class T>
void append(ByteBuffer& buffer, const T& value)
{
  append(buffer, &value, 1);
}

inline void appendText(ByteBuffer& buffer, const std::string& text)
{
  append(buffer, text.size());
  append(buffer, text.data(), text.size());
}

/// Reads the values of append() and appendText() in the same order.
class ByteReader
{
public:
  explicit ByteReader(const ByteBuffer& buffer)
    : Next(buffer.data())
    , End(buffer.data() + buffer.size())
  {
  }

  bool isAtEnd() const { return this->Next == this->End; }

  template <class T>
  void read(T* values, std::size_t count)
  {
    static_assert(std::is_trivially_copyable<T>::value, "values are sent by their bytes");
    if (count > 0)
    {
      std::memcpy(values, this->Next, count * sizeof(T));
      this->Next += count * sizeof(T);
    }
  }

  template <class T>
  T read()
  {
    T value;
    this->read(&value, 1);
    return value;
  }

  std::string readText()
  {
    std::string text(this->read<std::size_t>(), ' ');
    this->read(text.data(), text.size());
    return text;
  }

private:
  const unsigned char* Next;
  const unsigned char* End;
};

} // namespace isopoint
