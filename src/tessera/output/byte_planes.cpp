#include "tessera/output/byte_planes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "tessera/base/kernel.hpp"

namespace tessera {

namespace {

struct Planes {
  unsigned char* first;
  std::size_t size;
};

template <class T>
using WordOf =
    std::conditional_t<sizeof(T) == 8, std::uint64_t, std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint8_t>>;

constexpr std::size_t strip = 64;  // numbers that are converted and split together

/// Both loops are over whole words, which the compiler does for many at once.
template <class T>
void write_strip(const std::byte* doubles, std::size_t count, Planes planes) {
  std::array<WordOf<T>, strip> words;
  for (std::size_t i = 0; i < count; ++i) {
    double value = 0.0;
    std::memcpy(&value, doubles + i * sizeof value, sizeof value);
    words[i] = std::bit_cast<WordOf<T>>(static_cast<T>(value));
  }
  for (std::size_t k = 0; k < sizeof(T); ++k)
    for (std::size_t i = 0; i < count; ++i)
      planes.first[k * planes.size + i] = static_cast<unsigned char>(words[i] >> 8 * k);
}

template <class T>
void write(std::span<const std::byte> doubles, Planes planes) {
  const std::size_t count = doubles.size() / sizeof(double);
  std::size_t i = 0;
  for (; i + strip <= count; i += strip)
    write_strip<T>(doubles.data() + i * sizeof(double), strip, {planes.first + i, planes.size});
  write_strip<T>(doubles.data() + i * sizeof(double), count - i, {planes.first + i, planes.size});
}

TESSERA_KERNEL void write_float32(std::span<const std::byte> doubles, Planes planes) { write<float>(doubles, planes); }
TESSERA_KERNEL void write_float64(std::span<const std::byte> doubles, Planes planes) { write<double>(doubles, planes); }

}  // namespace

void write_planes(std::span<const std::byte> doubles, ElementType type, unsigned char* planes, std::size_t plane_size) {
  const Planes to = {planes, plane_size};
  switch (type) {
    case ElementType::float32:
      return write_float32(doubles, to);
    case ElementType::float64:
      return write_float64(doubles, to);
    case ElementType::int32:
      return write<std::int32_t>(doubles, to);
    case ElementType::int64:
      return write<std::int64_t>(doubles, to);
    case ElementType::uint8:
      return write<std::uint8_t>(doubles, to);
  }
}

}  // namespace tessera
