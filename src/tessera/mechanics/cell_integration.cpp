#include <cmath>

#include "tessera/mechanics/averaged_cells.hpp"
#include "tessera/mechanics/centroid_strain.hpp"
#include "tessera/mechanics/stress_forces.hpp"
#include "tessera/mechanics/stress_integration.hpp"
#include "tessera/mechanics/tile_nodes.hpp"

namespace tessera {

namespace {

/// Six points a cell (theory, section 11): their variation follows from the neighbours' F, which take a part of the
/// stress in turn.
class CellIntegration : public StressIntegration {
 public:
  CellIntegration(const System& s, Scratches& scratches) : StressIntegration(s, scratches) {
    cells_.T.resize(s.d.X.size());
    if (treats_stresses_apart(s)) cells_.P.resize(s.d.X.size());
    cells_.rim_energies.resize(s.tiles.rim.size());
    if (!s.d.measure->moved.particles.empty()) centroids_.emplace(s);
  }

  std::unique_ptr<StressIntegration> apart() const override { return cell_integration(s_, scratches_); }

  /// Stresses of all cells, and their part in those of the rims.
  StressSums gather(const StressTask& task) override {
    if (!centroids_) return gather_at(task, task.F);
    StressTask kept = task;
    if (kept.report.mean == nullptr) kept.report.mean = centroids_->stresses();
    const StressSums sums = gather_at(kept, centroids_->find(task.F));
    centroids_->give_back(kept.report.mean, own_stresses());
    return sums;
  }

  StressSums stresses(const StressTask& task, Index tile, TileScratch& scratch) override {
    recall(tile, scratch);
    add_known_viscous_stress(s_, tile, task, scratch);
    StressSums sums;
    sums.contact = add_tile_boundary_bonds(s_, tile, task, scratch);
    return sums;
  }

 protected:
  /// By F at the centroids of cells.
  virtual StressSums gather_at(const StressTask& task, const Tensor* at_centroids) {
    return sum_tiles(s_, scratches_, [&](Index tile, TileScratch& scratch) {
      const double contact = add_tile_bonds(s_, tile, task, scratch);
      if (task.bonds.f == nullptr) load_tile(s_, tile, task.x, task.F, scratch);
      StressSums sums = find_stresses(task, at_centroids, tile, scratch, {own_stresses(), cells_.rim_energies.data()});
      sums.contact = contact;
      if (stresses_apart()) keep_contact_stress(tile, scratch);
      return sums;
    });
  }

 private:
  virtual StressSums find_stresses(const StressTask& task, const Tensor* at_centroids, Index tile, TileScratch& scratch,
                                   const CellStress& stress) {
    return cell_stress_sweep(s_, tile, task.F, task.history, task.viscous, task.dt, scratch, stress, task.report,
                             at_centroids);
  }

  bool stresses_apart() const { return !cells_.P.empty(); }
  Tensor* own_stresses() { return stresses_apart() ? cells_.P.data() : cells_.T.data(); }

  void keep_contact_stress(Index tile, const TileScratch& scratch) {
    const Tile& t = tile_of(s_, tile);
    for (Index a = t.begin; a < t.end; ++a)
      cells_.T[static_cast<std::size_t>(a)] = to_tensor(scratch.T[static_cast<std::size_t>(a - t.begin)]);
  }

  void recall(Index tile, TileScratch& scratch) const {
    const Tensor* rims = cells_.rim_energies.data();
    if (!stresses_apart()) {
      complete_stresses(s_, tile, cells_.T.data(), rims, scratch.T.data());
      return;
    }
    complete_stresses(s_, tile, cells_.P.data(), rims, scratch.P.data());
    const Tile& t = tile_of(s_, tile);
    for (Index a = t.begin; a < t.end; ++a)
      scratch.T[static_cast<std::size_t>(a - t.begin)] = to_kernel(cells_.T[static_cast<std::size_t>(a)]);
  }

  CellMemory cells_;
  std::optional<CentroidStrain> centroids_;  // where some F_a belong elsewhere
};

/// The same where laws see the mean change of volume around a cell: the changes of volume of all cells and their
/// pressures are known first.
class AveragedCellIntegration : public CellIntegration {
 public:
  AveragedCellIntegration(const System& s, Scratches& scratches)
      : CellIntegration(s, scratches), J_(s.d.X.size()), Jbar_(J_), p_(J_), pbar_(J_), once_(J_) {}

  /// F_a with the mean change of volume that the law has seen in cell a.
  Mat3 law_deformation(std::size_t a, const Tensor& F) const override {
    const Mat3 F_a = to_mat3(F);
    return std::cbrt(Jbar_[a] / determinant(F_a)) * F_a;
  }

 private:
  StressSums gather_at(const StressTask& task, const Tensor* at_centroids) override {
    on_all_tiles(task,
                 [&](Index tile, TileScratch& scratch) { volume_sweep(s_, tile, at_centroids, scratch, J_.data()); });
    s_.average->mean_twice(J_, once_, Jbar_);
    on_all_tiles(task, [&](Index tile, TileScratch& scratch) {
      pressure_sweep(s_, tile, at_centroids, task.history, scratch, Jbar_.data(), p_.data());
    });
    s_.average->mean_twice(p_, once_, pbar_);
    return CellIntegration::gather_at(task, at_centroids);
  }

  template <class Body>
  void on_all_tiles(const StressTask& task, Body&& body) {
    parallel::for_tasks(s_.tiles.size(), [&](std::int64_t k) {
      const Scratches::Lease scratch(scratches_);
      const auto tile = static_cast<Index>(k);
      load_tile(s_, tile, task.x, task.F, *scratch);
      body(tile, *scratch);
    });
  }

  StressSums find_stresses(const StressTask& task, const Tensor* at_centroids, Index tile, TileScratch& scratch,
                           const CellStress& stress) override {
    return averaged_cell_stress_sweep(s_, tile, task.F, {Jbar_.data(), pbar_.data()}, task.history, task.viscous,
                                      task.dt, scratch, stress, task.report, at_centroids);
  }

  std::vector<double> J_, Jbar_;  // of cells, and its mean over the neighbours
  std::vector<double> p_, pbar_;  // mean Cauchy stress that the law gives in cells, and its mean [Pa]
  std::vector<double> once_;
};

}  // namespace

std::unique_ptr<StressIntegration> cell_integration(const System& s, StressIntegration::Scratches& scratches) {
  if (s.average) return std::make_unique<AveragedCellIntegration>(s, scratches);
  return std::make_unique<CellIntegration>(s, scratches);
}

}  // namespace tessera
