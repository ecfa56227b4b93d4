#include "tessera/output/plane_deflater.hpp"

#include <cstdint>
#include <cstring>

#include "tessera/base/error.hpp"
#include "tessera/output/adler.hpp"
#include "tessera/output/deflate_blocks.hpp"

namespace tessera {

namespace {

constexpr int zlib_level = 1;                  // higher ones take several times longer and save little
constexpr std::uint64_t zlib_header = 0x0178;  // RFC 1950: window of 32 kB, quickest
constexpr std::size_t ends_of_stream = 32;     // header, last block, checksum and what BitWriter touches

/// Byte k of each value. Shifts of whole words are what the compiler can do for many at once.
template <class Word>
void split(const unsigned char* values, unsigned char* planes, std::size_t count) {
  for (std::size_t k = 0; k < sizeof(Word); ++k)
    for (std::size_t i = 0; i < count; ++i) {
      Word word;
      std::memcpy(&word, values + i * sizeof(Word), sizeof(Word));
      planes[k * count + i] = static_cast<unsigned char>(word >> 8 * k);
    }
}

[[noreturn]] void fail() { throw RunError("zlib could not compress a field: out of memory"); }

}  // namespace

PlaneDeflater::PlaneDeflater() {
  if (deflateInit(&zlib_, zlib_level) != Z_OK) fail();
}

PlaneDeflater::~PlaneDeflater() { deflateEnd(&zlib_); }

void PlaneDeflater::numbers(std::span<const std::byte> values, std::size_t width, Chunk& stream) {
  shuffle(values, width);
  const std::size_t count = values.size() / width;
  stream.resize(width * largest_block(count) + ends_of_stream);
  BitWriter out(stream.data());
  out.put(zlib_header, 16);
  for (std::size_t k = 0; k < width; ++k) put_block(out, std::span(planes_).subspan(k * count, count));
  put_last_block(out);
  const std::uint32_t checksum = adler_checksum(planes_);
  for (unsigned shift : {24U, 16U, 8U, 0U}) out.put(checksum >> shift & 255U, 8);
  stream.resize(static_cast<std::size_t>(out.end() - stream.data()));
}

void PlaneDeflater::integers(std::span<const std::byte> values, std::size_t width, Chunk& stream) {
  shuffle(values, width);
  if (deflateReset(&zlib_) != Z_OK) fail();
  stream.resize(deflateBound(&zlib_, planes_.size()));
  zlib_.next_in = planes_.data();
  zlib_.avail_in = static_cast<uInt>(planes_.size());
  zlib_.next_out = stream.data();
  zlib_.avail_out = static_cast<uInt>(stream.size());
  if (deflate(&zlib_, Z_FINISH) != Z_STREAM_END) fail();
  stream.resize(zlib_.total_out);
}

void PlaneDeflater::shuffle(std::span<const std::byte> values, std::size_t width) {
  planes_.resize(values.size());
  const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
  const std::size_t count = values.size() / width;
  if (width == 8) return split<std::uint64_t>(bytes, planes_.data(), count);
  if (width == 4) return split<std::uint32_t>(bytes, planes_.data(), count);
  std::memcpy(planes_.data(), bytes, values.size());  // single bytes
}

}  // namespace tessera
