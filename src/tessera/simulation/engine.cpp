#include "tessera/simulation/engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

// Energy that is missing or too much, relative to the largest energy seen, at which a run has lost its way.
constexpr double hopeless_energy_error = 0.5;
// Energies below this fraction of E V (a strain of 1e-7) are too close to round-off to judge.
constexpr double negligible_strain_energy = 1e-14;
// Steps before the ledger is judged. Where a load grows from nothing, the first steps' work, (k / n)^2 of it after n
// steps under a load t^k, is an error of the integrator as large as the energies themselves.
constexpr std::int64_t fewest_judged_steps = 10;

// The first part of a run, in which the kinetic energy need not be small beside the others: load and strain energy
// grow from nothing.
constexpr double starting_part = 0.1;

double kinetic_share(const EnergyLedger& e) {
  const double total = e.kinetic + e.internal + e.contact;
  return total > 0.0 ? e.kinetic / total : 0.0;
}

std::vector<Vec3> copy_of(std::span<const Vec3> v) { return {v.begin(), v.end()}; }

double elastic_scale(const System& s) {
  double scale = 0.0;
  for (const MaterialRange& r : s.ranges)
    for (Index a = r.begin; a < r.end; ++a)
      scale += s.materials[static_cast<std::size_t>(r.material)].young * s.d.volume[static_cast<std::size_t>(a)];
  return scale;
}

}  // namespace

Engine::Engine(Model& model, const TimeSpec& spec)
    : model_(model),
      spec_(spec),
      state_(initial_state(model)),
      mass_scaling_(scaled_mass(model, spec, state_)),
      forces_(model.system),
      leapfrog_(model.system, model.loads, spec.damping, inertia(model, mass_scaling_)),
      ledger_(model.system, model.loads),
      control_(spec, model.system, state_, model.loads.motion.positions(), inertia(model, mass_scaling_)),
      walls_(copy_of(model.loads.motion.positions())),
      negligible_energy_(negligible_strain_energy * elastic_scale(model.system)) {
  // Constrained particles start where they are told to be.
  const auto& constraints = model.system.d.constraints;
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    Double4& x = state_.x[static_cast<std::size_t>(constraints[i].particle)];
    x = to_kernel(constraints[i].D * (model.loads.motion.positions()[i] - to_vec3(x)) + to_vec3(x));
  }
  if (model.loads.gravity != Vec3{}) x0_.assign(state_.x.begin(), state_.x.begin() + model.system.particles());
  evaluate(0.0);
  verify_deformation();
  if (!std::isfinite(stored_energy()))
    throw RunError(
        "the energy of the initial state is not finite; are the numbers too large that [[initial]] and [[boundary]] "
        "give "
        "for t = 0?");
}

void Engine::evaluate(double dt) {
  model_.loads.tractions.evaluate(time_);
  walls_ = copy_of(model_.loads.motion.positions());
  Tractions& tractions = model_.loads.tractions;
  forces_.evaluate(state_, {walls_, tractions.forces(), model_.loads.gravity, &tractions}, dt);
}

void Engine::prepare() {
  const double before = dt_.after;
  if (!finished()) {
    control_.adapt(step_, time_, state_, walls_, forces_);
    dt_ = {before, control_.next(time_)};
    if (!started_) dt_.before = dt_.after;
    model_.loads.motion.move_to(time_ + dt_.after);
    if (!started_) leapfrog_.start(state_, forces_, dt_.after);
    started_ = true;
  } else if (spec_.end > 0.0) {
    dt_ = {before, before};  // the velocities at the end need what would come next
    model_.loads.motion.move_to(time_ + dt_.after);
  }
  leapfrog_.prepare(state_, forces_, dt_);
  ledger_.record(state_, forces_, leapfrog_, walls_, dt_, step_ > 0 ? before : 0.0);
  if (step_ > 0) return;
  const Motion start = motion();
  initial_energy_ = stored_energy() + start.kinetic;
  initial_momentum_ = to_momentum(start);
}

void Engine::advance() {
  forces_.commit(state_);
  leapfrog_.step(state_, forces_, dt_);
  ++step_;
  const double rest = spec_.end - time_;
  time_ = dt_.after >= rest ? spec_.end : time_ + dt_.after;
  evaluate(dt_.after);
  ledger_.add_dissipated(forces_.sums().dissipated);
}

Motion Engine::motion() const { return total_motion(state_, forces_, leapfrog_, dt_, 0, model_.system.particles()); }

double Engine::stored_energy() const { return forces_.sums().internal + forces_.sums().contact; }

Momentum Engine::momentum() const { return to_momentum(motion()); }

EnergyLedger Engine::energies() const {
  EnergyLedger e;
  e.kinetic = motion().kinetic;
  e.internal = forces_.sums().internal;
  e.contact = forces_.sums().contact;
  e.external_work = ledger_.external_work() + gravity_work(model_.system, state_, x0_, model_.loads.gravity);
  e.dissipated = ledger_.dissipated();
  e.initial = initial_energy_;
  e.scale = std::max(energy_scale_, e.kinetic + e.internal + e.contact + e.dissipated);
  e.largest_contact = std::max(largest_contact_, e.contact);
  e.largest_strain = std::max(largest_strain_, e.strain());
  e.negligible = negligible_energy_;
  return e;
}

const std::vector<Vec3>& Engine::reactions() const {
  return model_.system.d.constraints.empty() ? forces_.reactions() : leapfrog_.reactions();
}

Vec3 Engine::reaction_point(std::size_t i) const {
  const Discretization& d = model_.system.d;
  const auto at = [&](std::size_t node) { return to_vec3(state_.x[node]); };
  if (!d.constraints.empty()) return at(static_cast<std::size_t>(d.constraints[i].particle));
  const BoundaryNode& f = d.nodes[i];  // a ghost is as far behind the wall as its particle is before it
  const Vec3 owner = at(static_cast<std::size_t>(f.owner));
  return owner + (1.0 / f.wall_share) * (at(d.X.size() + i) - owner);
}

double Engine::largest_force() const {
  std::vector<Mat3> free(state_.v.size(), identity());
  for (const ParticleConstraint& c : model_.system.d.constraints)
    free[static_cast<std::size_t>(c.particle)] = identity() - c.D;
  double largest = 0.0;
  for (std::size_t a = 0; a < free.size(); ++a)
    largest = std::max(largest, norm(free[a] * to_vec3(forces_.total()[a])));
  return largest;
}

void Engine::fail(Index particle, const std::string& reason) const {
  const auto a = static_cast<std::size_t>(particle);
  const Vec3 x = to_vec3(state_.x[a]);
  const BodyModel& body = model_.bodies[static_cast<std::size_t>(model_.body_of[a])];
  const char* cure = step_ == 0
                         ? "the [[initial]] displacements and what [[boundary]] prescribes at t = 0 must go together"
                         : "a smaller step (time.safety), finer particles or slower loading may help";
  throw RunError(fmt::format("step {}, t = {:g} s: {} at particle {} of body \"{}\", now at ({:g}, {:g}, {:g}); {}",
                             step_, time_, reason, model_.user_number[a] - body.first, body.name, x.x, x.y, x.z, cure));
}

void Engine::verify_deformation() const {
  if (forces_.sums().finite && forces_.sums().smallest_J > 0.0) return;
  const std::vector<double> J = forces_.smallest_J(state_);
  for (std::size_t a = 0; a < J.size(); ++a)
    if (!std::isfinite(J[a])) fail(static_cast<Index>(a), "the deformation is not finite");
  for (std::size_t a = 0; a < J.size(); ++a)
    if (J[a] <= 0.0) fail(static_cast<Index>(a), fmt::format("the cell is inverted (J = {:.3g})", J[a]));
}

void Engine::verify_energy() {
  const EnergyLedger e = energies();
  energy_scale_ = e.scale;
  largest_contact_ = e.largest_contact;
  largest_strain_ = e.largest_strain;
  if (time_ > starting_part * spec_.end) largest_kinetic_share_ = std::max(largest_kinetic_share_, kinetic_share(e));
  if (!has_potential(model_.system.d)) return;  // the ledger need not close
  if (step_ < fewest_judged_steps) return;
  if (e.scale < e.negligible || e.relative_error() < hopeless_energy_error) return;
  Index fastest = 0;
  for (std::size_t a = 0; a < state_.v.size(); ++a)
    if (dot3(state_.v[a], state_.v[a]) >
        dot3(state_.v[static_cast<std::size_t>(fastest)], state_.v[static_cast<std::size_t>(fastest)]))
      fastest = static_cast<Index>(a);
  fail(fastest, fmt::format("the energy grows out of the ledger (error {:.2g} of the largest energy), fastest",
                            e.relative_error()));
}

}  // namespace tessera
