#pragma once

#include "tessera/mechanics/cubature.hpp"

namespace tessera {

/// What the points of several cells say where laws see a change of volume Jbar that is given: with what fluctuates
/// within a cell made isochoric, Fbar = (Jbar / J)^(1/3) F at each point.
template <class Lanes>
struct IsochoricStress {
  CubatureStress<Lanes> sums;  // the stresses of a fixed Jbar
  Lanes p{};                   // mean over the points of P(Fbar) : Fbar / (3 Jbar) [Pa]
};

template <class Law, class Lanes, class HistoryOf>
inline IsochoricStress<Lanes> isochoric_stress(const Law& law, const Lanes9Of<Lanes>& F, const Lanes9Of<Lanes> (&E)[3],
                                               const Lanes& Jbar, HistoryOf&& history_of) {
  constexpr double sixth = 1.0 / stress_points_of_a_cell;
  IsochoricStress<Lanes> c;
  c.sums.smallest_J += std::numeric_limits<double>::infinity();
  for (int k = 0; k < stress_points_of_a_cell; ++k) {
    const Lanes sign = Lanes{} + (k % 2 == 0 ? 1.0 : -1.0);
    Lanes9Of<Lanes> point = F, Fbar, stress;
    add(point, sign, E[k / 2]);
    const Lanes9Of<Lanes> cof = cofactor(point);
    const Lanes J = point.xx * cof.xx + point.xy * cof.xy + point.xz * cof.xz;
    const Lanes scale = exp((1.0 / 3.0) * log(Jbar / J));
    add(Fbar, scale, point);
    const LanesResponseOf<Lanes> answer = response(law, Fbar, history_of(k));
    const Lanes three_p = contract(answer.stress, Fbar);
    add(stress, scale, answer.stress);
    add(stress, (-1.0 / 3.0) * three_p / J, cof);
    add(c.sums.mean, Lanes{} + sixth, stress);
    add(c.sums.moment[k / 2], sixth * sign, stress);
    c.p += (sixth / 3.0) * three_p / Jbar;
    c.sums.energy += sixth * answer.energy;
    c.sums.dissipated += sixth * answer.dissipated;
    c.sums.smallest_J = c.sums.smallest_J < J ? c.sums.smallest_J : J;
    c.sums.not_finite += J - J;
  }
  return c;
}

/// The change of volume of several cells, the mean of det(F +- E_q): det F + (1/3) sum_q F : cof E_q.
template <class Lanes>
inline Lanes mean_J(const Lanes9Of<Lanes>& F, const Lanes9Of<Lanes> (&E)[3]) {
  const Lanes9Of<Lanes> cof = cofactor(F);
  const Lanes J = F.xx * cof.xx + F.xy * cof.xy + F.xz * cof.xz;
  return J + (1.0 / 3.0) * (contract(F, cofactor(E[0])) + contract(F, cofactor(E[1])) + contract(F, cofactor(E[2])));
}

/// Adds what the mean p of all cells does whose Jbar have a part of these cells' J: its derivatives by F and by E_q,
/// dJ/dE_q = (1/6) (cof(F + E_q) - cof(F - E_q)).
template <class Lanes>
inline void add_mean_pressure(const Lanes& p, const Lanes9Of<Lanes>& F, const Lanes9Of<Lanes> (&E)[3],
                              CubatureStress<Lanes>& c) {
  const Lanes third = (1.0 / 3.0) * p, sixth = (1.0 / stress_points_of_a_cell) * p;
  add(c.mean, p, cofactor(F));
  for (int q = 0; q < 3; ++q) {
    Lanes9Of<Lanes> plus = F, minus = F;
    add(plus, Lanes{} + 1.0, E[q]);
    add(minus, Lanes{} - 1.0, E[q]);
    add(c.mean, third, cofactor(E[q]));
    add(c.moment[q], sixth, cofactor(plus));
    add(c.moment[q], -sixth, cofactor(minus));
  }
}

}  // namespace tessera
