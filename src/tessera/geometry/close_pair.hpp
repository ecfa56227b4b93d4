#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "tessera/base/index.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera {

/// The first pair (a < b, smallest b) of points closer to each other than `distance` [m] > 0, in linear time.
std::optional<std::pair<Index, Index>> find_close_pair(const std::vector<Vec3>& points, double distance);

}  // namespace tessera
