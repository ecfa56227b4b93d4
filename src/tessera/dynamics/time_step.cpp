#include "tessera/dynamics/time_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tessera/base/stopwatch.hpp"

namespace tessera {

namespace {

// Evaluations of the forces that choosing the step may take: at the start a share of the steps that the run will have,
// later a share of the steps done. Together 0.9 in a hundred; with what surrounds them (vectors, small eigenvalue
// problems, looks at the deformation) it is two in a hundred in wall-clock time.
constexpr double starting_share = 0.007, running_share = 0.002;
// An estimate in the course of a run starts from the last vector and rarely takes more evaluations than this; it is
// not worth starting with fewer.
constexpr int evaluations_again = 10, most_evaluations = 32;
// One per cent in the frequency, far less than the safety leaves.
constexpr double tolerance = 0.02;
// Steps between two estimates.
constexpr std::int64_t first_interval = 500, shortest_interval = 50, longest_interval = 4000;
// Change of the limit between two estimates that calls for closer watch.
constexpr double watchful_change = 0.02;
// Stiffening since the last estimate (of moduli: twice that of frequencies) that calls for a new one.
constexpr double noticeable_growth = 1.05;
// Steps between two looks at the deformation, which cost about a seventh of an evaluation: fewer when the growth since
// the last look was more than this, more when it was less than half. A change of the smallest J, known at every step,
// does not wait for the next look.
constexpr std::int64_t shortest_watch = 30, longest_watch = 200;
constexpr double watchful_growth = 0.05, watchful_compression = 0.05;
// Shorter steps than this share of the present one are worth a change.
constexpr double worthwhile_step = 0.99;
// The step by bonds stays below this share of the spectral limit.
constexpr double largest_share_of_limit = 0.9;
// How much the last step may be longer than the others. The time of many steps adds up with round-off, and what that
// leaves of the run must not become a step of its own: accelerations of walls over such a step are noise.
constexpr double last_step_stretch = 1e-3;

const Material& material(const System& s, const MaterialRange& r) {
  return s.materials[static_cast<std::size_t>(r.material)];
}

/// Steps that divide the rest of the run evenly, so that it ends on time without a short last step.
double divide_evenly(double rest, double dt) { return rest / std::ceil(rest / dt * (1.0 - 1e-12)); }

/// Ratio of viscous to elastic plane-wave modulus, the largest over the particles [s].
double viscous_time(const System& s) {
  double tau = 0.0;
  if (!s.viscosity.empty())
    for (const MaterialRange& r : s.ranges)
      tau = std::max(tau, largest_of(r.end - r.begin, [&](std::int64_t i) {
                       return s.viscosity[static_cast<std::size_t>(r.begin + i)].linear /
                              material(s, r).plane_wave_modulus();
                     }));
  return tau;
}

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
  const double z = 0.5 * viscous_time(s) * omega;
  return 2.0 / omega * (std::sqrt(1.0 + z * z) - z);
}

double frequency_of_step(const System& s, double dt) {
  return 1.0 / std::sqrt(0.5 * dt * (0.5 * dt + viscous_time(s)));
}

StepControl::StepControl(const TimeSpec& spec, const System& system, const State& state, std::span<const Vec3> walls,
                         std::span<const double> mass)
    : spec_(spec), system_(system), mass_(mass), estimator_(system, mass) {
  const Stopwatch watch(seconds_);
  if (const auto* fixed = std::get_if<FixedStep>(&spec.step)) start_fixed(*fixed, state, walls);
  if (std::holds_alternative<AutoStep>(spec.step)) start_by_bonds(state, walls);
  if (std::holds_alternative<AutoSpectralStep>(spec.step)) start_spectral(state, walls);
}

/// A body of which nothing can move has no limit.
double StepControl::limit_of(double omega) const {
  return omega > 0.0 ? stable_step(system_, omega) : std::numeric_limits<double>::infinity();
}

double StepControl::estimate(const State& state, std::span<const Vec3> walls, const Effort& effort) {
  return estimator_.largest_frequency(state, walls, system_.shortest_length, effort);
}

void StepControl::start_fixed(const FixedStep& fixed, const State& state, std::span<const Vec3> walls) {
  memory_.dt = fixed.dt;
  Effort effort;
  effort.enough = frequency_of_step(system_, fixed.dt);
  memory_.limit = limit_of(estimate(state, walls, effort));
  if (fixed.dt > memory_.limit && !fixed.force)
    throw InputError(spec_.origin,
                     fmt::format("the step of {:g} s is above the spectral limit of {:g} s; take a smaller one, "
                                 "\"auto\" or \"auto-spectral\" (or force = true)",
                                 fixed.dt, memory_.limit));
}

void StepControl::start_by_bonds(const State& state, std::span<const Vec3> walls) {
  memory_.dt = spec_.safety * shortest_travel_time(system_);
  if (spec_.end == 0.0) return;
  // Slivers can make a body stiffer than its shortest bond says.
  Effort effort;
  effort.enough = frequency_of_step(system_, memory_.dt / largest_share_of_limit);
  memory_.limit = limit_of(estimate(state, walls, effort));
  memory_.dt = divide_evenly(spec_.end, std::min(memory_.dt, largest_share_of_limit * memory_.limit));
}

void StepControl::start_spectral(const State& state, std::span<const Vec3> walls) {
  if (spec_.end == 0.0) return;
  stiffening_.emplace(system_);
  memory_.estimate_interval = first_interval;
  memory_.watch_interval = shortest_watch;
  // A run has end omega / (2 safety) steps.
  const Effort effort{most_evaluations, tolerance, 0.0, 0.5 * starting_share * spec_.end / spec_.safety};
  memory_.limit = limit_of(estimate(state, walls, effort));
  memory_.dt = divide_evenly(spec_.end, automatic_step());
}

double StepControl::automatic_step() const {
  const double limit = memory_.limit / std::sqrt(std::max(memory_.growth, 1.0));
  return std::isfinite(limit) ? spec_.safety * limit : std::max(spec_.end, 1.0);
}

/// Evaluations that may have been made by this step.
int StepControl::allowance(std::int64_t step) const {
  const double steps = std::isfinite(memory_.limit) ? spec_.end / (spec_.safety * memory_.limit) : 0.0;
  return static_cast<int>(std::min(starting_share * steps + running_share * static_cast<double>(step), 1e9));
}

bool StepControl::estimate_due(std::int64_t step) const {
  const std::int64_t age = step - memory_.estimated_at;
  const bool wanted =
      age >= memory_.estimate_interval || (age >= shortest_interval && memory_.growth > noticeable_growth);
  return wanted && evaluations() + evaluations_again <= allowance(step);
}

void StepControl::estimate_again(std::int64_t step, const State& state, std::span<const Vec3> walls,
                                 const Forces& forces) {
  const auto left = static_cast<int>(allowance(step) - evaluations());
  const Effort effort{std::min(left, most_evaluations), tolerance, 0.0};
  const double limit = limit_of(estimate(state, walls, effort));
  const bool changed = std::abs(limit - memory_.limit) > watchful_change * memory_.limit;
  memory_.estimate_interval = std::clamp(changed ? memory_.estimate_interval / 2 : memory_.estimate_interval * 2,
                                         shortest_interval, longest_interval);
  memory_.limit = limit;
  memory_.estimated_at = step;
  memory_.growth = 1.0;
  stiffening_->remember(forces);
}

bool StepControl::watch_due(std::int64_t step, const Forces& forces) const {
  return step >= memory_.watched_at + memory_.watch_interval ||
         forces.sums().smallest_J < (1.0 - watchful_compression) * memory_.smallest_J;
}

void StepControl::watch(std::int64_t step, const Forces& forces) {
  const double before = memory_.growth;
  memory_.growth = stiffening_->growth(forces);
  memory_.smallest_J = forces.sums().smallest_J;
  const double change = std::abs(memory_.growth - before);
  if (change > watchful_growth) memory_.watch_interval = std::max(memory_.watch_interval / 2, shortest_watch);
  if (change < 0.5 * watchful_growth) memory_.watch_interval = std::min(memory_.watch_interval * 2, longest_watch);
  memory_.watched_at = step;
}

void StepControl::adapt(std::int64_t step, double time, const State& state, std::span<const Vec3> walls,
                        const Forces& forces) {
  if (!stiffening_) return;
  const Stopwatch stopwatch(seconds_);
  if (step == 0) stiffening_->remember(forces);  // the first estimate belongs to it
  if (step == 0 || watch_due(step, forces)) watch(step, forces);
  const double rest = spec_.end - time;
  if (estimate_due(step)) {
    estimate_again(step, state, walls, forces);
    memory_.dt = divide_evenly(rest, automatic_step());
  } else if (automatic_step() < worthwhile_step * memory_.dt) {
    memory_.dt = divide_evenly(rest, automatic_step());
  }
}

double StepControl::next(double time) const {
  const double rest = spec_.end - time;
  return rest < memory_.dt * (1.0 + last_step_stretch) ? rest : memory_.dt;
}

StepControl::Keepsake StepControl::keepsake() const {
  if (!stiffening_) return {memory_, estimator_.memory(), {}};
  return {memory_, estimator_.memory(), stiffening_->moduli(), stiffening_->smallest_J()};
}

void StepControl::restore(Keepsake keepsake) {
  memory_ = keepsake.memory;
  estimator_.restore(std::move(keepsake.estimator));
  if (stiffening_) stiffening_->restore(std::move(keepsake.moduli), keepsake.smallest_J);
}

}  // namespace tessera
