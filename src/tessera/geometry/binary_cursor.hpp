#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

namespace tessera {

/// A place in the bytes of a binary file, and the numbers that follow it. Reading beyond the end throws GeometryError
/// with file and byte.
class BinaryCursor {
 public:
  BinaryCursor(const std::string& path, std::string_view bytes, std::size_t position, std::endian order)
      : path_(path), bytes_(bytes), position_(position), order_(order) {}

  template <class T>
  T read() {
    if (bytes_left() < sizeof(T)) fail("the file ends too early: it is truncated; write it again");
    char raw[sizeof(T)];
    std::memcpy(raw, bytes_.data() + position_, sizeof(T));
    if (order_ != std::endian::native) std::reverse(raw, raw + sizeof(T));
    T value;
    std::memcpy(&value, raw, sizeof(T));
    last_ = position_;
    position_ += sizeof(T);
    return value;
  }

  std::size_t bytes_left() const { return bytes_.size() - position_; }
  /// Of the next number, from one.
  std::int64_t place() const { return static_cast<std::int64_t>(position_) + 1; }
  /// Throws GeometryError at the number that was read last.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  const std::string& path_;
  std::string_view bytes_;
  std::size_t position_;
  std::size_t last_ = position_;
  std::endian order_;
};

}  // namespace tessera
