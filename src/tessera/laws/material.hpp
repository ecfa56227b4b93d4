#pragma once

#include <cmath>
#include <string>
#include <variant>

#include "tessera/base/error.hpp"
#include "tessera/laws/j2_plasticity.hpp"
#include "tessera/laws/mooney_rivlin.hpp"
#include "tessera/laws/neo_hookean.hpp"
#include "tessera/laws/ogden.hpp"
#include "tessera/laws/saint_venant_kirchhoff.hpp"

namespace tessera {

/// Factors xi_n and xi_t of the bond stiffness, [D 60].
struct ContactFactors {
  double normal = 1.0;
  double tangential = 1.0;
};

/// Factors c1 and c2 of the artificial viscosity, [D 61].
struct ViscosityFactors {
  double linear = 0.0;
  double quadratic = 0.0;
};

/// Everything about a material that the mechanics needs.
struct Material {
  std::string name;
  std::string model = "neo-hookean";
  double young = 0.0;    // [Pa]
  double poisson = 0.0;  // [-]
  double density = 0.0;  // in the reference state [kg/m3]
  ContactFactors contact;
  ViscosityFactors viscosity;
  std::variant<NeoHookean, SaintVenantKirchhoff, MooneyRivlin, Ogden, J2Plasticity> law;
  Origin origin;

  bool plastic() const { return std::holds_alternative<J2Plasticity>(law); }
  double shear_modulus() const { return young / (2.0 * (1.0 + poisson)); }
  double plane_wave_modulus() const {
    return std::visit([](const auto& l) { return l.plane_wave_modulus(); }, law);
  }
  /// Longitudinal wave speed at rest [m/s], [D 55].
  double wave_speed() const { return std::sqrt(plane_wave_modulus() / density); }
};

}  // namespace tessera
