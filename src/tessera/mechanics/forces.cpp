#include "tessera/mechanics/forces.hpp"

#include <algorithm>

#include "tessera/mechanics/boundary.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

Forces::Forces(const System& system) : system_(system) {
  const auto particles = static_cast<std::size_t>(system.particles());
  const auto nodes = static_cast<std::size_t>(system.boundary_nodes());
  F_.resize(particles);
  T_.resize(particles);
  f_.resize(particles);
  R_.resize(nodes);
  reactions_.resize(nodes);
  const bool direct = system.d.boundary_force == BoundaryForce::direct && nodes > 0;
  if (direct || system.d.direct) P_.resize(particles);
  if (!system.viscosity.empty()) {
    viscous_.F_previous.resize(particles);
    viscous_.P_previous.resize(particles);
  }
}

void Forces::evaluate(State& state, const ExternalAction& action, double dt) {
  strain(state, action);
  stress(state, dt);
  drain();
  add_external(action);
  const System& s = system_;
  if (split() && !s.d.direct)
    parallel::for_each(s.particles(), [&](std::int64_t a) {
      const auto k = static_cast<std::size_t>(a);
      T_[k] = P_[k] + T_[k];
    });
  parallel::for_ranges(0, s.particles(), [&](std::int64_t begin, std::int64_t end) {
    const auto first = static_cast<Index>(begin), last = static_cast<Index>(end);
    force_sweep(s.d.bonds, s.d.bonds.B_ba.data(), s.d.B_aa.data(), T_.data(), f_.data(), first, last);
    if (s.d.direct)
      force_sweep(s.d.bonds, s.d.direct->B_ba.data(), s.d.direct->B_aa.data(), P_.data(), f_.data(), first, last);
  });
}

void Forces::restore_previous_deformation(Field<Columns> F) {
  if (!F.empty()) F_ = std::move(F);  // evaluate() moves it into its place
}

void Forces::strain(State& state, const ExternalAction& action) {
  const System& s = system_;
  if (!s.viscosity.empty()) std::swap(F_, viscous_.F_previous);
  fill_boundary_nodes(s, action.walls, state.x.data());
  parallel::for_ranges(0, s.particles(), [&](std::int64_t begin, std::int64_t end) {
    strain_sweep(s, state.x.data(), F_.data(), static_cast<Index>(begin), static_cast<Index>(end));
  });
  add_boundary_strain(s, state.x.data(), F_.data());
}

void Forces::stress(const State& state, double dt) {
  const System& s = system_;
  const StressSweep sweep{s,
                          state.x.data(),
                          F_.data(),
                          T_.data(),
                          split() ? P_.data() : nullptr,
                          f_.data(),
                          s.viscosity.empty() ? nullptr : &viscous_,
                          dt};
  sums_ = {};
  for (const MaterialRange& r : s.ranges)
    sums_ += parallel::sum_ranges<StressSums>(r.begin, r.end, [&](std::int64_t begin, std::int64_t end) {
      return sweep(s.materials[static_cast<std::size_t>(r.material)], static_cast<Index>(begin),
                   static_cast<Index>(end));
    });
  sums_.contact += add_boundary_bonds(s, state.x.data(), F_.data(), T_.data(), f_.data(), R_.data());
}

void Forces::drain() {
  std::fill(reactions_.begin(), reactions_.end(), Vec3{});
  add_node_forces(system_, T_.data(), R_.data());
  drain_boundary_nodes(system_, R_.data(), f_.data(), reactions_);
  if (!split()) return;
  if (!system_.d.direct) drain_with_held_branches(system_, P_.data(), R_.data(), f_.data());
  add_direct_reactions(system_, P_.data(), f_.data(), reactions_);
}

void Forces::add_external(const ExternalAction& action) {
  for (const NodalForce& l : action.tractions) f_[static_cast<std::size_t>(l.particle)] += to_kernel(l.force);
  if (action.gravity == Vec3{}) return;
  const Double4 g = to_kernel(action.gravity);
  parallel::for_each(system_.particles(), [&](std::int64_t a) {
    f_[static_cast<std::size_t>(a)] += system_.mass[static_cast<std::size_t>(a)] * g;
  });
}

Forces::Internal Forces::internal(const State& state) const {
  const System& s = system_;
  const auto particles = static_cast<std::size_t>(s.particles());
  Internal result{Field<Columns>(particles), Field<Double4>(particles)};
  Field<Columns> contact(particles);
  const StressSweep sweep{s,  state.x.data(), F_.data(), contact.data(), result.P.data(), result.force.data(), nullptr,
                          0.0};
  for (const MaterialRange& r : s.ranges)
    parallel::for_ranges(r.begin, r.end, [&](std::int64_t begin, std::int64_t end) {
      sweep(s.materials[static_cast<std::size_t>(r.material)], static_cast<Index>(begin), static_cast<Index>(end));
    });
  for (std::size_t a = 0; a < viscous_.P_previous.size(); ++a) result.P[a] = result.P[a] + viscous_.P_previous[a];

  std::fill(result.force.begin(), result.force.end(), Double4{});
  Field<Double4> R(static_cast<std::size_t>(s.boundary_nodes()));
  std::vector<Vec3> reactions(static_cast<std::size_t>(s.boundary_nodes()));
  const Vec3* B_ba = s.d.direct ? s.d.direct->B_ba.data() : s.d.bonds.B_ba.data();
  const Vec3* B_aa = s.d.direct ? s.d.direct->B_aa.data() : s.d.B_aa.data();
  if (split()) {
    if (!s.d.direct) drain_with_held_branches(s, result.P.data(), R.data(), result.force.data());
    add_direct_reactions(s, result.P.data(), result.force.data(), reactions);
  } else {
    add_node_forces(s, result.P.data(), R.data());
    drain_boundary_nodes(s, R.data(), result.force.data(), reactions);
  }
  parallel::for_ranges(0, s.particles(), [&](std::int64_t begin, std::int64_t end) {
    force_sweep(s.d.bonds, B_ba, B_aa, result.P.data(), result.force.data(), static_cast<Index>(begin),
                static_cast<Index>(end));
  });
  return result;
}

}  // namespace tessera
