#pragma once

#include <algorithm>
#include <cmath>

#include "tessera/laws/principal.hpp"

namespace tessera {

/// Compressible neo-Hookean solid, [D 51-54], [V 48].
struct NeoHookean {
  double lambda = 0.0;  // first Lame parameter [Pa]
  double mu = 0.0;      // shear modulus [Pa]

  /// [D 54]
  static constexpr NeoHookean from_young_poisson(double young, double poisson) {
    return {poisson * young / ((1.0 + poisson) * (1.0 - 2.0 * poisson)), young / (2.0 * (1.0 + poisson))};
  }

  /// Strain energy per reference volume [J/m3], [D 51]. Needs det F > 0.
  double energy(const Mat3& F) const {
    const double ln_J = std::log(determinant(F));
    return 0.5 * lambda * ln_J * ln_J - mu * ln_J + 0.5 * mu * (contract(F, F) - 3.0);
  }

  /// First Piola-Kirchhoff stress dU/dF [Pa], [D 53]. Needs det F > 0.
  Mat3 stress(const Mat3& F) const {
    const double J = determinant(F);
    return ((lambda * std::log(J) - mu) / J) * cofactor(F) + mu * F;
  }

  /// Energy and stress together, which share the logarithm.
  ElasticResponse response(const Mat3& F) const {
    const Mat3 cof = cofactor(F);
    const double J = F(0, 0) * cof(0, 0) + F(0, 1) * cof(0, 1) + F(0, 2) * cof(0, 2);
    const double ln_J = std::log(J);
    return {ln_J * (0.5 * lambda * ln_J - mu) + 0.5 * mu * (contract(F, F) - 3.0),
            ((lambda * ln_J - mu) / J) * cof + mu * F};
  }

  /// Plane-wave modulus lambda + 2 mu [Pa]; rho c_p^2 in [D 55].
  constexpr double plane_wave_modulus() const { return lambda + 2.0 * mu; }

  /// Bound of rho c^2 over all plane waves about the deformation F, directions and rho of the reference state [Pa]:
  /// a wave a (x) N has mu + (lambda + mu - lambda ln J) (a . F^-T N)^2 with unit vectors a and N. Exact at rest and
  /// under uniaxial strain. Needs det F > 0.
  double wave_modulus(const Mat3& F) const {
    const Mat3 cof = cofactor(F);
    const double J = F(0, 0) * cof(0, 0) + F(0, 1) * cof(0, 1) + F(0, 2) * cof(0, 2);
    // First and second invariant of F^-1 F^-T, and a bound of its largest eigenvalue: the root of the characteristic
    // equation with the cosine in it set to one.
    const double first = contract(cof, cof) / (J * J), second = contract(F, F) / (J * J);
    const double largest = (first + 2.0 * std::sqrt(std::max(first * first - 3.0 * second, 0.0))) / 3.0;
    return mu + std::max(lambda + mu - lambda * std::log(J), 0.0) * largest;
  }
};

}  // namespace tessera
