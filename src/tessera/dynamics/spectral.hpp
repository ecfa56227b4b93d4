#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "tessera/dynamics/vectors.hpp"
#include "tessera/mechanics/forces.hpp"
#include "tessera/mechanics/state.hpp"

namespace tessera {

/// How much an estimate may cost and how sharp it must be.
struct Effort {
  int evaluations = 81;     // of the forces, at most
  double tolerance = 2e-3;  // between the estimate of omega^2 and the bound that is returned, relative
  double enough = 0.0;      // a bound below this frequency [1/s] need not be sharper
  /// Evaluations per frequency [s]: no more than this times omega_max, which is known better and better as the
  /// iteration goes on. The number of steps of a run is proportional to omega_max, and so is what it may cost.
  double evaluations_per_frequency = std::numeric_limits<double>::infinity();
};

/// Largest angular frequency of a system about a deformed state, from the linearised elastic forces. Keeps its last
/// vector, so a later estimate of a similar state starts close to the answer.
class SpectralEstimator {
 public:
  /// `mass` is what moves with each particle [kg]; without it the particles' own.
  explicit SpectralEstimator(const System& system) : SpectralEstimator(system, system.mass) {}
  SpectralEstimator(const System& system, std::span<const double> mass) : system_(system), mass_(mass) {}

  /// omega_max [1/s]: a bound from above up to the accuracy of the iteration (about one per cent where the effort
  /// allows it to settle, and on the safe side where it does not). `walls` are the boundary nodes' prescribed points;
  /// `L` a length over which the forces are nearly linear, such as the shortest bond [m].
  double largest_frequency(const State& state, std::span<const Vec3> walls, double L, const Effort& effort = {});

  /// What a resumed run must put back to repeat the same bits: the last vector and the evaluations so far.
  struct Memory {
    Field<Double4> vector;
    std::int64_t evaluations = 0;
  };
  const Memory& memory() const { return memory_; }
  void restore(Memory memory) { memory_ = std::move(memory); }

  /// Fewest evaluations of an estimate, whatever the effort: with fewer the bound may lie some per cent too low.
  static constexpr int fewest_evaluations = 6;

 private:
  Vectors start_vector(const class LinearisedForces& K) const;

  const System& system_;
  std::span<const double> mass_;
  Memory memory_;
};

}  // namespace tessera
