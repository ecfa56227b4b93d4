#pragma once

#include <vector>

#include "tessera/geometry/particles.hpp"
#include "tessera/geometry/solid.hpp"
#include "tessera/tessellation/mesh_faces.hpp"

namespace tessera {

/// Splits every lattice cell whose eight nodes hold particles and whose centre is in `solid` into six tetrahedra around
/// the diagonal from its lowest to its highest node (Kuhn, Freudenthal). All cells are split alike, so neighbours
/// match:
///
///        +------+         each of the six goes from 000 to 111 along three edges,
///       /|     /|         one for every order of the directions x, y, z
///      +------+ |
///      | +----|-+
///      |/     |/
///      +------+
///
/// Throws GeometryError that names cell, particles and position when jitter inverts a tetrahedron.
std::vector<Tetrahedron> split_lattice(const PointSet& points, const Solid& solid);

}  // namespace tessera
