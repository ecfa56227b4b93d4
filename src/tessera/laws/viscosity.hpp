#pragma once

#include <cmath>

#include "tessera/base/mat3.hpp"
#include "tessera/laws/material.hpp"

namespace tessera {

/// Artificial viscosity of one particle: what does not change during a run.
struct ViscosityLaw {
  double linear = 0.0;     // rho c1 c_p h [Pa s]
  double quadratic = 0.0;  // rho c2 h^2 [Pa s2]
};

/// `h` is the particle's shortest bond [m].
inline ViscosityLaw viscosity_law(const Material& m, double h) {
  return {m.density * m.viscosity.linear * m.wave_speed() * h, m.density * m.viscosity.quadratic * h * h};
}

/// Viscous first Piola-Kirchhoff stress J sigma F^-T, [D 61, 62], for the rate F_dot [1/s]. J F^-T is the cofactor of
/// F.
inline Mat3 viscous_stress(const ViscosityLaw& law, const Mat3& F, const Mat3& F_dot) {
  const Mat3 cof = cofactor(F);
  const Mat3 l = (1.0 / determinant(F)) * (F_dot * transpose(cof));
  const Mat3 d = 0.5 * (l + transpose(l));
  return (law.linear + law.quadratic * std::abs(trace(d))) * (d * cof);
}

}  // namespace tessera
