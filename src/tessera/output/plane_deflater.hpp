#pragma once

#include <zlib.h>

#include <cstddef>
#include <span>
#include <vector>

#include "tessera/output/chunked_array.hpp"

namespace tessera {

/// Compresses arrays of numbers as HDF5's filters shuffle and deflate do, into streams that every reader of these
/// filters understands, but several times faster than zlib's quickest level. Shuffled, the bytes of a number lie in
/// planes: the last ones of a mantissa are noise, which is stored as it is; signs, exponents and leading digits have a
/// skew distribution without longer patterns, for which run lengths and Huffman codes get nearly all there is.
class PlaneDeflater {
 public:
  /// Throws RunError when memory runs out.
  PlaneDeflater();
  ~PlaneDeflater();
  PlaneDeflater(const PlaneDeflater&) = delete;
  PlaneDeflater& operator=(const PlaneDeflater&) = delete;

  /// Makes `stream` that of floating-point numbers of `width` bytes each.
  void numbers(std::span<const std::byte> values, std::size_t width, Chunk& stream);
  /// Makes `stream` that of integers, in which patterns are searched for.
  void integers(std::span<const std::byte> values, std::size_t width, Chunk& stream);

 private:
  void shuffle(std::span<const std::byte> values, std::size_t width);

  z_stream zlib_{};  // for integers
  RawField<unsigned char> planes_;
};

}  // namespace tessera
