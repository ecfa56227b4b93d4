#include "tessera/mechanics/averaged_cubature.hpp"
#include "tessera/mechanics/boundary.hpp"
#include "tessera/mechanics/curved_sweep.hpp"
#include "tessera/mechanics/stress_integration.hpp"
#include "tessera/mechanics/tile_nodes.hpp"

namespace tessera {

namespace {

/// Second derivatives of the motion put faces into their places and say how F varies within a cell (theory, section
/// 12). They act back through every stress, so all must be known before any acts on particles.
class SecondOrderIntegration : public StressIntegration {
 public:
  SecondOrderIntegration(const System& s, Scratches& scratches) : StressIntegration(s, scratches), curved_(s) {}

  std::unique_ptr<StressIntegration> apart() const override {
    auto other = second_order_integration(s_, scratches_);
    static_cast<SecondOrderIntegration&>(*other).curved_.weighted = curved_.weighted;
    return other;
  }

  void find_strain(const Double4* x, Tensor* F) override { tessera::find_strain(s_, x, curved_, F); }

  StressSums gather(const StressTask& task) override {
    StressSums sums = prepare_points(task);
    sums +=
        sum_tiles(s_, scratches_, [&](Index tile, TileScratch& scratch) { return gather_tile(task, tile, scratch); });
    return_gradients(*s_.second_order, s_.d.volume.data(), curved_);
    add_surface_moments(s_, curved_);
    return sums;
  }

  /// Only those of owners of boundary nodes are asked for.
  StressSums stresses(const StressTask& /*task*/, Index tile, TileScratch& scratch) override {
    for_each_owner(s_, tile, [&](Index /*k*/, Index a) {
      scratch.T[static_cast<std::size_t>(a - tile_of(s_, tile).begin)] =
          to_kernel(curved_.T[static_cast<std::size_t>(a)]);
    });
    return {};
  }

  void act(Index tile, const TileScratch& /*scratch*/, Double4* f, Double4* rim_f) const override {
    add_forces(s_, tile, curved_, f, rim_f);
  }

 protected:
  /// What must be known of all points before the stresses of any.
  virtual StressSums prepare_points(const StressTask& task) {
    find_unresolved_strains(*s_.second_order, task.F, curved_);
    return {};
  }

  virtual StressSums elastic_stresses(const StressTask& task, Index tile, TileScratch& scratch) {
    return curved_stress_sweep(s_, tile, task.F, task.history, task.viscous, task.dt, scratch, curved_, task.report);
  }

  SecondOrderMemory curved_;

 private:
  StressSums gather_tile(const StressTask& task, Index tile, TileScratch& scratch) {
    const Tile& t = tile_of(s_, tile);
    const double contact = add_tile_bonds(s_, tile, task, scratch);
    StressSums sums = elastic_stresses(task, tile, scratch);
    add_known_viscous_stress(s_, tile, task, scratch);
    sums.contact = contact + add_tile_boundary_bonds(s_, tile, task, scratch);
    for (Index a = t.begin; a < t.end; ++a)
      curved_.T[static_cast<std::size_t>(a)] = to_tensor(scratch.T[static_cast<std::size_t>(a - t.begin)]);
    return sums;
  }
};

/// The same where laws see the mean change of volume around a cell: elastic stresses are known first.
class AveragedSecondOrderIntegration : public SecondOrderIntegration {
 public:
  AveragedSecondOrderIntegration(const System& s, Scratches& scratches)
      : SecondOrderIntegration(s, scratches), averaged_(s) {}

  Mat3 law_deformation(std::size_t a, const Tensor& F) const override { return averaged_.law_deformation(a, F); }

 private:
  StressSums prepare_points(const StressTask& task) override {
    find_unresolved_strains(*s_.second_order, task.F, curved_);
    find_point_strains(*s_.second_order, curved_);
    const StressSums sums = averaged_.evaluate(task.F, curved_.points.data(), task.history, task.report);
    take_point_moments(*s_.second_order, curved_);
    return sums;
  }

  StressSums elastic_stresses(const StressTask& task, Index tile, TileScratch& scratch) override {
    return known_stress_sweep(s_, tile, task.F, averaged_.P(), task.viscous, task.dt, scratch);
  }

  AveragedCubature averaged_;
};

}  // namespace

std::unique_ptr<StressIntegration> second_order_integration(const System& s, StressIntegration::Scratches& scratches) {
  if (s.average) return std::make_unique<AveragedSecondOrderIntegration>(s, scratches);
  return std::make_unique<SecondOrderIntegration>(s, scratches);
}

}  // namespace tessera
