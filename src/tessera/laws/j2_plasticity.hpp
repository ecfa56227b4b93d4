#pragma once

#include <limits>

#include "tessera/laws/plastic_state.hpp"
#include "tessera/laws/principal.hpp"

namespace tessera {

/// Elastic-plastic solid at finite strain: F = F_e F_p, the energy U_e = K/2 (tr e)^2 + mu dev e : dev e of the
/// logarithmic elastic strains e = ln(F_e F_e^T)/2, von Mises' yield condition for the Kirchhoff stress,
/// q = sqrt(3/2) |dev tau| <= sigma_y + H alpha, and associated, isochoric flow. The return is radial in the space of
/// logarithmic strains (Simo, Computer Methods in Applied Mechanics and Engineering 99 (1992) 61-112).
///
/// From a history that is given, the stress is the derivative of the incremental potential U_e + H alpha^2 / 2 +
/// sigma_y (alpha - alpha_before), minimal over alpha.
struct J2Plasticity {
  double bulk = 0.0;          // K [Pa]
  double mu = 0.0;            // shear modulus [Pa]
  double yield_stress = 0.0;  // sigma_y of the undeformed solid [Pa]
  double hardening = 0.0;     // H [Pa]

  static constexpr J2Plasticity from_young_poisson(double young, double poisson, double yield_stress,
                                                   double hardening) {
    return {young / (3.0 * (1.0 - 2.0 * poisson)), young / (2.0 * (1.0 + poisson)), yield_stress, hardening};
  }

  /// The same solid with its flow held: elastic about whatever has flowed before.
  J2Plasticity held() const { return {bulk, mu, std::numeric_limits<double>::infinity(), 0.0}; }

  struct Response {
    double energy = 0.0;      // stored, elastic and by hardening, per reference volume [J/m3]
    double dissipated = 0.0;  // by flow since `before` [J/m3]
    Mat3 stress;              // first Piola-Kirchhoff [Pa]
    PlasticState after;
  };

  /// Incremental potential, up to a constant of the history [J/m3].
  double energy(const Mat3& F, const PlasticState& before = {}) const {
    const Response r = response(F, before);
    return r.energy + r.dissipated;
  }
  Mat3 stress(const Mat3& F, const PlasticState& before = {}) const { return response(F, before).stress; }

  /// Needs det F > 0.
  Response response(const Mat3& F, const PlasticState& before) const {
    const PrincipalAxes b = principal_axes(F * before.tensor() * transpose(F));  // as if nothing flowed
    const Vec3 e{0.5 * std::log(b.values.x), 0.5 * std::log(b.values.y), 0.5 * std::log(b.values.z)};
    const double volume = e.x + e.y + e.z;
    const Vec3 deviator = e - Vec3{volume / 3.0, volume / 3.0, volume / 3.0};
    const double q = std::sqrt(6.0) * mu * norm(deviator);
    const double excess = q - (yield_stress + hardening * before.strain);
    if (!(excess > 0.0)) return answer(F, b.vectors, volume, deviator, before, 0.0);
    const double flow = excess / (3.0 * mu + hardening);
    const Vec3 rest = (1.0 - 3.0 * mu * flow / q) * deviator;
    Response r = answer(F, b.vectors, volume, rest, before, flow);
    const auto square = [&](double d) { return std::exp(2.0 * (d + volume / 3.0)); };
    const Mat3 F_inverse = inverse(F), b_e = from_axes({square(rest.x), square(rest.y), square(rest.z)}, b.vectors);
    r.after = PlasticState::of(F_inverse * b_e * transpose(F_inverse), before.strain + flow);
    return r;
  }

  constexpr double plane_wave_modulus() const { return bulk + 4.0 / 3.0 * mu; }

  /// Bound of rho c^2 over all plane waves about F while nothing flows, directions and rho of the reference state [Pa]:
  /// a wave a (x) N is a (x) F_p^-T N to the elastic part. Needs det F > 0.
  double wave_modulus(const Mat3& F, const PlasticState& state = {}) const {
    const Mat3 Cp_inverse = state.tensor();
    const Vec3 squares = principal_axes(F * Cp_inverse * transpose(F)).values;
    const Vec3 longest = principal_axes(Cp_inverse).values;
    const double mean = std::log(squares.x * squares.y * squares.z) / 6.0;
    PrincipalDerivatives d;
    for (int i = 0; i < 3; ++i) {
      d.first[i] = 3.0 * bulk * mean + 2.0 * mu * (0.5 * std::log(squares[i]) - mean);
      for (int j = 0; j < 3; ++j) d.second(i, j) = bulk + 2.0 * mu * ((i == j ? 1.0 : 0.0) - 1.0 / 3.0);
    }
    const Vec3 l{std::sqrt(squares.x), std::sqrt(squares.y), std::sqrt(squares.z)};
    const double elastic = std::max(principal_wave_modulus(l, d), 1e-3 * plane_wave_modulus());
    return elastic * std::max({longest.x, longest.y, longest.z});
  }

 private:
  /// What the elastic strains `deviator` + `volume`/3 I answer, once the flow is known.
  Response answer(const Mat3& F, const std::array<Vec3, 3>& axes, double volume, const Vec3& deviator,
                  const PlasticState& before, double flow) const {
    const double p = bulk * volume, alpha = before.strain + flow;
    Response r;
    r.energy = 0.5 * p * volume + mu * norm2(deviator) + 0.5 * hardening * alpha * alpha;
    r.dissipated = flow > 0.0 ? yield_stress * flow : 0.0;
    r.stress = ((1.0 / determinant(F)) *
                from_axes({p + 2.0 * mu * deviator.x, p + 2.0 * mu * deviator.y, p + 2.0 * mu * deviator.z}, axes)) *
               cofactor(F);
    r.after = before;
    return r;
  }
};

}  // namespace tessera
