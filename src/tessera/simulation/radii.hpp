#pragma once

#include <vector>

#include "tessera/simulation/case.hpp"

namespace tessera {

/// Gives the points of a body the radii that a formula asks for. Throws InputError when a file has given them radii
/// too, a radius is negative, or the method cannot have power cells.
void set_radii(const MethodSpec& method, const ParticleSpec& spec, PointSet& points);

/// The weights of the points' power cells, the squares of their radii [m2], in the order given; none without radii.
std::vector<double> power_weights(const PointSet& points, const std::vector<Index>& order);

}  // namespace tessera
