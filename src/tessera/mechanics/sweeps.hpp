#pragma once

#include <limits>

#include "tessera/mechanics/kernel_types.hpp"
#include "tessera/mechanics/system.hpp"

namespace tessera {

/// What a stress sweep adds up on the way.
struct StressSums {
  double internal = 0.0;    // sum V_a U(F_a) [J]
  double contact = 0.0;     // sum of the bonds' energies [J]
  double dissipated = 0.0;  // viscous work since the last evaluation [J]
  double smallest_J = std::numeric_limits<double>::infinity();
  bool finite = true;  // no J was NaN

  StressSums& operator+=(const StressSums& o);
};

/// Data of the viscous stress; only allocated when a material is viscous.
struct ViscousMemory {
  Field<Columns> F_previous;  // F_a one step ago
  Field<Columns> P_previous;  // viscous stress one step ago [Pa]
};

/// The three sweeps over the particles [begin, end). Each writes only what belongs to these particles.
/// Sweep 1: F_a = (1/V_a) sum_b x_ab (x) B_ab, [D 32], [V 6], boundary nodes left out.
void strain_sweep(const System& s, const Double4* x, Columns* F, Index begin, Index end);

/// Sweep 2, for particles of one material: T_a = P(F_a) + Q_a, where Q_a = (1/2V_a) sum_b dU_ab/dy_ab (x) X_ab is the
/// contact stress, and f_a = sum_b dU_ab/dx_ab. `dt` is the time since the last evaluation (viscosity), zero at the
/// first one.
struct StressSweep {
  const System& s;
  const Double4* x;
  const Columns* F;
  Columns* T;  // total stress, or the contact stress alone when P is given
  Columns* P;  // null, or where the (elastic and viscous) stress goes
  Double4* f;
  ViscousMemory* viscous;  // null: no viscosity
  double dt;

  StressSums operator()(const Material& material, Index begin, Index end) const;
};

/// Sweep 3: f_a -= T_a B_aa + sum_b T_b B_ba, [D 45], [V 41].
void force_sweep(const Bonds& bonds, const Vec3* B_ba, const Vec3* B_aa, const Columns* T, Double4* f, Index begin,
                 Index end);

}  // namespace tessera
