#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "tessera/base/principal_axes.hpp"

namespace tessera {

/// What a law answers to a deformation.
struct ElasticResponse {
  double energy = 0.0;  // strain energy per reference volume [J/m3]
  Mat3 stress;          // first Piola-Kirchhoff [Pa]
};

/// First and second derivatives of the strain energy by the logarithms of the principal stretches [Pa]. The first are
/// the principal Kirchhoff stresses.
struct PrincipalDerivatives {
  Vec3 first;
  Mat3 second;
};

/// Bound of rho c^2 over all plane waves a (x) N, directions and rho of the reference state, in an isotropic solid
/// whose principal stretches are l [Pa]; exact at rest. In principal axes a wave has the modulus
///
///     sum_ij B_ij a_i N_i a_j N_j + sum_{i != j} A_ij a_i^2 N_j^2,
///
/// B_ii = W_ii, B_ij = W_ij + A'_ij, with A_ij = A_ijij and A'_ij = A_ijji of d2W/dF2 (Ogden, Non-linear Elastic
/// Deformations, 1984, section 6.1). Since a_i N_i a_j N_j is at most half of a_i^2 N_j^2 + a_j^2 N_i^2, that is a mean
/// of W_ii and A_ij + |B_ij| with the weights a_i^2 N_j^2.
inline double principal_wave_modulus(const Vec3& l, const PrincipalDerivatives& d) {
  constexpr double equal = 1e-5;  // relative difference of stretches below which quotients are derivatives
  const auto W_1 = [&](int i) { return d.first[i] / l[i]; };
  const auto W_2 = [&](int i, int j) { return (d.second(i, j) - (i == j ? d.first[i] : 0.0)) / (l[i] * l[j]); };
  double largest = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) largest = std::max(largest, W_2(i, i));
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < i; ++j) {
      const double difference = l[i] - l[j];
      const double sum = (W_1(i) + W_1(j)) / (l[i] + l[j]);  // A_ij - A'_ij
      const double quotient = std::abs(difference) > equal * l[i]
                                  ? (W_1(i) - W_1(j)) / difference
                                  : 0.5 * (W_2(i, i) + W_2(j, j)) - W_2(i, j);  // A_ij + A'_ij
      largest = std::max(largest, 0.5 * (quotient + sum) + std::abs(W_2(i, j) + 0.5 * (quotient - sum)));
    }
  return largest;
}

/// Principal stretches of a deformation.
inline Vec3 principal_stretches(const Mat3& F) {
  const Vec3 squares = principal_axes(transpose(F) * F).values;
  return {std::sqrt(squares.x), std::sqrt(squares.y), std::sqrt(squares.z)};
}

}  // namespace tessera
