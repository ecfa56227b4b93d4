#include "tessera/mechanics/stress_integration.hpp"

#include <algorithm>

#include "tessera/mechanics/boundary.hpp"
#include "tessera/mechanics/tile_nodes.hpp"

namespace tessera {

std::unique_ptr<StressIntegration> make_integration(const System& s, StressIntegration::Scratches& scratches) {
  if (s.second_order) return second_order_integration(s, scratches);
  if (s.gradients) return cell_integration(s, scratches);
  return nodal_integration(s, scratches);
}

void StressIntegration::find_strain(const Double4* x, Tensor* F) {
  parallel::for_tasks(s_.tiles.size(), [&](std::int64_t tile) {
    const Scratches::Lease scratch(scratches_);
    strain_sweep(s_, static_cast<Index>(tile), x, F, *scratch);
  });
}

void StressIntegration::act(Index tile, const TileScratch& scratch, Double4* f, Double4* rim_f) const {
  force_sweep(s_, tile, scratch.T.data(), s_.tiles.B.data(), s_.d.B_aa.data(), f, rim_f);
}

double add_tile_bonds(const System& s, Index tile, const StressTask& task, TileScratch& scratch) {
  if (task.bonds.f != nullptr) return contact_sweep(s, tile, task.x, task.F, task.bonds.f, scratch);
  std::fill(scratch.T.begin(), scratch.T.end(), Columns{});
  return 0.0;
}

double add_tile_boundary_bonds(const System& s, Index tile, const StressTask& task, TileScratch& scratch) {
  double energy = 0.0;
  if (task.bonds.R == nullptr) return energy;
  for_each_owner(s, tile, [&](Index k, Index a) {
    Columns& T = scratch.T[static_cast<std::size_t>(a - tile_of(s, tile).begin)];
    energy += add_boundary_bonds(s, k, task.x, task.F[a], T, task.bonds.f[a], task.bonds.R);
  });
  return energy;
}

void add_known_viscous_stress(const System& s, Index tile, const StressTask& task, TileScratch& scratch) {
  if (task.viscous_stress == nullptr) return;
  const Tile& t = tile_of(s, tile);
  Field<Columns>& P = scratch.P.empty() ? scratch.T : scratch.P;
  for (Index a = t.begin; a < t.end; ++a) {
    const Columns viscous = to_kernel(task.viscous_stress[a]);
    Columns& P_a = P[static_cast<std::size_t>(a - t.begin)];
    P_a = P_a + viscous;
    Tensor* mean = task.report.mean;
    if (mean != nullptr) mean[a] = to_tensor(to_kernel(mean[a]) + viscous);
  }
}

}  // namespace tessera
