#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tessera/loads/tractions.hpp"
#include "tessera/mechanics/averaged_cubature.hpp"
#include "tessera/mechanics/averaged_stress.hpp"
#include "tessera/mechanics/cell_sweeps.hpp"
#include "tessera/mechanics/kernel_types.hpp"
#include "tessera/mechanics/state.hpp"
#include "tessera/mechanics/sweeps.hpp"
#include "tessera/mechanics/system.hpp"
#include "tessera/parallel/workspaces.hpp"

namespace tessera {

/// What acts on a system from outside at one time.
struct ExternalAction {
  std::span<const Vec3> walls;            // current position W_f of each boundary node's prescribed point [m]
  std::span<const NodalForce> tractions;  // [N]; a particle may occur several times
  Vec3 gravity;                           // [m/s2]
  Tractions* following = nullptr;         // adds its pressures that follow to `tractions`, which it holds
};

/// Forces as the gradient of the potential: fill the boundary nodes; strain tile by tile; stress and force tile by
/// tile; drain the boundary nodes; add up. With cell integration stresses are complete only when all tiles have theirs,
/// so forces are a pass of their own; with second-order integration second derivatives follow from strains and act on
/// them, and the same backwards before forces. One object is kept and reused.
class Forces {
 public:
  explicit Forces(const System& system, Flow flow = Flow::allowed);

  /// Evaluates everything at the state's positions; the state's boundary nodes are filled on the way. `dt` is the time
  /// since the last evaluation, from which viscous stresses take their rate; zero: no rate is known, no viscous stress.
  void evaluate(State& state, const ExternalAction& action, double dt);

  /// Makes the histories that the last evaluation has found those of the state, once it has come to stay: evaluations
  /// on trial leave them alone. Call it once, before the state moves on.
  void commit(State& state) { std::swap(state.plastic, history_after_); }
  /// The histories that the last evaluation has found; empty when nothing can flow.
  const Field<PlasticState>& plastic() const { return history_after_; }
  Index stress_points() const { return system_.stress_points; }

  const Field<Double4>& total() const { return f_; }  // [N], reactions on constrained particles left out
  const Field<Tensor>& deformation_gradient() const { return F_; }
  /// The deformation that the law sees at particle a: F_a, or with the mean change of volume around it.
  Mat3 law_deformation(std::size_t a) const {
    if (averaged_) return averaged_->law_deformation(a, F_[a]);
    if (averaged_cells_) return averaged_cells_->law_deformation(a, F_[a]);
    if (averaged_points_) return averaged_points_->law_deformation(a, F_[a]);
    return to_mat3(F_[a]);
  }
  const std::vector<Vec3>& reactions() const { return reactions_; }  // force on what prescribes each node [N]
  const StressSums& sums() const { return sums_; }                   // of the last evaluation

  /// P_a of every particle (the mean over its stress points) with its viscous part [Pa], and what it exerts on the
  /// particles [N] (reactions of boundary faces included). For output, at the state of the last evaluation.
  struct Internal {
    Field<Tensor> P;
    Field<Double4> force;
    std::vector<double> energy;  // mean of the stored energy over each cell [J/m3]; empty where it is that of F_a
  };
  Internal internal(const State& state) const;

  /// The smallest det F in each particle's cell: of its mean F, or of its stress points, at the state of the last
  /// evaluation.
  std::vector<double> smallest_J(const State& state) const;

  /// The deformation one step ago, from which viscous stresses take their rate; empty without viscosity.
  const Field<Tensor>& previous_deformation() const { return viscous_.F_previous; }
  /// Puts it back before the state of a checkpoint is evaluated again.
  void restore_previous_deformation(Field<Tensor> F);

 private:
  void strain(State& state, const ExternalAction& action);
  StressSums averaged_stresses(const State& state);
  StressSums tile_forces(Index tile, const State& state, double dt);
  StressSums cell_stresses(Index tile, const State& state, double dt);
  StressSums cell_forces(Index tile, const State& state);
  void recall(Index tile, const CellMemory& cells, TileScratch& scratch) const;
  StressSums elastic_stress(Index tile, const HistorySpan& history, ViscousMemory* viscous, double dt,
                            TileScratch& scratch) const;
  double boundary_forces(Index tile, const State& state, TileScratch& scratch);
  void hand_on(Index tile, TileScratch& scratch);
  StressSums curved_stresses(Index tile, const State& state, double dt);
  StressSums curved_forces(Index tile);
  void report_curved(const State& state, const CellReport& report, SecondOrderMemory& memory) const;
  void drain();
  void finish(const State& state, const ExternalAction& action);
  /// Boundary nodes or rows treat the elastic stress and the contact stress differently ([V 42, 43]).
  bool split() const { return split_; }
  /// Cells are integrated tile by tile, so that their stresses are complete when all tiles have theirs.
  bool cells_by_tile() const { return system_.gradients && !system_.average; }

  const System& system_;
  bool split_;
  Field<Tensor> F_;
  Field<Double4> f_, R_;
  Field<Double4> rim_f_, rim_f_direct_;  // what tiles do to their rims; the second for the rows of [V 42]
  Field<Columns> owners_P_;              // P of each owner of boundary nodes, when split()
  mutable parallel::Workspaces<TileScratch> scratch_;
  std::vector<Vec3> reactions_;
  ViscousMemory viscous_;
  Flow flow_;
  Field<PlasticState> history_after_;
  CellMemory cells_;
  // Where laws see a mean change of volume, one of them: nodal, cell and second-order integration.
  std::optional<AveragedStress> averaged_;
  std::optional<AveragedCells> averaged_cells_;
  std::optional<AveragedCubature> averaged_points_;
  SecondOrderMemory curved_;  // empty but for second-order integration
  StressSums sums_;
};

}  // namespace tessera
