#pragma once

#include "tessera/mechanics/system.hpp"

namespace tessera {

/// Bytes that a step moves per particle, counted from the arrays that the sweeps stream: every array once per sweep,
/// written lines also read; values of neighbours count once, as a particle's own (they come from cache).
double bytes_per_particle_step(const System& system);

/// Bytes per particle of everything that stays in memory during a run.
double bytes_per_particle(const System& system);

}  // namespace tessera
