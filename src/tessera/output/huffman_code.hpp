#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace tessera {

/// Bits in the order of deflate (RFC 1951, 3.1.1): the first one is the lowest of the first byte. Writes to memory that
/// its owner makes large enough: it touches seven bytes beyond end().
class BitWriter {
 public:
  explicit BitWriter(unsigned char* begin) : end_(begin) {}

  /// Appends the `count` lowest bits of `bits`; at most 56, the others zero.
  void put(std::uint64_t bits, unsigned count) {
    buffer_ |= bits << used_;
    used_ += count;
    std::memcpy(end_, &buffer_, sizeof buffer_);
    end_ += used_ / 8;
    buffer_ >>= used_ / 8 * 8;
    used_ %= 8;
  }
  /// Fills the last byte with zeros.
  void align() { put(0, (8 - used_) % 8); }
  /// Appends whole bytes to whole bytes.
  void copy(std::span<const unsigned char> bytes) {
    std::memcpy(end_, bytes.data(), bytes.size());
    end_ += bytes.size();
  }
  const unsigned char* end() const { return end_; }

 private:
  unsigned char* end_;
  std::uint64_t buffer_ = 0;
  unsigned used_ = 0;  // bits of the buffer, fewer than 8 between calls
};
static_assert(std::endian::native == std::endian::little, "the lowest byte is stored first");

/// A prefix code: for each symbol its bits, the first one lowest, and how many (0: the symbol does not occur).
struct HuffmanCode {
  std::vector<std::uint16_t> bits;
  std::vector<std::uint8_t> lengths;

  void put(BitWriter& out, std::size_t symbol) const { out.put(bits[symbol], lengths[symbol]); }
};

/// The canonical code of deflate (RFC 1951, 3.2.2) for symbols that occur `counts` times, none longer than `longest`
/// bits. At least two symbols occur, of at most 512, each less than 2^23 times.
HuffmanCode huffman_code(std::span<const std::uint32_t> counts, int longest);

}  // namespace tessera
