#include "tessera/mechanics/stress_forces.hpp"

#include <algorithm>

#include "tessera/mechanics/boundary.hpp"
#include "tessera/mechanics/tile_nodes.hpp"

namespace tessera {

namespace {

/// Reads the tile's part of B, so that it is in the cache from which the force sweep takes it in no order. (So many
/// prefetches at once would be dropped.)
void read_gradient_vectors(const System& s, Index tile, const RawField<Vec3>& B) {
  constexpr std::size_t cache_line = 64;
  const auto* line = reinterpret_cast<const volatile char*>(B.data() + tile_of(s, tile).slot);
  const auto* end = reinterpret_cast<const volatile char*>(B.data() + s.tiles.end_of(tile).slot);
  for (; line < end; line += cache_line) static_cast<void>(*line);
}

}  // namespace

bool treats_stresses_apart(const System& s) {
  const bool direct_reactions = s.d.boundary_force == BoundaryForce::direct && s.boundary_nodes() > 0;
  return direct_reactions || s.d.direct.has_value();
}

StressForces::StressForces(const System& s)
    : s_(s),
      split_(treats_stresses_apart(s)),
      f_(static_cast<std::size_t>(s.particles())),
      R_(static_cast<std::size_t>(s.boundary_nodes())),
      rim_f_(s.tiles.rim.size()) {
  if (s.d.direct) rim_f_direct_.resize(s.tiles.rim.size());
  if (split_) owners_P_.resize(s.owners.size());
}

void StressForces::clear() {
  for (Field<Double4>* forces : {&f_, &R_})
    parallel::for_ranges(0, static_cast<std::int64_t>(forces->size()), [&](std::int64_t begin, std::int64_t end) {
      std::fill(forces->begin() + begin, forces->begin() + end, Double4{});
    });
}

StressSums StressForces::find(StressIntegration& integration, const StressTask& task,
                              StressIntegration::Scratches& scratches, std::span<Vec3> reactions) {
  StressSums sums = integration.gather(task);
  sums += sum_tiles(s_, scratches, [&](Index tile, TileScratch& scratch) {
    if (task.bonds.f == nullptr && !s_.tiles.B.empty()) read_gradient_vectors(s_, tile, s_.tiles.B);  // else bonds have
    const StressSums of_tile = integration.stresses(task, tile, scratch);
    act_on_nodes(tile, scratch);
    act_on_particles(integration, tile, scratch);
    return of_tile;
  });
  drain(reactions);
  return sums;
}

void StressForces::act_on_nodes(Index tile, const TileScratch& scratch) {
  for_each_owner(s_, tile, [&](Index k, Index a) {
    const auto local = static_cast<std::size_t>(a - tile_of(s_, tile).begin);
    add_node_forces(s_, k, scratch.T[local], R_.data());
    if (split_) owners_P_[static_cast<std::size_t>(k)] = scratch.P[local];
  });
}

void StressForces::act_on_particles(const StressIntegration& integration, Index tile, TileScratch& scratch) {
  if (split_ && !s_.d.direct)
    for (std::size_t a = 0; a < static_cast<std::size_t>(tile_of(s_, tile).size()); ++a)
      scratch.T[a] = scratch.P[a] + scratch.T[a];
  integration.act(tile, scratch, f_.data(), rim_f_.data());
  if (s_.d.direct)
    force_sweep(s_, tile, scratch.P.data(), s_.tiles.direct_B.data(), s_.d.direct->B_aa.data(), f_.data(),
                rim_f_direct_.data());
}

void StressForces::drain(std::span<Vec3> reactions) {
  std::fill(reactions.begin(), reactions.end(), Vec3{});
  drain_boundary_nodes(s_, R_.data(), f_.data(), reactions);
  if (!split_) return;
  if (!s_.d.direct) drain_with_held_branches(s_, owners_P_.data(), R_.data(), f_.data());
  add_direct_reactions(s_, owners_P_.data(), f_.data(), reactions);
}

void StressForces::collect(Index first, Index last, Double4* total) const {
  collect_rims(s_.tiles, rim_f_.data(), f_.data() + first, total, first, last);
  if (s_.d.direct) collect_rims(s_.tiles, rim_f_direct_.data(), total, total, first, last);
}

}  // namespace tessera
