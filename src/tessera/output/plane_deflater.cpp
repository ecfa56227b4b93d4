#include "tessera/output/plane_deflater.hpp"

#include <cstdint>
#include <cstring>

#include "tessera/base/error.hpp"
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
  if (deflateInit(&stream_, zlib_level) != Z_OK) fail();
}

PlaneDeflater::~PlaneDeflater() { deflateEnd(&stream_); }

std::string_view PlaneDeflater::numbers(std::span<const std::byte> values, std::size_t width) {
  shuffle(values, width);
  const std::size_t count = values.size() / width;
  out_.resize(width * largest_block(count) + ends_of_stream);
  BitWriter out(out_.data());
  out.put(zlib_header, 16);
  for (std::size_t k = 0; k < width; ++k) put_block(out, std::span(planes_).subspan(k * count, count));
  put_last_block(out);
  const auto checksum = adler32_z(adler32(0, nullptr, 0), planes_.data(), planes_.size());
  for (unsigned shift : {24U, 16U, 8U, 0U}) out.put(checksum >> shift & 255U, 8);
  return stream(static_cast<std::size_t>(out.end() - out_.data()));
}

std::string_view PlaneDeflater::integers(std::span<const std::byte> values, std::size_t width) {
  shuffle(values, width);
  if (deflateReset(&stream_) != Z_OK) fail();
  out_.resize(deflateBound(&stream_, planes_.size()));
  stream_.next_in = planes_.data();
  stream_.avail_in = static_cast<uInt>(planes_.size());
  stream_.next_out = out_.data();
  stream_.avail_out = static_cast<uInt>(out_.size());
  if (deflate(&stream_, Z_FINISH) != Z_STREAM_END) fail();
  return stream(stream_.total_out);
}

std::string_view PlaneDeflater::stream(std::size_t size) const {
  return {reinterpret_cast<const char*>(out_.data()), size};
}

void PlaneDeflater::shuffle(std::span<const std::byte> values, std::size_t width) {
  planes_.resize(values.size());
  const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
  const std::size_t count = values.size() / width;
  if (width == 8) return split<std::uint64_t>(bytes, planes_.data(), count);
  if (width == 4) return split<std::uint32_t>(bytes, planes_.data(), count);
  planes_.assign(bytes, bytes + values.size());  // single bytes
}

}  // namespace tessera
