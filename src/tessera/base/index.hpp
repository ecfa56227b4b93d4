#pragma once

#include <cstdint>

namespace tessera {

/// Number of a particle, boundary node, cell, face or vertex.
using Index = std::int32_t;

/// Position in an array of bonds or face lists, which may hold more than 2^31 entries.
using Offset = std::int64_t;

}  // namespace tessera
