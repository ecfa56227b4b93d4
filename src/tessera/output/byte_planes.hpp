#pragma once

#include <cstddef>
#include <span>

#include "tessera/output/chunked_array.hpp"

namespace tessera {

/// Converts numbers, given as the bytes of doubles, to `type` and tells their bytes apart, as HDF5's filter shuffle
/// does: byte k of number i goes to planes[k * plane_size + i].
void write_planes(std::span<const std::byte> doubles, ElementType type, unsigned char* planes, std::size_t plane_size);

}  // namespace tessera
