#pragma once

#include <span>
#include <vector>

#include "tessera/geometry/solid.hpp"
#include "tessera/tessellation/mesh_faces.hpp"
#include "tessera/tessellation/tetrahedra.hpp"

namespace tessera {

/// The faces that only one tetrahedron uses, counter-clockwise seen from outside, sorted. The tetrahedra are in the
/// order of put_in_order().
std::vector<Triangle> outer_faces(std::span<const Tetrahedron> tetrahedra);

/// The side of `solid` on which `triangle` lies: its plane holds the three vertices to within `tolerance` [m] and has
/// the same outward direction; where several sides share the plane, the one whose wall holds the centroid. -1 where
/// there is none.
Index side_of(const Triangle& triangle, std::span<const Vec3> points, const Solid& solid, double tolerance);

}  // namespace tessera
