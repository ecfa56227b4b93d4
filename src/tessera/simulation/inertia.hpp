#pragma once

#include <optional>
#include <span>

#include "tessera/dynamics/mass_scaling.hpp"
#include "tessera/dynamics/time_spec.hpp"
#include "tessera/simulation/model.hpp"

namespace tessera {

/// The masses that time.mass_scaling asks for, nothing without it. Throws InputError for bodies that move from the
/// start, whose motion heavier particles would falsify, and for forces without a potential.
std::optional<MassScaling> scaled_mass(const Model& model, const TimeSpec& spec, const State& state);

/// What moves with each particle [kg].
inline std::span<const double> inertia(const Model& model, const std::optional<MassScaling>& scaling) {
  return scaling ? std::span<const double>(scaling->mass) : std::span<const double>(model.system.mass);
}

/// Particles in their initial positions, with their initial velocities.
State initial_state(const Model& model);

}  // namespace tessera
