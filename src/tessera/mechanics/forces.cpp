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

void find_all_point_strains(const System& s, const Tensor* F, SecondOrderMemory& memory) {
  parallel::for_ranges(0, s.particles(), [&](std::int64_t begin, std::int64_t end) {
    find_point_strains(*s.second_order, static_cast<Index>(begin), static_cast<Index>(end), F, memory);
  });
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
      flow_(flow),
      curved_(system) {
  const auto particles = static_cast<std::size_t>(system.particles());
  const auto nodes = static_cast<std::size_t>(system.boundary_nodes());
  F_.resize(particles);
  f_.resize(particles);
  R_.resize(nodes);
  reactions_.resize(nodes);
  rim_f_.resize(system.tiles.rim.size());
  if (system.d.direct) rim_f_direct_.resize(system.tiles.rim.size());
  if (split_) owners_P_.resize(system.owners.size());
  if (system.average && system.second_order)
    averaged_points_.emplace(system);
  else if (system.average && system.gradients)
    averaged_cells_.emplace(system);
  else if (system.average)
    averaged_.emplace(system);
  if (system.plastic()) history_after_.resize(particles * static_cast<std::size_t>(system.stress_points));
  if (cells_by_tile()) {
    cells_.T.resize(particles);
    if (split_) cells_.P.resize(particles);
    cells_.rim_energies.resize(system.tiles.rim.size());
  }
  if (!system.viscosity.empty()) {
    viscous_.F_previous.resize(particles);
    viscous_.P_previous.resize(particles);
  }
}

void Forces::evaluate(State& state, const ExternalAction& action, double dt) {
  strain(state, action);
  const auto over_tiles = [&](auto&& body) {
    return parallel::sum_tasks<StressSums>(system_.tiles.size(),
                                           [&](std::int64_t tile) { return body(static_cast<Index>(tile)); });
  };
  const StressSums averaged = averaged_stresses(state);
  if (system_.second_order) {
    sums_ = over_tiles([&](Index tile) { return curved_stresses(tile, state, dt); });
    return_gradients(*system_.second_order, system_.d.volume.data(), curved_);
    return_curvature(system_, curved_);
    sums_ += over_tiles([&](Index tile) { return curved_forces(tile); });
    add_extrapolated_forces(*system_.second_order, curved_, f_.data());
  } else if (cells_by_tile()) {
    sums_ = over_tiles([&](Index tile) { return cell_stresses(tile, state, dt); });
    sums_ += over_tiles([&](Index tile) { return cell_forces(tile, state); });
  } else {
    sums_ = over_tiles([&](Index tile) { return tile_forces(tile, state, dt); });
  }
  sums_ += averaged;
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
  if (s.second_order) add_curvature_strain(s, state.x.data(), curved_, F_.data());
  add_boundary_strain(s, state.x.data(), F_.data());
}

/// Where laws see a mean change of volume: the elastic stresses of all particles, known before the tiles' turn.
StressSums Forces::averaged_stresses(const State& state) {
  const HistorySpan history{state.plastic.data(), history_after_.data(), flow_};
  if (averaged_) return averaged_->evaluate(F_.data(), history);
  if (averaged_cells_) return averaged_cells_->evaluate(F_.data(), history, {});
  if (!averaged_points_) return {};
  find_all_point_strains(system_, F_.data(), curved_);
  return averaged_points_->evaluate(F_.data(), curved_.points.data(), history, {});
}

/// Stresses of one tile's own particles and what they do to each other, to the rim and to boundary nodes.
StressSums Forces::tile_forces(Index tile, const State& state, double dt) {
  const System& s = system_;
  const Lease scratch(scratch_);
  const double contact = contact_sweep(s, tile, state.x.data(), F_.data(), f_.data(), *scratch);
  const HistorySpan history{state.plastic.data(), history_after_.data(), flow_};
  StressSums sums = elastic_stress(tile, history, s.viscosity.empty() ? nullptr : &viscous_, dt, *scratch);
  sums.contact = contact + boundary_forces(tile, state, *scratch);
  hand_on(tile, *scratch);
  return sums;
}

/// The same in two passes: stresses of one tile's own cells, and their part in those of the rim.
StressSums Forces::cell_stresses(Index tile, const State& state, double dt) {
  const System& s = system_;
  const Lease scratch(scratch_);
  const double contact = contact_sweep(s, tile, state.x.data(), F_.data(), f_.data(), *scratch);
  const HistorySpan history{state.plastic.data(), history_after_.data(), flow_};
  Field<Tensor>& own = split() ? cells_.P : cells_.T;
  StressSums sums = cell_stress_sweep(s, tile, F_.data(), history, s.viscosity.empty() ? nullptr : &viscous_, dt,
                                      *scratch, {own.data(), cells_.rim_energies.data()}, {});
  sums.contact = contact;
  if (!split()) return sums;
  const auto first = static_cast<std::size_t>(tile_of(s, tile).begin);
  for (std::size_t a = 0; a < static_cast<std::size_t>(tile_of(s, tile).size()); ++a)
    cells_.T[first + a] = to_tensor(scratch->T[a]);
  return sums;
}

/// What complete stresses do.
StressSums Forces::cell_forces(Index tile, const State& state) {
  const Lease scratch(scratch_);
  recall(tile, cells_, *scratch);
  StressSums sums;
  sums.contact = boundary_forces(tile, state, *scratch);
  hand_on(tile, *scratch);
  return sums;
}

/// The same for second-order integration.
StressSums Forces::curved_stresses(Index tile, const State& state, double dt) {
  const System& s = system_;
  const Tile& t = tile_of(s, tile);
  const Lease scratch(scratch_);
  const double contact = contact_sweep(s, tile, state.x.data(), F_.data(), f_.data(), *scratch);
  ViscousMemory* viscous = s.viscosity.empty() ? nullptr : &viscous_;
  StressSums sums;
  if (averaged_points_) {
    sums = known_stress_sweep(s, tile, F_.data(), averaged_points_->P(), viscous, dt, *scratch);
  } else {
    find_point_strains(*s.second_order, t.begin, t.end, F_.data(), curved_);
    const HistorySpan history{state.plastic.data(), history_after_.data(), flow_};
    sums = varied_stress_sweep(s, tile, F_.data(), curved_.points.data(), history, viscous, dt, *scratch,
                               curved_.points.data(), {});
  }
  take_moments(*s.second_order, t.begin, t.end, curved_);
  sums.contact = contact;
  for_each_owner(s, tile, [&](Index k, Index a) {
    sums.contact += add_boundary_bonds(s, k, state.x.data(), F_[static_cast<std::size_t>(a)],
                                       scratch->T[static_cast<std::size_t>(a - t.begin)],
                                       f_[static_cast<std::size_t>(a)], R_.data());
  });
  for (Index a = t.begin; a < t.end; ++a)
    curved_.T[static_cast<std::size_t>(a)] = to_tensor(scratch->T[static_cast<std::size_t>(a - t.begin)]);
  return sums;
}

/// What complete stresses do: T at boundary nodes, T' between particles.
StressSums Forces::curved_forces(Index tile) {
  const Lease scratch(scratch_);
  for_each_owner(system_, tile, [&](Index k, Index a) {
    add_node_forces(system_, k, to_kernel(curved_.T[static_cast<std::size_t>(a)]), R_.data());
  });
  recall_first(system_, tile, curved_, scratch->T.data());
  hand_on(tile, *scratch);
  return {};
}

/// Stresses of all cells with viscosity but without bonds, and what second derivatives make of them, in `memory`, at
/// the state of the last evaluation.
void Forces::report_curved(const State& state, const CellReport& report, SecondOrderMemory& memory) const {
  const System& s = system_;
  memory.H = curved_.H;
  const HistorySpan history{state.plastic.data(), nullptr, flow_};
  std::optional<AveragedCubature> averaged;
  if (averaged_points_) {
    find_all_point_strains(s, F_.data(), memory);
    averaged.emplace(s).evaluate(F_.data(), memory.points.data(), history, report);
  }
  parallel::for_tasks(s.tiles.size(), [&](std::int64_t task) {
    const auto tile = static_cast<Index>(task);
    const Tile& t = tile_of(s, tile);
    const Lease scratch(scratch_);
    std::fill(scratch->T.begin(), scratch->T.end(), Columns{});
    if (averaged) {
      known_stress_sweep(s, tile, F_.data(), averaged->P(), nullptr, 0.0, *scratch);
    } else {
      find_point_strains(*s.second_order, t.begin, t.end, F_.data(), memory);
      varied_stress_sweep(s, tile, F_.data(), memory.points.data(), history, nullptr, 0.0, *scratch,
                          memory.points.data(), report);
    }
    take_moments(*s.second_order, t.begin, t.end, memory);
    for (Index a = t.begin; a < t.end; ++a)
      memory.T[static_cast<std::size_t>(a)] = to_tensor(scratch->T[static_cast<std::size_t>(a - t.begin)]);
  });
  return_gradients(*s.second_order, s.d.volume.data(), memory);
  for (std::size_t a = 0; a < viscous_.P_previous.size(); ++a)
    memory.T[a] = to_tensor(to_kernel(memory.T[a]) + to_kernel(viscous_.P_previous[a]));
  return_curvature(s, memory);
}

void Forces::recall(Index tile, const CellMemory& cells, TileScratch& scratch) const {
  const Tensor* rims = cells.rim_energies.data();
  if (cells.P.empty()) {
    complete_stresses(system_, tile, cells.T.data(), rims, scratch.T.data());
    return;
  }
  complete_stresses(system_, tile, cells.P.data(), rims, scratch.P.data());
  const auto first = static_cast<std::size_t>(tile_of(system_, tile).begin);
  for (std::size_t a = 0; a < static_cast<std::size_t>(tile_of(system_, tile).size()); ++a)
    scratch.T[a] = to_kernel(cells.T[first + a]);
}

/// Elastic and viscous stress of one tile's own particles.
StressSums Forces::elastic_stress(Index tile, const HistorySpan& history, ViscousMemory* viscous, double dt,
                                  TileScratch& scratch) const {
  if (averaged_) return known_stress_sweep(system_, tile, F_.data(), averaged_->P(), viscous, dt, scratch);
  if (averaged_cells_) return known_stress_sweep(system_, tile, F_.data(), averaged_cells_->T(), viscous, dt, scratch);
  return stress_sweep(system_, tile, F_.data(), history, viscous, dt, scratch);
}

/// Bonds and stresses at the boundary nodes of a tile's particles; returns the bonds' energy.
double Forces::boundary_forces(Index tile, const State& state, TileScratch& scratch) {
  double contact = 0.0;
  for_each_owner(system_, tile, [&](Index k, Index owner) {
    const auto a = static_cast<std::size_t>(owner), local = a - static_cast<std::size_t>(tile_of(system_, tile).begin);
    Columns& T = scratch.T[local];
    contact += add_boundary_bonds(system_, k, state.x.data(), F_[a], T, f_[a], R_.data());
    add_node_forces(system_, k, T, R_.data());
    if (split()) owners_P_[static_cast<std::size_t>(k)] = scratch.P[local];
  });
  return contact;
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

std::vector<double> Forces::smallest_J(const State& state) const {
  const System& s = system_;
  std::vector<double> J(static_cast<std::size_t>(s.particles()));
  if (s.second_order) {
    SecondOrderMemory memory(s);
    report_curved(state, {nullptr, J.data()}, memory);
    return J;
  }
  if (averaged_cells_) {
    AveragedCells(s).evaluate(F_.data(), {state.plastic.data(), nullptr, flow_}, {nullptr, J.data(), nullptr});
    return J;
  }
  if (!s.gradients) {
    for (std::size_t a = 0; a < J.size(); ++a) J[a] = determinant(to_mat3(F_[a]));
    return J;
  }
  RawField<Tensor> own(J.size()), rims(s.tiles.rim.size());
  parallel::for_tasks(s.tiles.size(), [&](std::int64_t task) {
    const auto tile = static_cast<Index>(task);
    const Lease scratch(scratch_);
    load_tile(s, tile, state.x.data(), F_.data(), *scratch);
    cell_stress_sweep(s, tile, F_.data(), {state.plastic.data(), nullptr, flow_}, nullptr, 0.0, *scratch,
                      {own.data(), rims.data()}, {nullptr, J.data(), nullptr});
  });
  return J;
}

Forces::Internal Forces::internal(const State& state) const {
  const System& s = system_;
  const auto particles = static_cast<std::size_t>(s.particles());
  Internal result{Field<Tensor>(particles), Field<Double4>(particles), {}};
  Field<Double4> R(static_cast<std::size_t>(s.boundary_nodes())), rim_f(s.tiles.rim.size());
  Field<Columns> owners_P(s.owners.size());
  const Vec3* B = s.d.direct ? s.tiles.direct_B.data() : s.tiles.B.data();
  const Vec3* B_aa = s.d.direct ? s.d.direct->B_aa.data() : s.d.B_aa.data();
  CellMemory cells;
  SecondOrderMemory curved(s);
  if (s.gradients || s.second_order) result.energy.resize(particles);
  if (s.second_order) report_curved(state, {result.P.data(), nullptr, result.energy.data()}, curved);
  if (averaged_cells_) {
    AveragedCells averaged(s);
    averaged.evaluate(F_.data(), {state.plastic.data(), nullptr, flow_},
                      {result.P.data(), nullptr, result.energy.data()});
    cells.T.assign(averaged.T(), averaged.T() + particles);
  }
  if (cells_by_tile()) {
    cells.T.resize(particles);
    cells.rim_energies.resize(s.tiles.rim.size());
    parallel::for_tasks(s.tiles.size(), [&](std::int64_t task) {
      const auto tile = static_cast<Index>(task);
      const Lease scratch(scratch_);
      load_tile(s, tile, state.x.data(), F_.data(), *scratch);
      std::fill(scratch->T.begin(), scratch->T.end(), Columns{});
      cell_stress_sweep(s, tile, F_.data(), {state.plastic.data(), nullptr, flow_}, nullptr, 0.0, *scratch,
                        {cells.T.data(), cells.rim_energies.data()}, {result.P.data(), nullptr, result.energy.data()});
    });
  }
  parallel::for_tasks(s.tiles.size(), [&](std::int64_t task) {
    const auto tile = static_cast<Index>(task);
    const Tile& t = tile_of(s, tile);
    const Lease scratch(scratch_);
    Columns* P = split() ? scratch->P.data() : scratch->T.data();
    std::fill(scratch->T.begin(), scratch->T.end(), Columns{});
    if (s.second_order) {
      recall_first(s, tile, curved, P);
    } else if (cells_by_tile()) {
      complete_stresses(s, tile, cells.T.data(), cells.rim_energies.data(), P);
    } else if (averaged_cells_) {
      for (Index a = t.begin; a < t.end; ++a) P[a - t.begin] = to_kernel(cells.T[static_cast<std::size_t>(a)]);
    } else {
      elastic_stress(tile, {state.plastic.data(), nullptr, flow_}, nullptr, 0.0, *scratch);
    }
    for (Index a = t.begin; a < t.end; ++a) {
      const auto k = static_cast<std::size_t>(a);
      if (!s.gradients && !s.second_order) result.P[k] = to_tensor(P[a - t.begin]);
      if (viscous_.P_previous.empty()) continue;
      const Columns viscous = to_kernel(viscous_.P_previous[k]);
      if (!s.second_order) P[a - t.begin] = P[a - t.begin] + viscous;
      result.P[k] = to_tensor(to_kernel(result.P[k]) + viscous);
    }
    for_each_owner(s, tile, [&](Index k, Index a) {
      const Columns T = s.second_order ? to_kernel(curved.T[static_cast<std::size_t>(a)]) : P[a - t.begin];
      owners_P[static_cast<std::size_t>(k)] = T;
      add_node_forces(s, k, T, R.data());
    });
    force_sweep(s, tile, P, B, B_aa, result.force.data(), rim_f.data());
  });
  if (s.second_order) add_extrapolated_forces(*s.second_order, curved, result.force.data());
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
