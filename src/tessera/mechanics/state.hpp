#pragma once

#include <vector>

#include "tessera/mechanics/kernel_types.hpp"
#include "tessera/mechanics/system.hpp"

namespace tessera {

/// What changes during a run. Velocities belong to the middle of the step before the positions' time.
struct State {
  Field<Double4> x;  // positions of particles, then of boundary nodes [m]
  Field<Double4> v;  // velocities of particles [m/s]
};

/// Particles and nodes in their reference positions, at rest.
inline State reference_state(const System& s) {
  State state;
  state.x.reserve(s.d.X.size() + s.d.nodes.size());
  for (const Vec3& X : s.d.X) state.x.push_back(to_kernel(X));
  for (const BoundaryNode& f : s.d.nodes) state.x.push_back(to_kernel(f.X));
  state.v.assign(s.d.X.size(), Double4{});
  return state;
}

}  // namespace tessera
