#pragma once

#include <span>
#include <vector>

#include "tessera/mechanics/state.hpp"
#include "tessera/mechanics/system.hpp"

namespace tessera {

/// Masses for slow loading: particles that would ask for a shorter step than wanted are made heavier.
struct MassScaling {
  std::vector<double> mass;  // what moves with each particle [kg]
  double added = 0.0;        // sum over the particles [kg]
  double added_share = 0.0;  // of the true mass
  Index particles = 0;       // that were made heavier
  Index most_affected = 0;
  double largest_factor = 1.0;   // by which that particle is heavier
  std::int64_t evaluations = 0;  // of the forces, that finding the masses took
};

/// The least masses, among those of one form, with which `step` is a stable one times `safety`:
///
///     m_a' = max(m_a, k_a rho / omega^2),   omega the frequency that belongs to step / safety,
///
/// k_a being the size of row a of the stiffness matrix and rho the largest eigenvalue of K x = rho k x.
/// Then K <= rho k <= omega^2 m', whatever the k_a, so no frequency is above omega. The masses stay diagonal, as an
/// explicit scheme needs them; so added mass also resists rigid motion. Only for forces with a potential.
MassScaling scale_mass(const System& system, const State& state, std::span<const Vec3> walls, double step,
                       double safety);

}  // namespace tessera
