#pragma once

#include <optional>
#include <variant>

#include "tessera/base/error.hpp"

namespace tessera {

/// dt = safety min(L) / c_p over all bonds, but not above nine tenths of the spectral limit at the start.
struct AutoStep {};

/// dt = safety 2 / omega_max, omega_max from the linearised forces, estimated again as the body deforms.
struct AutoSpectralStep {};

/// A step given by the user [s]; refused above the spectral limit unless `force`.
struct FixedStep {
  double dt = 0.0;
  bool force = false;
};

/// Makes particles heavier that would ask for a shorter step.
struct MassScalingSpec {
  double step = 0.0;  // that is wanted [s]
  Origin origin;
};

/// The [time] table.
struct TimeSpec {
  double end = 0.0;  // [s]; 0 evaluates the forces of the initial state once
  std::variant<AutoStep, AutoSpectralStep, FixedStep> step;
  double safety = 0.3;
  double damping = 0.0;                         // mass-proportional [1/s]
  std::optional<MassScalingSpec> mass_scaling;  // auto-spectral only
  Origin origin;                                // of the step key (or of the table)
};

}  // namespace tessera
