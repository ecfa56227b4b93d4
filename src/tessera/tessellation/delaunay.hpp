#pragma once

#include <span>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/tessellation/mesh_faces.hpp"

namespace tessera {

/// The Delaunay tetrahedra of `points`: they fill the convex hull and are positively oriented (exactly; in floating
/// point the volume of one on the hull may be zero). The points' distances are taken in a metric that differs by 1e-6
/// from the Euclidean one: so points on one circle or sphere, as regular lattices have them in any position, leave no
/// flat tetrahedra inside, and an axis-parallel lattice is split exactly as split_lattice does it. `weights` [m2], one
/// for each point, makes the cells of heavier points larger, as in power diagrams; a lighter point too close to them
/// gets no tetrahedron, like one that coincides with another. Throws GeometryError without CGAL and for fewer than four
/// points or points in one plane.
std::vector<Tetrahedron> delaunay_tetrahedra(std::span<const Vec3> points, std::span<const double> weights);

}  // namespace tessera
