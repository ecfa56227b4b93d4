#pragma once

#include <optional>

#include "tessera/dynamics/spectral.hpp"
#include "tessera/dynamics/stiffening.hpp"
#include "tessera/dynamics/time_spec.hpp"

namespace tessera {

/// min(L_ab / c_p) over all bonds, ghosts included [s].
double shortest_travel_time(const System& system);

/// The largest step for which the leapfrog with lagged viscosity is stable, 2/omega (sqrt(1 + z^2) - z) with z = c1 h
/// omega / (2 c_p), the largest over the particles [s].
double stable_step(const System& system, double omega);

/// Its inverse: the frequency [1/s] that makes `dt` the largest stable step.
double frequency_of_step(const System& system, double dt);

/// Chooses the step of a run and, for auto-spectral, chooses it again as the body deforms. What that may cost is
/// counted in evaluations of the forces and stays below two in a hundred steps.
class StepControl {
 public:
  /// `mass` is what moves with each particle [kg]. Throws InputError when a fixed step is above the spectral limit and
  /// not forced.
  StepControl(const TimeSpec& spec, const System& system, const State& state, std::span<const Vec3> walls,
              std::span<const double> mass);
  StepControl(const TimeSpec& spec, const System& system, const State& state, std::span<const Vec3> walls)
      : StepControl(spec, system, state, walls, system.mass) {}

  /// For auto-spectral: looks at the deformation that `forces` found at the state, and shortens the step where the body
  /// has become stiffer; estimates the limit again when that is due.
  void adapt(std::int64_t step, double time, const State& state, std::span<const Vec3> walls, const Forces& forces);

  /// The step to take from `time` on [s]; never beyond the end.
  double next(double time) const;

  /// A lower bound of the spectral limit [s], only as sharp as the step needs it; zero when nothing is to be
  /// integrated.
  double limit() const { return memory_.limit; }
  /// What choosing the steps has cost so far: evaluations of the forces and wall-clock time [s].
  std::int64_t evaluations() const { return estimator_.memory().evaluations; }
  double seconds() const { return seconds_; }

  /// What a resumed run must put back.
  struct Memory {
    double dt = 0.0, limit = 0.0;           // limit: of the last estimate [s]
    double growth = 1.0, smallest_J = 1.0;  // when the deformation was last looked at
    std::int64_t estimated_at = 0, estimate_interval = 0, watched_at = 0, watch_interval = 0;  // steps
  };
  struct Keepsake {
    Memory memory;
    SpectralEstimator::Memory estimator;
    std::vector<double> moduli;
    double smallest_J = 1.0;  // at the last estimate
  };
  Keepsake keepsake() const;
  void restore(Keepsake keepsake);
  const Memory& memory() const { return memory_; }

 private:
  void start_by_bonds(const State& state, std::span<const Vec3> walls);
  void start_fixed(const FixedStep& fixed, const State& state, std::span<const Vec3> walls);
  void start_spectral(const State& state, std::span<const Vec3> walls);

  double limit_of(double omega) const;
  double estimate(const State& state, std::span<const Vec3> walls, const Effort& effort);
  int allowance(std::int64_t step) const;
  bool estimate_due(std::int64_t step) const;
  void estimate_again(std::int64_t step, const State& state, std::span<const Vec3> walls, const Forces& forces);
  bool watch_due(std::int64_t step, const Forces& forces) const;
  void watch(std::int64_t step, const Forces& forces);
  double automatic_step() const;

  TimeSpec spec_;
  const System& system_;
  std::span<const double> mass_;
  SpectralEstimator estimator_;
  std::optional<Stiffening> stiffening_;  // auto-spectral only
  double seconds_ = 0.0;
  Memory memory_;
};

}  // namespace tessera
