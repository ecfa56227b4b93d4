#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "tessera/tessellation/vtu_layout.hpp"

namespace tessera {

enum class VtuEncoding { raw, base64 };

/// Bytes as a .vtu file holds them, raw or in base64. Padding may end a part in the middle, as VTK writes it between
/// the header and the data of an array.
class VtuStream {
 public:
  VtuStream(const VtuLayout& layout, std::size_t line, VtuEncoding encoding, std::string_view text)
      : layout_(layout), line_(line), encoding_(encoding), text_(text) {}

  /// The next `count` bytes. Throws GeometryError, before anything is allocated, when there cannot be so many.
  std::string read(std::uint64_t count);
  /// No more than this many bytes can follow.
  std::uint64_t room() const;
  [[noreturn]] void fail(const std::string& message) const { layout_.fail(line_, message); }

 private:
  void decode_group();
  int next_digit();

  const VtuLayout& layout_;
  std::size_t line_;
  VtuEncoding encoding_;
  std::string_view text_;
  std::string decoded_;  // not yet handed out; at most two bytes between calls
};

}  // namespace tessera
