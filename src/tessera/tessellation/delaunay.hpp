#pragma once

#include <span>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/tessellation/mesh_faces.hpp"

namespace tessera {

/// The Delaunay tetrahedra of `points`: they fill the convex hull and are positively oriented (exactly; the volume
/// in floating point may be zero). The same points give the same tetrahedra, also where more than four lie on
/// a sphere. Points that coincide with an earlier one get none. Throws GeometryError without CGAL and for fewer than
/// four points or points in one plane.
std::vector<Tetrahedron> delaunay_tetrahedra(std::span<const Vec3> points);

}  // namespace tessera
