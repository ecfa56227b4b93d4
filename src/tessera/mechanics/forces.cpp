#include "tessera/mechanics/forces.hpp"

#include <algorithm>

#include "tessera/mechanics/boundary.hpp"
#include "tessera/mechanics/following.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

using Lease = parallel::Workspaces<TileScratch>::Lease;

const Tile& tile_of(const System& s, Index tile) { return s.tiles.tiles[static_cast<std::size_t>(tile)]; }

bool treats_stresses_apart(const System& s) {
  const bool direct_reactions = s.d.boundary_force == BoundaryForce::direct && s.boundary_nodes() > 0;
  return direct_reactions || s.d.direct.has_value();
}

/// Calls body(k, a) for every owner of boundary nodes in a tile: its number and the particle.
template <class Body>
void for_each_owner(const System& s, Index tile, Body&& body) {
  for (Index k = tile_of(s, tile).first_owner; k < s.tiles.end_of(tile).first_owner; ++k)
    body(k, s.owners[static_cast<std::size_t>(k)]);
}

}  // namespace

Forces::Forces(const System& system, Flow flow)
    : system_(system),
      split_(treats_stresses_apart(system)),
      scratch_([this] {
        auto scratch = std::make_unique<TileScratch>(system_);
        if (split_) scratch->P.resize(scratch->T.size());
        return scratch;
      }),
      flow_(flow) {
  const auto particles = static_cast<std::size_t>(system.particles());
  const auto nodes = static_cast<std::size_t>(system.boundary_nodes());
  F_.resize(particles);
  f_.resize(particles);
  R_.resize(nodes);
  reactions_.resize(nodes);
  rim_f_.resize(system.tiles.rim.size());
  if (system.d.direct) rim_f_direct_.resize(system.tiles.rim.size());
  if (split_) owners_P_.resize(system.owners.size());
  if (system.plastic()) history_after_.resize(particles * static_cast<std::size_t>(system.stress_points));
  if (!system.viscosity.empty()) {
    viscous_.F_previous.resize(particles);
    viscous_.P_previous.resize(particles);
  }
}

void Forces::evaluate(State& state, const ExternalAction& action, double dt) {
  strain(state, action);
  sums_ = parallel::sum_tasks<StressSums>(
      system_.tiles.size(), [&](std::int64_t tile) { return tile_forces(static_cast<Index>(tile), state, dt); });
  drain();
  finish(state, action);
}

void Forces::restore_previous_deformation(Field<Tensor> F) {
  if (!F.empty()) F_ = std::move(F);  // evaluate() moves it into its place
}

void Forces::strain(State& state, const ExternalAction& action) {
  const System& s = system_;
  if (!s.viscosity.empty()) std::swap(F_, viscous_.F_previous);
  fill_boundary_nodes(s, action.walls, state.x.data());
  parallel::for_tasks(s.tiles.size(), [&](std::int64_t tile) {
    const Lease scratch(scratch_);
    strain_sweep(s, static_cast<Index>(tile), state.x.data(), F_.data(), *scratch);
  });
  add_boundary_strain(s, state.x.data(), F_.data());
}

/// Stresses of one tile's own particles and what they do to each other, to the rim and to boundary nodes.
StressSums Forces::tile_forces(Index tile, const State& state, double dt) {
  const System& s = system_;
  const Lease scratch(scratch_);
  const Index first = tile_of(s, tile).begin;
  const double contact = contact_sweep(s, tile, state.x.data(), F_.data(), f_.data(), *scratch);
  const HistorySpan history{state.plastic.data(), history_after_.data(), flow_};
  StressSums sums = stress_sweep(s, tile, F_.data(), history, s.viscosity.empty() ? nullptr : &viscous_, dt, *scratch);
  sums.contact = contact;
  for_each_owner(s, tile, [&](Index k, Index a) {
    Columns& T = scratch->T[static_cast<std::size_t>(a - first)];
    sums.contact += add_boundary_bonds(s, k, state.x.data(), F_[static_cast<std::size_t>(a)], T,
                                       f_[static_cast<std::size_t>(a)], R_.data());
    add_node_forces(s, k, T, R_.data());
    if (split()) owners_P_[static_cast<std::size_t>(k)] = scratch->P[static_cast<std::size_t>(a - first)];
  });
  hand_on(tile, *scratch);
  return sums;
}

void Forces::hand_on(Index tile, TileScratch& scratch) {
  const System& s = system_;
  if (split() && !s.d.direct)
    for (std::size_t a = 0; a < static_cast<std::size_t>(tile_of(s, tile).size()); ++a)
      scratch.T[a] = scratch.P[a] + scratch.T[a];
  force_sweep(s, tile, scratch.T.data(), s.tiles.B.data(), s.d.B_aa.data(), f_.data(), rim_f_.data());
  if (s.d.direct)
    force_sweep(s, tile, scratch.P.data(), s.tiles.direct_B.data(), s.d.direct->B_aa.data(), f_.data(),
                rim_f_direct_.data());
}

void Forces::drain() {
  std::fill(reactions_.begin(), reactions_.end(), Vec3{});
  drain_boundary_nodes(system_, R_.data(), f_.data(), reactions_);
  if (!split()) return;
  if (!system_.d.direct) drain_with_held_branches(system_, owners_P_.data(), R_.data(), f_.data());
  add_direct_reactions(system_, owners_P_.data(), f_.data(), reactions_);
}

/// Adds tractions, what other tiles have done, and gravity.
void Forces::finish(const State& state, const ExternalAction& action) {
  const System& s = system_;
  if (action.following != nullptr) follow_faces(s, state.x.data(), F_.data(), *action.following);
  for (const NodalForce& l : action.tractions) f_[static_cast<std::size_t>(l.particle)] += to_kernel(l.force);
  const Double4 g = to_kernel(action.gravity);
  parallel::for_ranges(0, s.particles(), [&](std::int64_t begin, std::int64_t end) {
    const auto first = static_cast<Index>(begin), last = static_cast<Index>(end);
    collect_rims(s.tiles, rim_f_.data(), f_.data(), first, last);
    if (s.d.direct) collect_rims(s.tiles, rim_f_direct_.data(), f_.data(), first, last);
    if (action.gravity == Vec3{}) return;
    for (Index a = first; a < last; ++a) f_[static_cast<std::size_t>(a)] += s.mass[static_cast<std::size_t>(a)] * g;
  });
}

Forces::Internal Forces::internal(const State& state) const {
  const System& s = system_;
  const auto particles = static_cast<std::size_t>(s.particles());
  Internal result{Field<Tensor>(particles), Field<Double4>(particles)};
  Field<Double4> R(static_cast<std::size_t>(s.boundary_nodes())), rim_f(s.tiles.rim.size());
  Field<Columns> owners_P(s.owners.size());
  const Vec3* B = s.d.direct ? s.tiles.direct_B.data() : s.tiles.B.data();
  const Vec3* B_aa = s.d.direct ? s.d.direct->B_aa.data() : s.d.B_aa.data();
  parallel::for_tasks(s.tiles.size(), [&](std::int64_t task) {
    const auto tile = static_cast<Index>(task);
    const Tile& t = tile_of(s, tile);
    const Lease scratch(scratch_);
    Columns* P = split() ? scratch->P.data() : scratch->T.data();
    std::fill(scratch->T.begin(), scratch->T.end(), Columns{});
    stress_sweep(s, tile, F_.data(), {state.plastic.data(), nullptr, flow_}, nullptr, 0.0, *scratch);
    for (Index a = t.begin; a < t.end; ++a) {
      const auto k = static_cast<std::size_t>(a);
      if (!viscous_.P_previous.empty()) P[a - t.begin] = P[a - t.begin] + to_kernel(viscous_.P_previous[k]);
      result.P[k] = to_tensor(P[a - t.begin]);
    }
    for_each_owner(s, tile, [&](Index k, Index a) {
      owners_P[static_cast<std::size_t>(k)] = P[a - t.begin];
      add_node_forces(s, k, P[a - t.begin], R.data());
    });
    force_sweep(s, tile, P, B, B_aa, result.force.data(), rim_f.data());
  });
  std::vector<Vec3> reactions(static_cast<std::size_t>(s.boundary_nodes()));
  if (split()) {
    if (!s.d.direct) drain_with_held_branches(s, owners_P.data(), R.data(), result.force.data());
    add_direct_reactions(s, owners_P.data(), result.force.data(), reactions);
  } else {
    drain_boundary_nodes(s, R.data(), result.force.data(), reactions);
  }
  parallel::for_ranges(0, s.particles(), [&](std::int64_t begin, std::int64_t end) {
    collect_rims(s.tiles, rim_f.data(), result.force.data(), static_cast<Index>(begin), static_cast<Index>(end));
  });
  return result;
}

}  // namespace tessera
