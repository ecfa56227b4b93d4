#include <algorithm>
#include <memory>

#include "tessera/laws/law_lanes.hpp"
#include "tessera/parallel/parallel.hpp"
#include "tessera/simulation/engine.hpp"

namespace tessera {

namespace {

constexpr Index lookahead = 48;  // particles

/// Makes room for n particles.
void resize(Snapshot& shot, std::size_t n) {
  for (auto* indices : {&shot.body, &shot.material}) indices->resize(n);
  for (auto* scalars : {&shot.volume, &shot.mass, &shot.energy_density, &shot.plastic_strain}) scalars->resize(n);
  for (auto* tensors : {&shot.deformation_gradient, &shot.first_piola_kirchhoff}) tensors->resize(n);
  for (auto* vectors : {&shot.reference_position, &shot.position, &shot.velocity, &shot.force, &shot.internal_force,
                        &shot.contact_force, &shot.external_force})
    vectors->resize(n);
}

/// Equivalent plastic strain of particle a, the mean over its stress points.
double mean_plastic_strain(const Forces& forces, std::size_t a) {
  if (forces.plastic().empty()) return 0.0;
  const auto points = static_cast<std::size_t>(forces.stress_points());
  double sum = 0.0;
  for (std::size_t q = 0; q < points; ++q) sum += forces.plastic()[a * points + q].strain;
  return sum / static_cast<double>(points);
}

/// Asks memory for an entry that is needed soon, across the cache lines that it may lie in.
template <class T>
void fetch(const T& entry) {
  constexpr std::size_t cache_line = 64;
  const auto* first = reinterpret_cast<const char*>(&entry);
  __builtin_prefetch(first);
  if constexpr (sizeof(T) > cache_line / 2) __builtin_prefetch(first + sizeof(T) - 1);
}

/// Entry a, or nothing where there are no entries at all.
Vec3 entry(const std::vector<Vec3>& values, std::size_t a) { return values.empty() ? Vec3{} : values[a]; }

}  // namespace

/// What snapshots need beside the engine's own state, computed once for all of them.
struct Engine::Observation {
  Forces::Internal internal;
  std::vector<Vec3> traction, reaction;  // of each particle; empty without any
  std::vector<Index> particle;           // with the user's number
};

SnapshotSource Engine::snapshots() const {
  const System& s = model_.system;
  const auto n = static_cast<std::size_t>(s.particles());
  if (!seen_ || seen_.use_count() > 1) seen_ = std::make_shared<Observation>();
  const std::shared_ptr<Observation> seen = seen_;
  static_cast<void>(forces_.total());  // completed by all threads, before one of them asks for a part
  forces_.find_internal(state_, seen->internal);
  if (seen->particle.empty()) {
    seen->particle.resize(n);
    parallel::for_each(s.particles(), [&](std::int64_t a) {
      seen->particle[static_cast<std::size_t>(model_.user_number[static_cast<std::size_t>(a)])] = static_cast<Index>(a);
    });
  }
  if (!model_.loads.tractions.forces().empty()) seen->traction.assign(n, Vec3{});
  for (const NodalForce& l : model_.loads.tractions.forces())
    seen->traction[static_cast<std::size_t>(l.particle)] += l.force;
  if (!s.d.constraints.empty()) seen->reaction.assign(n, Vec3{});
  for (std::size_t i = 0; i < s.d.constraints.size(); ++i)
    seen->reaction[static_cast<std::size_t>(s.d.constraints[i].particle)] += leapfrog_.reactions()[i];
  return {time_, s.particles(),
          [this, seen](Index begin, Index end, Snapshot& part) { take_snapshot(*seen, begin, end, part); }};
}

Snapshot Engine::snapshot() const { return snapshots().part(0, model_.system.particles()); }

void Engine::take_snapshot(const Observation& seen, Index begin, Index end, Snapshot& shot) const {
  const System& s = model_.system;
  resize(shot, static_cast<std::size_t>(end - begin));
  shot.time = time_;
  shot.step = step_;
  shot.first = begin;
  const auto points = static_cast<std::size_t>(s.stress_points);
  // The user's order jumps in memory, where the processor's own prefetcher cannot follow.
  const auto fetch_all = [&](std::size_t a) {
    fetch(state_.x[a]), fetch(state_.v[a]), fetch(forces_.total()[a]), fetch(seen.internal.force[a]);
    fetch(forces_.deformation_gradient()[a]), fetch(seen.internal.P[a]), fetch(s.d.X[a]);
    fetch(s.d.volume[a]), fetch(s.mass[a]), fetch(model_.body_of[a]), fetch(model_.material_of[a]);
  };
  parallel::for_each(end - begin, [&](std::int64_t i) {
    const auto u = static_cast<std::size_t>(i);
    fetch_all(static_cast<std::size_t>(
        seen.particle[static_cast<std::size_t>(std::min<std::int64_t>(begin + i + lookahead, end - 1))]));
    const auto a = static_cast<std::size_t>(seen.particle[static_cast<std::size_t>(begin + i)]);
    const Material& m = s.materials[static_cast<std::size_t>(model_.material_of[a])];
    const Vec3 v = leapfrog_.velocity(state_, forces_, dt_, static_cast<Index>(a));
    const double moved = leapfrog_.mass(static_cast<Index>(a));
    const Vec3 weight = s.mass[a] * model_.loads.gravity, drag = (-leapfrog_.damping() * moved) * v;
    const Vec3 total = to_vec3(forces_.total()[a]), traction = entry(seen.traction, a);
    shot.body[u] = model_.body_of[a];
    shot.material[u] = model_.material_of[a];
    shot.reference_position[u] = s.d.X[a];
    shot.position[u] = to_vec3(state_.x[a]);
    shot.velocity[u] = v;
    shot.force[u] = total + drag - entry(seen.reaction, a);
    shot.internal_force[u] = to_vec3(seen.internal.force[a]);
    shot.contact_force[u] = total - traction - weight - shot.internal_force[u];
    shot.external_force[u] = traction + weight + drag;
    shot.deformation_gradient[u] = to_mat3(forces_.deformation_gradient()[a]);
    shot.first_piola_kirchhoff[u] = to_mat3(seen.internal.P[a]);
    shot.volume[u] = s.d.volume[a];
    shot.mass[u] = moved;
    const PlasticState* history = state_.plastic.empty() ? nullptr : &state_.plastic[a * points];
    shot.energy_density[u] =
        !seen.internal.energy.empty()
            ? seen.internal.energy[a]
            : std::visit(
                  [&](const auto& law) { return tessera::stored_energy(law, forces_.law_deformation(a), history); },
                  m.law);
    shot.plastic_strain[u] = mean_plastic_strain(forces_, a);
  });
}

}  // namespace tessera
