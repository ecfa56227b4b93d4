#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "tessera/dynamics/leapfrog.hpp"
#include "tessera/dynamics/ledger.hpp"
#include "tessera/dynamics/time_step.hpp"
#include "tessera/output/checkpoint.hpp"
#include "tessera/output/snapshot.hpp"
#include "tessera/simulation/inertia.hpp"
#include "tessera/simulation/model.hpp"

namespace tessera {

/// A model in motion. One round of the loop is
///
///     prepare()   choose the step, move what is prescribed, settle the accounts: the present state can be observed
///     advance()   kick, drift, forces at the new time
///
/// checkpoint() belongs between advance() and prepare().
class Engine {
 public:
  /// Puts the model into its initial state and evaluates the forces. Throws InputError for a fixed step above the limit
  /// and RunError when the initial state is no good.
  Engine(Model& model, const TimeSpec& spec);

  bool finished() const { return time_ >= spec_.end; }
  void prepare();
  void advance();

  double time() const { return time_; }         // [s]
  std::int64_t steps() const { return step_; }  // done
  double dt() const { return dt_.after; }       // of the step to come (or of the last one at the end) [s]
  const StepControl& step_control() const { return control_; }
  const std::optional<MassScaling>& mass_scaling() const { return mass_scaling_; }
  /// Largest share of the kinetic energy in the sum of kinetic, strain and contact energy at the looks at the energy
  /// after the first tenth of the run: what a quasi-static run keeps small.
  double largest_kinetic_share() const { return largest_kinetic_share_; }

  // Observations; prepare() was called for this time.
  EnergyLedger energies() const;
  Momentum momentum() const;
  const Momentum& initial_momentum() const { return initial_momentum_; }
  Snapshot snapshot() const;
  /// Present positions in the order in memory, boundary nodes after the particles [m].
  const Field<Double4>& present_positions() const { return state_.x; }
  /// Snapshots of parts; valid until the engine moves on.
  SnapshotSource snapshots() const;
  /// Force on what prescribes the motion of each boundary node (voronoi) or constrained particle (delaunay) [N].
  const std::vector<Vec3>& reactions() const;
  /// Where reaction number i acts: the boundary node's present place on the wall, or the particle's [m].
  Vec3 reaction_point(std::size_t i) const;
  /// Largest force on a particle, components without prescribed motion only [N].
  double largest_force() const;

  /// Throws RunError (step, time, particle, position, reason) when the state is not finite, a cell is inverted, or the
  /// energy grows out of the ledger.
  void verify_deformation() const;
  void verify_energy();

  Checkpoint checkpoint() const;
  /// Goes back to a checkpoint of the same model. Throws InputError when it belongs to another one.
  void restore(const Checkpoint& checkpoint);

 private:
  void evaluate(double dt);
  Momentum to_momentum(const Motion& motion) const { return {motion.linear, motion.angular}; }
  Motion motion() const;
  double stored_energy() const;
  [[noreturn]] void fail(Index particle, const std::string& reason) const;
  void check_same_model(const Checkpoint& c) const;
  struct Observation;
  mutable std::shared_ptr<Observation> seen_;  // the last one: its memory serves the next
  void take_snapshot(const Observation& seen, Index begin, Index end, Snapshot& shot) const;

  Model& model_;
  TimeSpec spec_;
  State state_;
  Field<Double4> x0_;  // positions at the start, where the work of gravity begins; empty without it
  std::optional<MassScaling> mass_scaling_;
  Forces forces_;
  Leapfrog leapfrog_;
  Ledger ledger_;
  StepControl control_;
  std::vector<Vec3> walls_;  // prescribed points at the present time
  double time_ = 0.0;
  std::int64_t step_ = 0;
  StepPair dt_;
  bool started_ = false;  // velocities are half a step behind
  double initial_energy_ = 0.0;
  Momentum initial_momentum_;
  double energy_scale_ = 0.0, negligible_energy_ = 0.0;
  double largest_kinetic_share_ = 0.0;
  double largest_contact_ = 0.0, largest_strain_ = 0.0;
};

}  // namespace tessera
