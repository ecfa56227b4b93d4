#pragma once

#include "tessera/dynamics/spectral.hpp"
#include "tessera/dynamics/time_spec.hpp"

namespace tessera {

/// min(L_ab / c_p) over all bonds, ghosts included [s].
double shortest_travel_time(const System& system);

/// The largest step for which the leapfrog with lagged viscosity is stable, 2/omega (sqrt(1 + z^2) - z) with z = c1 h
/// omega / (2 c_p), the largest over the particles [s].
double stable_step(const System& system, double omega);

/// Chooses the step of a run and, for auto-spectral, chooses it again as the body deforms.
class StepControl {
 public:
  /// Throws InputError when a fixed step is above the spectral limit and not forced.
  StepControl(const TimeSpec& spec, const System& system, const State& state, std::span<const Vec3> walls);

  /// The step to take from `time` on [s]; never beyond the end.
  double next(std::int64_t step, double time, const State& state, std::span<const Vec3> walls);

  /// The spectral limit of the last estimate [s]; zero when nothing is to be integrated.
  double limit() const { return limit_; }

  /// What a resumed run must put back.
  struct Memory {
    double dt = 0.0, limit = 0.0;
    std::int64_t estimated_at = 0, interval = 0;
  };
  const Memory& memory() const { return memory_; }
  const Field<Double4>& start_vector() const { return estimator_.vector(); }
  void restore(const Memory& memory, Field<Double4> start_vector);

 private:
  double spectral_step() const;
  void estimate(std::int64_t step, const State& state, std::span<const Vec3> walls);

  TimeSpec spec_;
  const System& system_;
  SpectralEstimator estimator_;
  double limit_ = 0.0;
  Memory memory_;
};

}  // namespace tessera
