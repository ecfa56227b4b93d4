#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tessera/base/field.hpp"

namespace tessera {

enum class ElementType { float32, float64, int32, int64, uint8 };

constexpr std::size_t width_of(ElementType type) {
  switch (type) {
    case ElementType::float32:
    case ElementType::int32:
      return 4;
    case ElementType::float64:
    case ElementType::int64:
      return 8;
    case ElementType::uint8:
      break;
  }
  return 1;
}

/// A compressed piece of an array. It has room for the largest one, so that the next frame finds its memory there.
using Chunk = RawField<unsigned char>;

/// A table that is already shuffled and compressed, in pieces of `chunk_rows` rows (the last one filled up).
struct ChunkedArray {
  ElementType type = ElementType::float64;
  std::size_t rows = 0, chunk_rows = 0;
  std::size_t columns = 1;
  std::vector<Chunk> chunks;

  std::size_t row_bytes() const { return columns * width_of(type); }
  std::size_t chunk_bytes() const { return chunk_rows * row_bytes(); }
  std::size_t plane_bytes() const { return chunk_rows * columns; }  // one byte of each number of a chunk
};

}  // namespace tessera
