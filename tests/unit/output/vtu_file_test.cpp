#include "tessera/output/vtu_file.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>

namespace tessera {
namespace {

std::string decode_base64(const std::string& text) {
  static const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned buffer = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    buffer = buffer << 6 | static_cast<unsigned>(letters.find(c));
    bits += 6;
    if (bits >= 8) bytes += static_cast<char>(buffer >> (bits -= 8) & 0xff);
  }
  return bytes;
}

/// The way back, as VTK's documentation of the format tells it.
std::string decode_vtk(const std::string& text) {
  const auto number = [](const std::string& bytes, std::size_t i) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + 8 * i, 8);
    return value;
  };
  const std::size_t blocks = number(decode_base64(text.substr(0, 12)), 0);
  const std::size_t header_letters = (8 * (3 + blocks) + 2) / 3 * 4;
  const std::string header = decode_base64(text.substr(0, header_letters));
  const std::string data = decode_base64(text.substr(header_letters));
  std::string result;
  std::size_t position = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    const bool partial = b + 1 == blocks && number(header, 2) > 0;
    std::string block(partial ? number(header, 2) : number(header, 1), '\0');
    uLongf size = block.size();
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(block.data()), &size,
                         reinterpret_cast<const Bytef*>(data.data() + position), number(header, 3 + b)),
              Z_OK);
    position += number(header, 3 + b);
    result += block;
  }
  EXPECT_EQ(position, data.size());
  return result;
}

class EncodeVtk : public testing::TestWithParam<std::size_t> {};

TEST_P(EncodeVtk, DecodesToTheSameBytes) {
  std::string bytes(GetParam(), '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * i % 251);
  EXPECT_TRUE(decode_vtk(encode_vtk(bytes)) == bytes);
}

INSTANTIATE_TEST_SUITE_P(Sizes, EncodeVtk,
                         testing::Values(0, 1, 2, 3, 4, 1000, (1 << 20) - 1, 1 << 20, (1 << 20) + 1, 5000001));

}  // namespace
}  // namespace tessera
