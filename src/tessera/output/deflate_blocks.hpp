#pragma once

#include <span>

#include "tessera/output/huffman_code.hpp"

namespace tessera {

/// Bytes that the blocks for `size` bytes take at most: a table of codes, or the heads of stored blocks.
constexpr std::size_t largest_block(std::size_t size) { return size + 5 * (size / 65535) + 640; }

/// Appends `bytes` to a deflate stream (RFC 1951, 3.2) in blocks that are not the last: as they are, when they are
/// noise or few, or else in Huffman codes, and as runs where one byte prevails. Longer patterns are not searched for.
void put_block(BitWriter& out, std::span<const unsigned char> bytes);

/// Appends an empty last block.
void put_last_block(BitWriter& out);

}  // namespace tessera
