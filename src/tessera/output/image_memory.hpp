#pragma once

#include <algorithm>
#include <cstddef>

#include "tessera/base/field.hpp"

namespace tessera {

/// Memory in which file images are put together, one after the other. It is kept from one to the next: what the system
/// takes to give fresh pages is more than what it takes to fill them.
class ImageMemory {
 public:
  ImageMemory() = default;
  ImageMemory(const ImageMemory&) = delete;
  ImageMemory& operator=(const ImageMemory&) = delete;

  /// Room for `size` bytes, the first of which stay as they are.
  std::byte* resized(std::size_t size) {
    if (size > bytes_.size()) bytes_.resize(std::max(size, bytes_.size() + bytes_.size() / 2));
    return bytes_.data();
  }

 private:
  RawField<std::byte> bytes_;
};

}  // namespace tessera
