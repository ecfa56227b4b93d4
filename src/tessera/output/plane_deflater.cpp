#include "tessera/output/plane_deflater.hpp"

#include <cstdint>

#include "tessera/base/error.hpp"
#include "tessera/output/adler.hpp"
#include "tessera/output/deflate_blocks.hpp"

namespace tessera {

namespace {

constexpr int zlib_level = 1;                  // higher ones take several times longer and save little
constexpr std::uint64_t zlib_header = 0x0178;  // RFC 1950: window of 32 kB, quickest
constexpr std::size_t ends_of_stream = 32;     // header, last block, checksum and what BitWriter touches

[[noreturn]] void fail() { throw RunError("zlib could not compress a field: out of memory"); }

}  // namespace

PlaneDeflater::PlaneDeflater() {
  if (deflateInit(&zlib_, zlib_level) != Z_OK) fail();
}

PlaneDeflater::~PlaneDeflater() { deflateEnd(&zlib_); }

void PlaneDeflater::numbers(std::span<const unsigned char> planes, std::size_t width, Chunk& stream) {
  const std::size_t count = planes.size() / width;
  stream.resize(width * largest_block(count) + ends_of_stream);
  BitWriter out(stream.data());
  out.put(zlib_header, 16);
  for (std::size_t k = 0; k < width; ++k) put_block(out, planes.subspan(k * count, count));
  put_last_block(out);
  const std::uint32_t checksum = adler_checksum(planes);
  for (unsigned shift : {24U, 16U, 8U, 0U}) out.put(checksum >> shift & 255U, 8);
  stream.resize(static_cast<std::size_t>(out.end() - stream.data()));
}

void PlaneDeflater::integers(std::span<const unsigned char> planes, Chunk& stream) {
  if (deflateReset(&zlib_) != Z_OK) fail();
  stream.resize(deflateBound(&zlib_, planes.size()));
  zlib_.next_in = const_cast<unsigned char*>(planes.data());  // zlib only reads
  zlib_.avail_in = static_cast<uInt>(planes.size());
  zlib_.next_out = stream.data();
  zlib_.avail_out = static_cast<uInt>(stream.size());
  if (deflate(&zlib_, Z_FINISH) != Z_STREAM_END) fail();
  stream.resize(zlib_.total_out);
}

}  // namespace tessera
