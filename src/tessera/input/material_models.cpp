#include "tessera/input/material_models.hpp"

#include <fmt/format.h>

namespace tessera::input {

namespace {

void set_young_poisson(Material& m, const Reader& t) {
  m.young = t.number("young");
  m.poisson = t.number("poisson");
}

/// Young's modulus and Poisson's ratio at rest, from which bonds take their stiffness.
void set_young_poisson(Material& m, double shear, double bulk) {
  m.young = 9.0 * bulk * shear / (3.0 * bulk + shear);
  m.poisson = (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear));
}

void check_shear_modulus(double shear, const Origin& origin, const char* what) {
  if (shear > 0.0) return;
  throw InputError(origin, fmt::format("the shear modulus at rest, {}, is {:g} Pa; it must be > 0", what, shear));
}

void set_neo_hookean(Material& m, const Reader& t) {
  set_young_poisson(m, t);
  m.law = NeoHookean::from_young_poisson(m.young, m.poisson);
}

void set_saint_venant_kirchhoff(Material& m, const Reader& t) {
  set_young_poisson(m, t);
  m.law = SaintVenantKirchhoff::from_young_poisson(m.young, m.poisson);
}

void set_mooney_rivlin(Material& m, const Reader& t) {
  const MooneyRivlin law{t.number("c10"), t.number("c01"), {t.number("bulk")}};
  check_shear_modulus(law.shear_modulus(), t.origin_of("c10"), "2 (c10 + c01)");
  set_young_poisson(m, law.shear_modulus(), law.volumetric.bulk);
  m.law = law;
}

void set_ogden(Material& m, const Reader& t) {
  Ogden law{{}, {t.number("bulk")}};
  for (const Reader& term : t.tables("terms")) {
    law.terms.push_back({term.number("mu"), term.number("alpha")});
    if (law.terms.back().alpha == 0.0)
      throw InputError(term.origin_of("alpha"), "found 0; an exponent must not be zero");
  }
  check_shear_modulus(law.shear_modulus(), t.origin_of("terms"), "half the sum of mu alpha");
  set_young_poisson(m, law.shear_modulus(), law.volumetric.bulk);
  m.law = std::move(law);
}

void set_j2_plasticity(Material& m, const Reader& t) {
  set_young_poisson(m, t);
  m.law = J2Plasticity::from_young_poisson(m.young, m.poisson, t.number("yield_stress"), t.number("hardening"));
}

constexpr MaterialModel models[] = {
    {"neo-hookean", "compressible neo-Hookean solid, U = lambda/2 (ln J)^2 - mu ln J + mu/2 (F:F - 3)",
     set_neo_hookean},
    {"saint-venant-kirchhoff", "U = lambda/2 (tr E)^2 + mu E:E, for large rotations and small strains",
     set_saint_venant_kirchhoff},
    {"mooney-rivlin",
     "compressible Mooney-Rivlin solid, U = c10 (I1 J^(-2/3) - 3) + c01 (I2 J^(-4/3) - 3) + K/4 (J^2 - 1 - 2 ln J)",
     set_mooney_rivlin},
    {"ogden",
     "compressible Ogden solid, U = sum mu/alpha (l1^alpha + l2^alpha + l3^alpha - 3) + K/4 (J^2 - 1 - 2 ln J) of the "
     "isochoric principal stretches l",
     set_ogden},
    {"j2-plasticity",
     "elastic-plastic solid at finite strain, Hencky's elasticity and von Mises' yield stress with isotropic hardening",
     set_j2_plasticity},
};

}  // namespace

std::span<const MaterialModel> material_models() { return models; }

}  // namespace tessera::input
