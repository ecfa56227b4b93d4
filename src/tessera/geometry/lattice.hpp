#pragma once

#include "tessera/geometry/particles.hpp"

namespace tessera {

/// Particles on the nodes of a cubic lattice that lie in the solid, moved at random when the specification has jitter.
/// Errors as for place_particles, but for distances between particles.
PointSet place_lattice(const LatticeSpec& spec, const Origin& origin, const Solid& solid, Placement placement);

}  // namespace tessera
