#pragma once

#include "tessera/geometry/particles.hpp"
#include "tessera/geometry/region.hpp"

namespace tessera {

/// Particles on the sites of a lattice with several of them in a unit cell (bcc, fcc, hcp), as far as they are at least
/// kLeastDepth spacings away from the surface. Whole unit cells fill the bounding box, so they are stretched a little;
/// hcp lies with its close-packed planes across z. The spec has counts or a spacing. Throws InputError when that leaves
/// no particle.
std::vector<Vec3> place_crystal(const LatticeSpec& spec, const Origin& origin, const Region& region);

}  // namespace tessera
