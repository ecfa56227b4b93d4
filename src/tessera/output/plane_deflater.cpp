#include "tessera/output/plane_deflater.hpp"

#include <array>
#include <cmath>
#include <cstdint>

#include "tessera/base/error.hpp"

namespace tessera {

namespace {

constexpr int stored = 0, quickest = 1;  // zlib's levels; higher ones take several times longer and save little
constexpr int window_bits = 15, memory_level = 9;
constexpr std::size_t sample_stride = 8;
constexpr double noise = 7.5;  // bits a byte above which coding would save less than a sixteenth

/// Of the bytes' distribution, from every eighth byte [bits].
double entropy(std::span<const std::byte> bytes) {
  std::array<std::uint32_t, 256> counts{};
  for (std::size_t i = 0; i < bytes.size(); i += sample_stride) ++counts[static_cast<std::size_t>(bytes[i])];
  const double all = static_cast<double>((bytes.size() + sample_stride - 1) / sample_stride);
  double sum = 0.0;
  for (const std::uint32_t count : counts)
    if (count > 0) sum -= count / all * std::log2(count / all);
  return sum;
}

template <std::size_t width>
void split(const std::byte* values, std::byte* planes, std::size_t count) {
  // Few planes' lines at a time stay in the first cache.
  for (std::size_t k = 0; k < width; ++k)
    for (std::size_t i = 0; i < count; ++i) planes[k * count + i] = values[i * width + k];
}

[[noreturn]] void fail() { throw RunError("zlib could not compress a field: out of memory"); }

}  // namespace

PlaneDeflater::PlaneDeflater() {
  if (deflateInit2(&stream_, quickest, Z_DEFLATED, window_bits, memory_level, Z_RLE) != Z_OK) fail();
}

PlaneDeflater::~PlaneDeflater() { deflateEnd(&stream_); }

std::string PlaneDeflater::numbers(std::span<const std::byte> values, std::size_t width) {
  shuffle(values, width);
  begin(values.size());
  const std::size_t count = values.size() / width;
  for (std::size_t k = 0; k < width; ++k) {
    const std::span<std::byte> plane = std::span(planes_).subspan(k * count, count);
    if (entropy(plane) > noise)
      set(stored, Z_DEFAULT_STRATEGY);
    else
      set(quickest, Z_RLE);
    feed(plane, k + 1 < width ? Z_BLOCK : Z_FINISH);
  }
  return end();
}

std::string PlaneDeflater::integers(std::span<const std::byte> values, std::size_t width) {
  shuffle(values, width);
  begin(values.size());
  set(quickest, Z_DEFAULT_STRATEGY);
  feed(planes_, Z_FINISH);
  return end();
}

void PlaneDeflater::shuffle(std::span<const std::byte> values, std::size_t width) {
  planes_.resize(values.size());
  const std::size_t count = values.size() / width;
  if (width == 8) return split<8>(values.data(), planes_.data(), count);
  if (width == 4) return split<4>(values.data(), planes_.data(), count);
  planes_.assign(values.begin(), values.end());  // single bytes
}

void PlaneDeflater::begin(std::size_t size) {
  if (deflateReset(&stream_) != Z_OK) fail();
  constexpr std::size_t headers_of_planes = 4096;  // more than blocks of eight planes need beside their content
  out_.resize(deflateBound(&stream_, size) + headers_of_planes);
  stream_.next_out = reinterpret_cast<Bytef*>(out_.data());
  stream_.avail_out = static_cast<uInt>(out_.size());
  stream_.avail_in = 0;
}

void PlaneDeflater::set(int level, int strategy) {
  if (deflateParams(&stream_, level, strategy) != Z_OK) fail();
}

void PlaneDeflater::feed(std::span<std::byte> bytes, int flush) {
  stream_.next_in = reinterpret_cast<Bytef*>(bytes.data());
  stream_.avail_in = static_cast<uInt>(bytes.size());
  const int status = deflate(&stream_, flush);
  const bool complete = flush == Z_FINISH ? status == Z_STREAM_END : status == Z_OK && stream_.avail_in == 0;
  if (!complete) fail();
}

std::string PlaneDeflater::end() { return {out_.data(), out_.size() - stream_.avail_out}; }

}  // namespace tessera
