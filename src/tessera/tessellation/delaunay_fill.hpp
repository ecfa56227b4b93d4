#pragma once

#include <span>
#include <vector>

#include "tessera/geometry/solid.hpp"
#include "tessera/tessellation/mesh_faces.hpp"

namespace tessera {

/// The Delaunay tetrahedra of `points` whose centroids are in `solid`, without the flat ones (below 1e-12 of the mean
/// volume) that rounding leaves on its boundary. Throws GeometryError for a flat tetrahedron inside the solid that
/// is not positive in floating point.
std::vector<Tetrahedron> delaunay_fill(std::span<const Vec3> points, const Solid& solid,
                                       std::span<const double> weights);

}  // namespace tessera
