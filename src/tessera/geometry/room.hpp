#pragma once

#include "tessera/geometry/particles.hpp"

namespace tessera {

/// Throws InputError when so many particles as `spec` asks for, in a solid of this volume [m3] and extent [m], cannot
/// fit into the memory that is left: before any of it is taken.
void require_room(const ParticleSpec& spec, double volume, const Vec3& extent);

}  // namespace tessera
