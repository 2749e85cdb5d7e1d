// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_ByteBuffer_h
#define isopoint_ByteBuffer_h

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <vector>

namespace isopoint
{

/// A message between ranks of one machine type: trivially copyable values one after the other.
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

/// Reads what append() wrote, in the same order.
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

private:
  const unsigned char* Next;
  const unsigned char* End;
};

} // namespace isopoint

#endif
