#pragma once

#include <span>
#include <vector>

#include "tessera/loads/loads.hpp"
#include "tessera/mechanics/forces.hpp"
#include "tessera/mechanics/state.hpp"

namespace tessera {

/// The lengths of the steps before and after the present time [s]; both zero when a state is only evaluated.
struct StepPair {
  double before = 0.0;
  double after = 0.0;
  double middle() const { return 0.5 * (before + after); }
};

/// Kick and drift with mass-proportional damping c, centred:
///
///     v+ = [(1 - c h/2) v- + h f/m] / (1 + c h/2),   h = (dt before + dt after)/2,   x+ = x + dt after v+
///
/// Velocities of a State are those of the half step before its positions; velocity() gives them at the positions' time.
/// Constrained particles (delaunay) take the velocity that brings them to their prescribed place.
class Leapfrog {
 public:
  /// `mass` is what moves with each particle [kg]; without it the particles' own.
  Leapfrog(const System& system, const Loads& loads, double damping, std::span<const double> mass);
  Leapfrog(const System& system, const Loads& loads, double damping) : Leapfrog(system, loads, damping, system.mass) {}

  /// Turns velocities at the start into those half a step before. Call after the first evaluation of the forces, with
  /// the loads' motion at the end of the first step. Constrained components start with their prescribed velocity.
  void start(State& state, const Forces& forces, double dt) const;

  /// Fixes the motion of constrained particles over the next step and the forces that this needs. The loads' motion
  /// must be at the end of that step.
  void prepare(const State& state, const Forces& forces, StepPair dt);

  /// v-, x -> v+, x+.
  void step(State& state, const Forces& forces, StepPair dt) const;

  /// Velocity of particle a at the time of the positions [m/s]; prepare() was called for this time.
  Vec3 velocity(const State& state, const Forces& forces, StepPair dt, Index a) const;

  /// Force of each constrained particle on what prescribes its motion [N], in the order of Discretization::constraints.
  const std::vector<Vec3>& reactions() const { return reactions_; }
  double damping() const { return damping_; }
  double mass(Index a) const { return mass_[static_cast<std::size_t>(a)]; }  // [kg]

 private:
  Double4 free_kick(const State& state, const Double4& force, double h, Index a) const;
  Vec3 constrained_velocity(const State& state, std::size_t i, double dt, const Vec3& free) const;

  const System& system_;
  const Loads& loads_;
  double damping_;
  std::span<const double> mass_;
  std::vector<Index> constraint_of_;  // of each particle, or -1; empty without constraints
  std::vector<Vec3> next_velocity_;   // v+ of each constrained particle
  std::vector<Vec3> reactions_;
};

}  // namespace tessera
