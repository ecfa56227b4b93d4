#pragma once

#include "tessera/output/snapshot.hpp"

namespace tessera {

/// Current position of the material point X, moved as the neighbourhood of `particle` is: x_a + F_a (X - X_a) [m].
inline Vec3 moved_point(const Snapshot& snapshot, std::size_t particle, const Vec3& X) {
  return snapshot.position[particle] +
         snapshot.deformation_gradient[particle] * (X - snapshot.reference_position[particle]);
}

}  // namespace tessera
