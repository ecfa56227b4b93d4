#pragma once

#include <span>
#include <vector>

#include "tessera/mechanics/forces.hpp"
#include "tessera/mechanics/state.hpp"

namespace tessera {

/// Largest angular frequency of a system about a deformed state, from the linearised elastic forces. Keeps its last
/// vector, so a later estimate of a similar state starts close to the answer.
class SpectralEstimator {
 public:
  explicit SpectralEstimator(const System& system) : system_(system) {}

  /// omega_max [1/s]: a bound from above up to the accuracy of the iteration (about one per cent). `walls` are the
  /// boundary nodes' prescribed points; `L` a length over which the forces are nearly linear, such as the shortest bond
  /// [m].
  double largest_frequency(const State& state, std::span<const Vec3> walls, double L);

  /// The last vector, which a resumed run must put back to repeat the same bits.
  Field<Double4>& vector() { return vector_; }
  const Field<Double4>& vector() const { return vector_; }

 private:
  double lanczos(class LinearisedForces& K);
  double power_iteration(class LinearisedForces& K);

  const System& system_;
  Field<Double4> vector_;
};

}  // namespace tessera
