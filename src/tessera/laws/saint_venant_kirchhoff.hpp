#pragma once

#include "tessera/laws/principal.hpp"

namespace tessera {

/// Saint Venant-Kirchhoff solid, U = lambda/2 (tr E)^2 + mu E:E with E = (F^T F - I)/2. For large rotations and small
/// strains: under compression it softens, and below a stretch of 1/sqrt 3 it has no stiffness left.
struct SaintVenantKirchhoff {
  double lambda = 0.0;  // first Lame parameter [Pa]
  double mu = 0.0;      // shear modulus [Pa]

  static constexpr SaintVenantKirchhoff from_young_poisson(double young, double poisson) {
    return {poisson * young / ((1.0 + poisson) * (1.0 - 2.0 * poisson)), young / (2.0 * (1.0 + poisson))};
  }

  double energy(const Mat3& F) const { return response(F).energy; }
  Mat3 stress(const Mat3& F) const { return response(F).stress; }

  /// U and P = F S with S = lambda tr E I + 2 mu E.
  ElasticResponse response(const Mat3& F) const {
    const Mat3 E = 0.5 * (transpose(F) * F - identity());
    const double tr = trace(E);
    return {0.5 * lambda * tr * tr + mu * contract(E, E), F * (2.0 * mu * E) + (lambda * tr) * F};
  }

  constexpr double plane_wave_modulus() const { return lambda + 2.0 * mu; }

  /// Bound of rho c^2 over all plane waves about F [Pa]; not below a thousandth of that at rest, where compression has
  /// taken all stiffness.
  double wave_modulus(const Mat3& F) const {
    const Vec3 l = principal_stretches(F);
    const Vec3 square{l.x * l.x, l.y * l.y, l.z * l.z};
    const double tr = 0.5 * (square.x + square.y + square.z - 3.0);
    PrincipalDerivatives d;
    for (int i = 0; i < 3; ++i) {
      d.first[i] = square[i] * (lambda * tr + mu * (square[i] - 1.0));
      for (int j = 0; j < 3; ++j) d.second(i, j) = lambda * square[i] * square[j];
      d.second(i, i) += 2.0 * d.first[i] + 2.0 * mu * square[i] * square[i];
    }
    return std::max(principal_wave_modulus(l, d), 1e-3 * plane_wave_modulus());
  }
};

}  // namespace tessera
