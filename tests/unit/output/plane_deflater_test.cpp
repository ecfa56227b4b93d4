#include "tessera/output/plane_deflater.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <random>

#include "tessera/output/byte_planes.hpp"

namespace tessera {
namespace {

using Bytes = std::vector<unsigned char>;

/// What zlib makes of a stream; empty when zlib refuses it.
Bytes restored(const Chunk& stream, std::size_t size) {
  Bytes bytes(size + 1);
  uLongf length = bytes.size();
  if (uncompress(bytes.data(), &length, stream.data(), stream.size()) != Z_OK || length != size) return {};
  bytes.resize(size);
  return bytes;
}

/// Bytes from near certainty to noise, among them the Fibonacci-like counts that make the longest codes.
Bytes sample(std::mt19937_64& random, std::size_t size) {
  const double skewness = std::pow(2.0, -static_cast<double>(random() % 12));
  const auto choice = random() % 5;
  std::uniform_real_distribution<> uniform;
  Bytes bytes(size);
  for (unsigned char& b : bytes) {
    unsigned k = 0;
    switch (choice) {
      case 0:
        k = static_cast<unsigned>(random());
        break;
      case 1:
        k = uniform(random) < skewness ? static_cast<unsigned>(random()) : 7U;
        break;
      case 2:
        while (k < 24 && uniform(random) < 0.5) ++k;
        break;
      case 3:
        k = static_cast<unsigned>(uniform(random) / (skewness + 1e-3));
        break;
      default:
        k = 63;
    }
    b = static_cast<unsigned char>(k);
  }
  return bytes;
}

TEST(PlaneDeflater, ZlibReadsWhatItWrites) {
  PlaneDeflater deflater;
  Chunk stream;
  std::mt19937_64 random(7);
  for (int i = 0; i < 600; ++i) {
    const std::size_t width = std::size_t{1} << (i % 3 == 0 ? 0 : i % 3 + 1);
    const std::size_t count = 1 + random() % (i % 20 == 0 ? 70000 : 3000);
    const Bytes bytes = sample(random, count * width);
    PlaneDeflater::numbers(bytes, width, stream);
    ASSERT_EQ(restored(stream, bytes.size()), bytes) << "sample " << i;
    deflater.integers(bytes, stream);
    ASSERT_EQ(restored(stream, bytes.size()), bytes) << "sample " << i;
  }
}

std::size_t size_of(const std::function<double(std::size_t)>& value) {
  std::vector<double> values(8192);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = value(i);
  Bytes planes(values.size() * sizeof(double));
  write_planes(std::as_bytes(std::span(values)), ElementType::float64, planes.data(), values.size());
  Chunk stream;
  PlaneDeflater::numbers(planes, sizeof(double), stream);
  return stream.size();
}

TEST(PlaneDeflater, TakesNoMoreThanTheContentNeeds) {
  constexpr std::size_t whole = 8192 * sizeof(double);
  std::mt19937_64 random(7);
  EXPECT_LT(size_of([](std::size_t) { return 1.25; }), whole / 80);
  EXPECT_LT(size_of([](std::size_t i) { return i == 100 ? 0.3 : 0.0; }), whole / 80);
  // 52 random bits; one exponent out of few.
  EXPECT_LT(size_of([&](std::size_t) { return std::uniform_real_distribution<>(1.0, 2.0)(random); }), whole * 54 / 64);
  const auto noise = [&](std::size_t) {
    const std::uint64_t bits = random() & 0xbfffffffffffffffU;  // any finite number
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  };
  EXPECT_LT(size_of(noise), whole + 100);
}

}  // namespace
}  // namespace tessera
