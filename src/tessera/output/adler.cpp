#include "tessera/output/adler.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace tessera {

namespace {

constexpr std::uint32_t modulus = 65521;
constexpr std::size_t columns = 32;
constexpr std::size_t most_rows = 256;  // 16 bits hold their sum of bytes

/// The two sums of the checksum: of the bytes, and of those sums after each byte.
struct Sums {
  std::uint32_t plain = 1, repeated = 0;

  /// Goes on with `n` bytes of which `sum` and `weighted` are the plain and the repeated sum.
  void append(std::uint64_t n, std::uint64_t sum, std::uint64_t weighted) {
    repeated = static_cast<std::uint32_t>((repeated + n * plain + weighted) % modulus);
    plain = static_cast<std::uint32_t>((plain + sum) % modulus);
  }
};

/// Appends `rows` rows of `columns` bytes. Columns are summed side by side: a byte of row r and column j counts
/// columns (rows - r) - j times in the repeated sum.
void append_rows(Sums& sums, const unsigned char* bytes, std::size_t rows) {
  std::array<std::uint16_t, columns> plain{};
  std::array<std::uint32_t, columns> repeated{};
  for (std::size_t r = 0; r < rows; ++r, bytes += columns) {
    for (std::size_t j = 0; j < columns; ++j) plain[j] = static_cast<std::uint16_t>(plain[j] + bytes[j]);
    for (std::size_t j = 0; j < columns; ++j) repeated[j] += plain[j];
  }
  std::uint64_t sum = 0, weighted = 0;
  for (std::size_t j = 0; j < columns; ++j) {
    sum += plain[j];
    weighted += columns * std::uint64_t{repeated[j]} - j * std::uint64_t{plain[j]};
  }
  sums.append(rows * columns, sum, weighted);
}

}  // namespace

std::uint32_t adler_checksum(std::span<const unsigned char> bytes) {
  Sums sums;
  while (bytes.size() >= columns) {
    const std::size_t rows = std::min(bytes.size() / columns, most_rows);
    append_rows(sums, bytes.data(), rows);
    bytes = bytes.subspan(rows * columns);
  }
  for (const unsigned char byte : bytes) sums.append(1, byte, byte);
  return sums.repeated << 16U | sums.plain;
}

}  // namespace tessera
