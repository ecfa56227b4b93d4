#pragma once

#include <vector>

#include "tessera/geometry/solid.hpp"

namespace tessera {

/// The sides (sorted, each once) on whose flat faces X lies, to within `tolerance` [m].
std::vector<Index> sides_at(const Solid& solid, const Vec3& X, double tolerance);

/// Is X in the solid and at least `tolerance` [m] away from its boundary?
bool is_well_inside(const Solid& solid, const Vec3& X, double tolerance);

/// X moved onto the planes of `sides`. A coordinate that such a plane fixes is bitwise the plane's.
Vec3 moved_onto(const Solid& solid, const std::vector<Index>& sides, Vec3 X);

/// The part of `move` that is parallel to all planes of `sides`; zero where they leave no direction.
Vec3 along_sides(const Solid& solid, const std::vector<Index>& sides, Vec3 move);

}  // namespace tessera
