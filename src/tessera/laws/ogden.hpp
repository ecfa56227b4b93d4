#pragma once

#include <vector>

#include "tessera/laws/principal.hpp"
#include "tessera/laws/volumetric.hpp"

namespace tessera {

/// One term of an Ogden solid.
struct OgdenTerm {
  double mu = 0.0;     // [Pa]
  double alpha = 0.0;  // exponent, not zero
};

/// Compressible Ogden solid (Ogden, Proceedings of the Royal Society A 326 (1972) 565-584),
///
///     U = sum_p mu_p / alpha_p (l_1^alpha_p + l_2^alpha_p + l_3^alpha_p - 3) + K/4 (J^2 - 1 - 2 ln J),
///
/// with the isochoric principal stretches l_i = J^(-1/3) lambda_i.
struct Ogden {
  std::vector<OgdenTerm> terms;
  VolumetricEnergy volumetric;

  /// Shear modulus at rest [Pa].
  double shear_modulus() const {
    double twice = 0.0;
    for (const OgdenTerm& t : terms) twice += t.mu * t.alpha;
    return 0.5 * twice;
  }

  double energy(const Mat3& F) const { return response(F).energy; }
  Mat3 stress(const Mat3& F) const { return response(F).stress; }

  /// U and P = F sum_i (tau_i / lambda_i^2) N_i (x) N_i with the principal Kirchhoff stresses tau. Needs det F > 0.
  ElasticResponse response(const Mat3& F) const {
    const PrincipalAxes C = principal_axes(transpose(F) * F);
    const double J = determinant(F), ln_J = std::log(J);
    double energy = volumetric.energy(J);
    Vec3 tau;
    for (int i = 0; i < 3; ++i) tau[i] = volumetric.stress(J);
    for (const OgdenTerm& t : terms) {
      const Vec3 power = powers(t.alpha, C.values, ln_J);
      energy += t.mu / t.alpha * (power.x + power.y + power.z - 3.0);
      for (int i = 0; i < 3; ++i) tau[i] += t.mu * (power[i] - mean(power));
    }
    return {energy, F * from_axes({tau.x / C.values.x, tau.y / C.values.y, tau.z / C.values.z}, C.vectors)};
  }

  double plane_wave_modulus() const { return volumetric.bulk + 4.0 / 3.0 * shear_modulus(); }

  /// Bound of rho c^2 over all plane waves about F [Pa]. Needs det F > 0.
  double wave_modulus(const Mat3& F) const {
    const Vec3 squares = principal_axes(transpose(F) * F).values;
    const double J = determinant(F);
    PrincipalDerivatives d;
    for (int i = 0; i < 3; ++i) {
      d.first[i] = volumetric.stress(J);
      for (int j = 0; j < 3; ++j) d.second(i, j) = volumetric.stiffness(J);
    }
    for (const OgdenTerm& t : terms) {
      const Vec3 power = powers(t.alpha, squares, std::log(J));
      const double m = mean(power);
      for (int i = 0; i < 3; ++i) {
        d.first[i] += t.mu * (power[i] - m);
        for (int j = 0; j < 3; ++j)
          d.second(i, j) += t.mu * t.alpha * ((i == j ? power[i] : 0.0) - (power[i] + power[j] - m) / 3.0);
      }
    }
    const Vec3 l{std::sqrt(squares.x), std::sqrt(squares.y), std::sqrt(squares.z)};
    return std::max(principal_wave_modulus(l, d), 1e-3 * plane_wave_modulus());
  }

 private:
  static double mean(const Vec3& v) { return (v.x + v.y + v.z) / 3.0; }

  /// l_i^alpha of the isochoric stretches.
  static Vec3 powers(double alpha, const Vec3& squares, double ln_J) {
    const auto power = [&](double square) { return std::exp(alpha * (0.5 * std::log(square) - ln_J / 3.0)); };
    return {power(squares.x), power(squares.y), power(squares.z)};
  }
};

}  // namespace tessera
