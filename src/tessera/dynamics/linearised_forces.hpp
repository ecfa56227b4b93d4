#pragma once

#include <span>

#include "tessera/dynamics/vectors.hpp"
#include "tessera/mechanics/forces.hpp"
#include "tessera/mechanics/state.hpp"

namespace tessera {

/// M^-1/2 K M^-1/2 w by differences of the elastic forces about a state; prescribed components do not move. Each
/// product is one evaluation of the forces, and so is the construction.
class LinearisedForces {
 public:
  /// `mass` is what moves with each particle [kg]; `L` a length over which the forces are nearly linear [m].
  LinearisedForces(const System& system, std::span<const double> mass, const State& state, std::span<const Vec3> walls,
                   double L);

  std::size_t size() const { return mass_.size(); }

  /// Takes out of `w` what cannot move.
  void hold(Vectors& w) const;

  /// result = M^-1/2 K M^-1/2 w
  void apply(const Vectors& w, Vectors& result);

 private:
  const System& system_;
  std::span<const double> mass_;
  Forces forces_;
  const State& state_;
  State moved_;
  ExternalAction action_;
  double amplitude_;  // of the largest displacement [m]
  Vectors f_;         // at the state itself
};

}  // namespace tessera
