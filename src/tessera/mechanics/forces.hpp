#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "tessera/loads/tractions.hpp"
#include "tessera/mechanics/state.hpp"
#include "tessera/mechanics/stress_forces.hpp"
#include "tessera/mechanics/stress_integration.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

/// What acts on a system from outside at one time.
struct ExternalAction {
  std::span<const Vec3> walls;            // current position W_f of each boundary node's prescribed point [m]
  std::span<const NodalForce> tractions;  // [N]; a particle may occur several times
  Vec3 gravity;                           // [m/s2]
  Tractions* following = nullptr;         // adds its pressures that follow to `tractions`, which it holds
};

/// Forces as the gradient of the potential: fill the boundary nodes; strain tile by tile; stress as the integration
/// finds it, and force, tile by tile; drain the boundary nodes; add up. One object is kept and reused.
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

  /// [N], reactions on constrained particles left out. What evaluate() leaves for the end is added when somebody asks.
  const Field<Double4>& total() const;
  /// Calls body(first, last, total) for ranges of particles, in parallel, where `total` are the forces from that on
  /// `first` on. They come into being in the cache and leave no traces in memory.
  template <class Body>
  void for_ranges_of_total(Body&& body) const;

  const Field<Tensor>& deformation_gradient() const { return F_; }
  /// The deformation that the law sees at particle a: F_a, or with the mean change of volume around it.
  Mat3 law_deformation(std::size_t a) const { return integration_->law_deformation(a, F_[a]); }
  const std::vector<Vec3>& reactions() const { return reactions_; }  // force on what prescribes each node [N]
  const StressSums& sums() const { return sums_; }                   // of the last evaluation

  /// P_a of every particle (the mean over its stress points) with its viscous part [Pa], and what it exerts on the
  /// particles [N] (reactions of boundary faces included).
  struct Internal {
    RawField<Tensor> P;
    Field<Double4> force;
    std::vector<double> energy;  // mean of the stored energy over each cell [J/m3]; empty where it is that of F_a
    std::unique_ptr<StressForces> memory;  // for the next time
  };
  /// For output, at the state of the last evaluation. Uses the memory of `result` again.
  void find_internal(const State& state, Internal& result) const;
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
  void add_tractions(const State& state, const ExternalAction& action);
  void complete(Index first, Index last, Double4* total) const;
  StressTask once_more(const State& state, const CellReport& report) const;

  const System& system_;
  mutable StressIntegration::Scratches scratches_;
  std::unique_ptr<StressIntegration> integration_;
  Field<Tensor> F_;
  mutable StressForces forces_;
  Vec3 gravity_;
  mutable std::atomic<bool> incomplete_{false};  // rims are to be collected, gravity is to be added
  mutable std::mutex completing_;
  std::vector<Vec3> reactions_;
  ViscousMemory viscous_;
  Flow flow_;
  Field<PlasticState> history_after_;
  StressSums sums_;
};

template <class Body>
void Forces::for_ranges_of_total(Body&& body) const {
  const std::lock_guard lock(completing_);
  const bool incomplete = incomplete_;
  parallel::for_ranges(0, system_.particles(), [&](std::int64_t begin, std::int64_t end) {
    const auto first = static_cast<Index>(begin), last = static_cast<Index>(end);
    if (!incomplete) {
      body(first, last, forces_.f().data() + first);
      return;
    }
    constexpr Index piece = 256;  // its forces stay in the first-level cache
    Double4 total[piece];
    for (Index a = first; a < last; a += piece) {
      complete(a, std::min(a + piece, last), total);
      body(a, std::min(a + piece, last), total);
    }
  });
}

}  // namespace tessera
