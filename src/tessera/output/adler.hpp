#pragma once

#include <cstdint>
#include <span>

namespace tessera {

/// The checksum Adler-32 (RFC 1950, 9) of `bytes`, as zlib's adler32() gives it, but several times faster.
std::uint32_t adler_checksum(std::span<const unsigned char> bytes);

}  // namespace tessera
