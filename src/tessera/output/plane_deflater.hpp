#pragma once

#include <zlib.h>

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

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

  /// The stream of floating-point numbers of `width` bytes each; it stays until the next call.
  std::string_view numbers(std::span<const std::byte> values, std::size_t width);
  /// The stream of integers, in which patterns are searched for; it stays until the next call.
  std::string_view integers(std::span<const std::byte> values, std::size_t width);

 private:
  std::string_view stream(std::size_t size) const;
  void shuffle(std::span<const std::byte> values, std::size_t width);

  z_stream stream_{};  // for integers
  std::vector<unsigned char> planes_, out_;
};

}  // namespace tessera
