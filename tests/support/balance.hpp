#pragma once

#include <algorithm>
#include <vector>

#include "support/small_bodies.hpp"

namespace tessera::test {

/// Patch tests: displacement gradient of [V 52], its linear motion, and the stress that belongs to it.
inline const Mat3 patch_gradient{{1e-4, 2e-4, 3e-4, 4e-4, 5e-4, 6e-4, 7e-4, 8e-4, 9e-4}};

inline Vec3 linear(const Vec3& X) { return X + patch_gradient * X; }

inline Mat3 patch_stress() { return std::get<NeoHookean>(rubber().law).stress(identity() + patch_gradient); }

/// Largest length among force vectors [N].
inline double largest(std::span<const Double4> forces) {
  double size = 0.0;
  for (const Double4& f : forces) size = std::max(size, norm(to_vec3(f)));
  return size;
}

inline double largest(std::span<const Vec3> forces) {
  double size = 0.0;
  for (const Vec3& f : forces) size = std::max(size, norm(f));
  return size;
}

/// The nodal forces of the tractions P N on all sites.
inline std::vector<NodalForce> loads_of_stress(const System& s, const Mat3& P) {
  std::vector<NodalForce> loads;
  for (std::size_t i = 0; i < s.d.sites.size(); ++i)
    for (const LoadShare& share : s.d.load.row(static_cast<Index>(i)))
      loads.push_back({share.particle, share.area * (P * s.d.sites[i].N)});
  return loads;
}

inline double largest(std::span<const NodalForce> loads) {
  double size = 0.0;
  for (const NodalForce& l : loads) size = std::max(size, norm(l.force));
  return size;
}

/// Sums over all particles; `size` is that of the lengths of the forces.
struct Resultant {
  Vec3 force, torque;
  double size = 0.0;
};

inline Resultant resultant(const State& state, const Forces& forces) {
  Resultant sum;
  for (std::size_t a = 0; a < state.v.size(); ++a) {
    const Vec3 f = to_vec3(forces.total()[a]);
    sum.force += f;
    sum.torque += cross(to_vec3(state.x[a]), f);
    sum.size += norm(f);
  }
  return sum;
}

}  // namespace tessera::test
