#pragma once

#include <cstdint>
#include <vector>

#include "tessera/tessellation/vtu_layout.hpp"

namespace tessera {

/// All numbers of a floating-point array. Throws GeometryError with the array's line when they cannot be read.
std::vector<double> vtu_doubles(const VtuLayout& layout, const VtuArray& array);

/// All numbers of an integer array of any width.
std::vector<std::int64_t> vtu_integers(const VtuLayout& layout, const VtuArray& array);

}  // namespace tessera
