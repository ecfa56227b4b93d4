#pragma once

#include <cmath>

#include "support/small_bodies.hpp"

namespace tessera::benchmarks {

/// Particles along an edge of a cube with about `particles` of them.
inline int along_edge(std::int64_t particles) {
  return static_cast<int>(std::lround(std::cbrt(static_cast<double>(particles))));
}

/// A unit cube with about `particles` particles on a lattice with a jitter of 0.25, in the order in which memory holds
/// them.
inline std::vector<Vec3> cube_points(const Solid& cube, std::int64_t particles) {
  const int n = along_edge(particles);
  const PointSet set = test::lattice(cube, {n, n, n}, 0.25, 1, Placement::cell_centres);
  return permuted(set.points, hilbert_order(set.points));
}

}  // namespace tessera::benchmarks
