#pragma once

#include <vector>

#include "tessera/mechanics/kernel_types.hpp"
#include "tessera/mechanics/system.hpp"

namespace tessera {

/// What changes during a run. Velocities belong to the middle of the step before the positions' time.
struct State {
  Field<Double4> x;  // positions of particles, then of boundary nodes [m]
  Field<Double4> v;  // velocities of particles [m/s]
  /// The histories from which the present stresses follow: those of the step before, one a stress point, particle by
  /// particle. Empty when nothing can flow.
  Field<PlasticState> plastic;
};

/// Particles and nodes in their reference positions, at rest.
inline State reference_state(const System& s) {
  State state;
  state.x.reserve(s.d.X.size() + s.d.nodes.size());
  for (const Vec3& X : s.d.X) state.x.push_back(to_kernel(X));
  for (const BoundaryNode& f : s.d.nodes) state.x.push_back(to_kernel(f.X));
  state.v.assign(s.d.X.size(), Double4{});
  if (s.plastic()) state.plastic.resize(s.d.X.size() * static_cast<std::size_t>(s.stress_points));
  return state;
}

}  // namespace tessera
