#pragma once

#include "tessera/geometry/particles.hpp"
#include "tessera/geometry/region.hpp"

namespace tessera {

/// Random points, none nearer to another than a distance that is as large as their number lets it be (about 0.85
/// spacings), nor nearer than kLeastDepth spacings to the surface: darts are thrown, and those too near to an earlier
/// one dropped; where too few find room the distance becomes smaller (M. McCool, E. Fiume, Hierarchical Poisson disk
/// sampling distributions, Graphics Interface 1992). Throws InputError when the region has no room at all.
std::vector<Vec3> scatter_discs(const RandomSpec& spec, const Origin& origin, const Region& region);

/// First places for relaxed points: random, but everywhere as dense as the size formula wants them, one in each of as
/// many equal parts of a space-filling curve through the region. In the order of that curve. Throws InputError when the
/// region has no room, or the formula is not positive somewhere.
std::vector<Vec3> scatter_by_size(const RelaxedSpec& spec, const Origin& origin, const Region& region);

}  // namespace tessera
