#pragma once

#include <span>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/geometry/solid.hpp"

namespace tessera {

/// Weights [m2] that protect a solid's boundary: `strength` times the square of the mean spacing for every plane of the
/// boundary on which a point lies, so most on corners, then edges, then sides, and none inside. With them the faces
/// of tetrahedra follow sides and re-entrant edges to which other points come close.
std::vector<double> boundary_weights(std::span<const Vec3> points, const Solid& solid, double strength);

}  // namespace tessera
