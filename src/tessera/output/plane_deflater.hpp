#pragma once

#include <zlib.h>

#include <cstddef>
#include <span>

#include "tessera/output/chunked_array.hpp"

namespace tessera {

/// Compresses the planes of bytes that make up numbers (byte_planes.hpp) as HDF5's filter deflate does, into streams
/// that every reader understands, but several times faster than zlib's quickest level. The last bytes of a mantissa are
/// noise, which is stored as it is; signs, exponents and leading digits have a skew distribution without longer
/// patterns, for which run lengths and Huffman codes get nearly all there is.
class PlaneDeflater {
 public:
  /// Throws RunError when memory runs out.
  PlaneDeflater();
  ~PlaneDeflater();
  PlaneDeflater(const PlaneDeflater&) = delete;
  PlaneDeflater& operator=(const PlaneDeflater&) = delete;

  /// Makes `stream` that of floating-point numbers, which fill `width` planes.
  static void numbers(std::span<const unsigned char> planes, std::size_t width, Chunk& stream);
  /// Makes `stream` that of integers, in which patterns are searched for.
  void integers(std::span<const unsigned char> planes, Chunk& stream);

 private:
  z_stream zlib_{};  // for integers
};

}  // namespace tessera
