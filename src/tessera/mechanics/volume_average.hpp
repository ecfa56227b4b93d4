#pragma once

#include <span>
#include <vector>

#include "tessera/base/field.hpp"
#include "tessera/base/index.hpp"
#include "tessera/discretization/discretization.hpp"

namespace tessera {

/// Where a law takes the change of volume from: the particle alone, or a mean over it and its neighbours.
enum class Volumetric { standard, averaged };

/// The mean over a particle and its neighbours, with weights that are fixed in the reference state:
///
///     mean_a = value_a + sum_b (M_ab / V_a) (value_b - value_a),   M_ab = c_a c_b A_ab / L_ab,
///
/// with factors c that make sum_b M_ab half of V_a, as nearly as can be. Constants are their own mean; as M is
/// symmetric, sums of V_a value_a are kept, and the transposed operation is the same one. What alternates between
/// neighbours has the mean zero.
struct VolumeAverage {
  std::vector<Offset> offset{0};
  RawField<Index> neighbour;
  RawField<double> weight;  // M_ab / V_a of each bond

  /// The mean, taken twice: once leaves half of what alternates from layer to layer. `once` holds the first one.
  void mean_twice(const std::vector<double>& values, std::vector<double>& once,
                  std::vector<double>& mean_of_means) const;
};

/// The weights of a discretization that still has its bonds.
VolumeAverage volume_average(const Discretization& d);

}  // namespace tessera
