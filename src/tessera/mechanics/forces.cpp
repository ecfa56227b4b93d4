#include "tessera/mechanics/forces.hpp"

#include "tessera/mechanics/boundary.hpp"
#include "tessera/mechanics/following.hpp"

namespace tessera {

namespace {

std::unique_ptr<TileScratch> make_scratch(const System& s) {
  auto scratch = std::make_unique<TileScratch>(s);
  if (treats_stresses_apart(s)) scratch->P.resize(scratch->T.size());
  return scratch;
}

/// Cells have stress points of their own.
bool has_points(const System& s) { return s.gradients || s.second_order; }

}  // namespace

Forces::Forces(const System& system, Flow flow)
    : system_(system),
      scratches_([&system] { return make_scratch(system); }),
      integration_(make_integration(system, scratches_)),
      F_(static_cast<std::size_t>(system.particles())),
      forces_(system),
      reactions_(static_cast<std::size_t>(system.boundary_nodes())),
      flow_(flow) {
  const auto particles = static_cast<std::size_t>(system.particles());
  if (system.plastic()) history_after_.resize(particles * static_cast<std::size_t>(system.stress_points));
  if (system.viscosity.empty()) return;
  viscous_.F_previous.resize(particles);
  viscous_.P_previous.resize(particles);
}

void Forces::evaluate(State& state, const ExternalAction& action, double dt) {
  strain(state, action);
  const StressTask task{.x = state.x.data(),
                        .F = F_.data(),
                        .history = {state.plastic.data(), history_after_.data(), flow_},
                        .bonds = forces_.bonds(),
                        .viscous = system_.viscosity.empty() ? nullptr : &viscous_,
                        .dt = dt};
  sums_ = forces_.find(*integration_, task, scratches_, reactions_);
  add_tractions(state, action);
  gravity_ = action.gravity;
  incomplete_ = true;
}

void Forces::restore_previous_deformation(Field<Tensor> F) {
  if (!F.empty()) F_ = std::move(F);  // evaluate() moves it into its place
}

void Forces::strain(State& state, const ExternalAction& action) {
  const System& s = system_;
  if (!s.viscosity.empty()) std::swap(F_, viscous_.F_previous);
  fill_boundary_nodes(s, action.walls, state.x.data());
  integration_->find_strain(state.x.data(), F_.data());
  add_boundary_strain(s, state.x.data(), F_.data());
}

void Forces::add_tractions(const State& state, const ExternalAction& action) {
  Field<Double4>& f = forces_.f();
  if (action.following != nullptr) follow_faces(system_, state.x.data(), F_.data(), *action.following);
  for (const NodalForce& l : action.tractions) f[static_cast<std::size_t>(l.particle)] += to_kernel(l.force);
}

/// What bonds and the tiles themselves have done, with what other tiles have done, and gravity.
void Forces::complete(Index first, Index last, Double4* total) const {
  forces_.collect(first, last, total);
  if (gravity_ == Vec3{}) return;
  const Double4 g = to_kernel(gravity_);
  for (Index a = first; a < last; ++a) total[a - first] += system_.mass[static_cast<std::size_t>(a)] * g;
}

const Field<Double4>& Forces::total() const {
  if (!incomplete_) return forces_.f();
  const std::lock_guard lock(completing_);
  if (incomplete_)
    parallel::for_ranges(0, system_.particles(), [&](std::int64_t begin, std::int64_t end) {
      complete(static_cast<Index>(begin), static_cast<Index>(end), forces_.f().data() + begin);
    });
  incomplete_ = false;
  return forces_.f();
}

/// The stresses of the last evaluation once more: without bonds, the state's history being what it has found.
StressTask Forces::once_more(const State& state, const CellReport& report) const {
  return {.x = state.x.data(), .F = F_.data(), .history = {state.plastic.data(), nullptr, flow_}, .report = report};
}

std::vector<double> Forces::smallest_J(const State& state) const {
  std::vector<double> J(static_cast<std::size_t>(system_.particles()));
  if (has_points(system_)) {
    integration_->apart()->gather(once_more(state, {.smallest_J = J.data()}));
    return J;
  }
  for (std::size_t a = 0; a < J.size(); ++a) J[a] = determinant(to_mat3(F_[a]));
  return J;
}

void Forces::find_internal(const State& state, Internal& result) const {
  const System& s = system_;
  const auto particles = static_cast<std::size_t>(s.particles());
  result.P.resize(particles);
  if (has_points(s)) result.energy.resize(particles);
  StressTask task =
      once_more(state, {.mean = result.P.data(), .energy = has_points(s) ? result.energy.data() : nullptr});
  if (!viscous_.P_previous.empty()) task.viscous_stress = viscous_.P_previous.data();
  if (!result.memory) result.memory = std::make_unique<StressForces>(s);
  StressForces& forces = *result.memory;
  if (!result.force.empty()) forces.f().swap(result.force);
  forces.clear();
  std::vector<Vec3> reactions(static_cast<std::size_t>(s.boundary_nodes()));
  forces.find(*integration_->apart(), task, scratches_, reactions);
  parallel::for_ranges(0, s.particles(), [&](std::int64_t begin, std::int64_t end) {
    forces.collect(static_cast<Index>(begin), static_cast<Index>(end), forces.f().data() + begin);
  });
  forces.f().swap(result.force);
}

Forces::Internal Forces::internal(const State& state) const {
  Internal result;
  find_internal(state, result);
  return result;
}

}  // namespace tessera
