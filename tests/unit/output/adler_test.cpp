#include "tessera/output/adler.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>
#include <vector>

namespace tessera {
namespace {

void expect_zlibs(const std::vector<unsigned char>& bytes) {
  EXPECT_EQ(adler_checksum(bytes), adler32_z(adler32(0, nullptr, 0), bytes.data(), bytes.size())) << bytes.size();
}

TEST(Adler, IsZlibs) {
  std::mt19937 random(3);
  for (const std::size_t size : {0, 1, 31, 32, 33, 8191, 8192, 8193, 70000}) {
    std::vector<unsigned char> bytes(size);
    for (unsigned char& byte : bytes) byte = static_cast<unsigned char>(random());
    expect_zlibs(bytes);
  }
}

TEST(Adler, HoldsTheLargestSums) { expect_zlibs(std::vector<unsigned char>(1000000, 255)); }

}  // namespace
}  // namespace tessera
