#include "tessera/output/byte_planes.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

namespace tessera {
namespace {

/// The numbers that planes of bytes stand for.
template <class T>
std::vector<T> joined(const std::vector<unsigned char>& planes, std::size_t count) {
  std::vector<T> values(count);
  std::vector<unsigned char> bytes(count * sizeof(T));
  for (std::size_t k = 0; k < sizeof(T); ++k)
    for (std::size_t i = 0; i < count; ++i) bytes[i * sizeof(T) + k] = planes[k * count + i];
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

/// In two pieces, as chunks are filled.
template <class T>
void expect_same_numbers(const std::vector<double>& values, ElementType type) {
  const std::size_t count = values.size(), half = count / 3;
  std::vector<unsigned char> planes(count * sizeof(T));
  const std::span<const double> all = values;
  write_planes(std::as_bytes(all.first(half)), type, planes.data(), count);
  write_planes(std::as_bytes(all.subspan(half)), type, planes.data() + half, count);
  EXPECT_EQ(joined<T>(planes, count), std::vector<T>(values.begin(), values.end()));
}

TEST(BytePlanes, HoldTheNumbersByteByByte) {
  std::mt19937 random(3);
  for (const std::size_t count : {0, 1, 3, 63, 64, 65, 1000}) {
    std::vector<double> numbers(count), integers(count), small(count);
    for (double& x : numbers) x = std::normal_distribution<>(0.0, 1e6)(random);
    for (double& x : integers) x = static_cast<double>(random() % 4000000000U) - 2e9;
    for (double& x : small) x = static_cast<double>(random() % 256);
    expect_same_numbers<double>(numbers, ElementType::float64);
    expect_same_numbers<float>(numbers, ElementType::float32);
    expect_same_numbers<std::int32_t>(integers, ElementType::int32);
    expect_same_numbers<std::int64_t>(integers, ElementType::int64);
    expect_same_numbers<std::uint8_t>(small, ElementType::uint8);
  }
}

}  // namespace
}  // namespace tessera
