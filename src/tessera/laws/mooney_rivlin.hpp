#pragma once

#include "tessera/laws/ogden.hpp"

namespace tessera {

/// Compressible Mooney-Rivlin solid,
///
///     U = c10 (I_1 J^(-2/3) - 3) + c01 (I_2 J^(-4/3) - 3) + K/4 (J^2 - 1 - 2 ln J),
///
/// with the invariants I_1 = F:F and I_2 = cof F : cof F of F^T F.
struct MooneyRivlin {
  double c10 = 0.0;  // [Pa]
  double c01 = 0.0;  // [Pa]
  VolumetricEnergy volumetric;

  /// Shear modulus at rest [Pa].
  constexpr double shear_modulus() const { return 2.0 * (c10 + c01); }

  double energy(const Mat3& F) const { return response(F).energy; }
  Mat3 stress(const Mat3& F) const { return response(F).stress; }

  /// U and P = dU/dF. Needs det F > 0.
  ElasticResponse response(const Mat3& F) const {
    const Mat3 cof = cofactor(F);
    const double J = F(0, 0) * cof(0, 0) + F(0, 1) * cof(0, 1) + F(0, 2) * cof(0, 2);
    const double I_1 = contract(F, F), I_2 = contract(cof, cof);
    const double root = 1.0 / std::cbrt(J), a = c10 * root * root, b = c01 * root * root * root * root;
    const double pressure = volumetric.stress(J) - 2.0 / 3.0 * a * I_1 - 4.0 / 3.0 * b * I_2;
    return {(a * I_1 - 3.0 * c10) + (b * I_2 - 3.0 * c01) + volumetric.energy(J),
            (2.0 * (a + b * I_1)) * F - (2.0 * b) * (F * (transpose(F) * F)) + (pressure / J) * cof};
  }

  constexpr double plane_wave_modulus() const { return volumetric.bulk + 4.0 / 3.0 * shear_modulus(); }

  /// Bound of rho c^2 over all plane waves about F [Pa]: that of the Ogden solid with the exponents 2 and -2, which
  /// this is. Needs det F > 0.
  double wave_modulus(const Mat3& F) const {
    return Ogden{{{2.0 * c10, 2.0}, {-2.0 * c01, -2.0}}, volumetric}.wave_modulus(F);
  }
};

}  // namespace tessera
