#include "tessera/mechanics/averaged_stress.hpp"
#include "tessera/mechanics/stress_integration.hpp"
#include "tessera/mechanics/tile_nodes.hpp"

namespace tessera {

namespace {

/// The stress of a tile's own particles is all that is known of their cells.
void report_stress(const System& s, Index tile, const CellReport& report, const TileScratch& scratch) {
  if (report.mean == nullptr) return;
  const Tile& t = tile_of(s, tile);
  const Field<Columns>& P = scratch.P.empty() ? scratch.T : scratch.P;
  for (Index a = t.begin; a < t.end; ++a) report.mean[a] = to_tensor(P[static_cast<std::size_t>(a - t.begin)]);
}

/// The papers': P(F_a) stands for the whole cell. No neighbour needs to know, so there is one pass.
class NodalIntegration : public StressIntegration {
 public:
  using StressIntegration::StressIntegration;

  std::unique_ptr<StressIntegration> apart() const override { return nodal_integration(s_, scratches_); }

  StressSums stresses(const StressTask& task, Index tile, TileScratch& scratch) override {
    const double contact = add_tile_bonds(s_, tile, task, scratch);
    StressSums sums = elastic_stresses(task, tile, scratch);
    report_stress(s_, tile, task.report, scratch);
    add_known_viscous_stress(s_, tile, task, scratch);
    sums.contact = contact + add_tile_boundary_bonds(s_, tile, task, scratch);
    return sums;
  }

 private:
  virtual StressSums elastic_stresses(const StressTask& task, Index tile, TileScratch& scratch) {
    return stress_sweep(s_, tile, task.F, task.history, task.viscous, task.dt, scratch);
  }
};

/// The same where laws see the mean change of volume around a particle: elastic stresses are known first.
class AveragedNodalIntegration : public NodalIntegration {
 public:
  AveragedNodalIntegration(const System& s, Scratches& scratches) : NodalIntegration(s, scratches), averaged_(s) {}

  StressSums gather(const StressTask& task) override { return averaged_.evaluate(task.F, task.history); }
  Mat3 law_deformation(std::size_t a, const Tensor& F) const override { return averaged_.law_deformation(a, F); }

 private:
  StressSums elastic_stresses(const StressTask& task, Index tile, TileScratch& scratch) override {
    return known_stress_sweep(s_, tile, task.F, averaged_.P(), task.viscous, task.dt, scratch);
  }

  AveragedStress averaged_;
};

}  // namespace

std::unique_ptr<StressIntegration> nodal_integration(const System& s, StressIntegration::Scratches& scratches) {
  if (s.average) return std::make_unique<AveragedNodalIntegration>(s, scratches);
  return std::make_unique<NodalIntegration>(s, scratches);
}

}  // namespace tessera
