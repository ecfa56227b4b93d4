#include "tessera/dynamics/time_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera {

namespace {

// Steps between two spectral estimates: an estimate costs some thirty evaluations of the forces.
constexpr std::int64_t first_interval = 500, shortest_interval = 50, longest_interval = 4000;
// The automatic step stays below this share of the spectral limit.
constexpr double largest_share_of_limit = 0.9;
// Change of the limit between two estimates that calls for closer watch.
constexpr double watchful_change = 0.02;
// How much the last step may be longer than the others. The time of many steps adds up with round-off, and what that
// leaves of the run must not become a step of its own: accelerations of walls over such a step are noise.
constexpr double last_step_stretch = 1e-3;

const Material& material(const System& s, const MaterialRange& r) {
  return s.materials[static_cast<std::size_t>(r.material)];
}

/// Steps that divide the rest of the run evenly, so that it ends on time without a short last step.
double divide_evenly(double rest, double dt) { return rest / std::ceil(rest / dt * (1.0 - 1e-12)); }

}  // namespace

double shortest_travel_time(const System& s) {
  double shortest = std::numeric_limits<double>::infinity(), fastest = 0.0;
  for (const MaterialRange& r : s.ranges) {
    fastest = std::max(fastest, material(s, r).wave_speed());
    shortest = std::min(shortest, r.shortest_bond / material(s, r).wave_speed());
  }
  return std::min(shortest, s.shortest_length / fastest);
}

double stable_step(const System& s, double omega) {
  double tau = 0.0;  // ratio of viscous to elastic plane-wave modulus
  if (!s.viscosity.empty())
    for (const MaterialRange& r : s.ranges)
      for (Index a = r.begin; a < r.end; ++a)
        tau = std::max(tau, s.viscosity[static_cast<std::size_t>(a)].linear / material(s, r).plane_wave_modulus());
  const double z = 0.5 * tau * omega;
  return 2.0 / omega * (std::sqrt(1.0 + z * z) - z);
}

StepControl::StepControl(const TimeSpec& spec, const System& system, const State& state, std::span<const Vec3> walls)
    : spec_(spec), system_(system), estimator_(system) {
  memory_.interval = first_interval;
  const bool by_bonds = std::holds_alternative<AutoStep>(spec.step);
  if (by_bonds) memory_.dt = spec.safety * shortest_travel_time(system);
  if (by_bonds && spec.end == 0.0) return;
  estimate(0, state, walls);
  // Slivers can make a body stiffer than its shortest bond says.
  if (by_bonds && memory_.dt > largest_share_of_limit * limit_) memory_.dt = largest_share_of_limit * limit_;
  if (std::holds_alternative<AutoSpectralStep>(spec.step)) memory_.dt = spectral_step();
  if (const auto* fixed = std::get_if<FixedStep>(&spec.step)) {
    if (fixed->dt > limit_ && !fixed->force)
      throw InputError(spec.origin,
                       fmt::format("the step of {:g} s is above the spectral limit of {:g} s; take a smaller one, "
                                   "\"auto\" or \"auto-spectral\" (or force = true)",
                                   fixed->dt, limit_));
    memory_.dt = fixed->dt;
  } else if (spec.end > 0.0) {
    memory_.dt = divide_evenly(spec.end, memory_.dt);
  }
}

void StepControl::estimate(std::int64_t step, const State& state, std::span<const Vec3> walls) {
  const double omega = estimator_.largest_frequency(state, walls, system_.shortest_length);
  const double limit = omega > 0.0 ? stable_step(system_, omega) : std::numeric_limits<double>::infinity();
  if (limit_ > 0.0) {
    const bool changed = std::abs(limit - limit_) > watchful_change * limit_;
    memory_.interval =
        std::clamp(changed ? memory_.interval / 2 : memory_.interval * 2, shortest_interval, longest_interval);
  }
  limit_ = memory_.limit = limit;
  memory_.estimated_at = step;
}

/// A body of which nothing can move has no limit.
double StepControl::spectral_step() const {
  return std::isfinite(limit_) ? spec_.safety * limit_ : std::max(spec_.end, 1.0);
}

double StepControl::next(std::int64_t step, double time, const State& state, std::span<const Vec3> walls) {
  if (std::holds_alternative<AutoSpectralStep>(spec_.step) && step >= memory_.estimated_at + memory_.interval) {
    estimate(step, state, walls);
    memory_.dt = divide_evenly(spec_.end - time, spectral_step());
  }
  const double rest = spec_.end - time;
  return rest < memory_.dt * (1.0 + last_step_stretch) ? rest : memory_.dt;
}

void StepControl::restore(const Memory& memory, Field<Double4> start_vector) {
  memory_ = memory;
  limit_ = memory.limit;
  estimator_.vector() = std::move(start_vector);
}

}  // namespace tessera
