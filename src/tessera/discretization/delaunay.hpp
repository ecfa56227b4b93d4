#pragma once

#include <span>
#include <vector>

#include "tessera/discretization/discretization.hpp"
#include "tessera/tessellation/tetrahedra.hpp"

namespace tessera {

/// Delaunay formulation of [D]: V_a = sum_t vol_t / 4 and B_ab = sum_t vol_t / 4 grad N_b, which equals [D 27].
/// `constraints` are the particles with prescribed motion. Every boundary triangle gives three load sites, one a
/// vertex, so that a traction that varies linearly is shared exactly.
Discretization discretize_delaunay(const TetrahedralMesh& mesh, std::span<const ParticleConstraint> constraints);

}  // namespace tessera
