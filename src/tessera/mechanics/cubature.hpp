#pragma once

#include <limits>

#include "tessera/laws/law_lanes.hpp"

namespace tessera {

/// Stress points of a cell: F_a + E_q and F_a - E_q for q = 1 to 3, each with a sixth of the cell. They integrate
/// exactly what is cubic in the position, for the distances behind the E_q are the columns of a root of three times the
/// cell's second moment.
constexpr int stress_points_of_a_cell = 6;

/// What they say about four cells, per volume.
struct CubatureStress {
  Lanes9 mean;           // (1/6) sum P [Pa]
  Lanes9 moment[3];      // (1/6) (P(F + E_q) - P(F - E_q)), the derivative with respect to E_q [Pa]
  Double4 energy{};      // [J/m3]
  Double4 dissipated{};  // by plastic flow [J/m3]
  Double4 smallest_J{};  // of the points
  Double4 not_finite{};  // zero where all J are finite
};

inline void add(Lanes9& sum, const Double4& s, const Lanes9& t) {
  sum.xx += s * t.xx, sum.xy += s * t.xy, sum.xz += s * t.xz;
  sum.yx += s * t.yx, sum.yy += s * t.yy, sum.yz += s * t.yz;
  sum.zx += s * t.zx, sum.zy += s * t.zy, sum.zz += s * t.zz;
}

/// `history_of(point)` gives the histories of a point, 0 to 5, of the four cells.
template <class Law, class HistoryOf>
inline CubatureStress cubature_stress(const Law& law, const Lanes9& F, const Lanes9 (&E)[3], HistoryOf&& history_of) {
  const Double4 one = Double4{} + 1.0, sixth = Double4{} + 1.0 / stress_points_of_a_cell;
  CubatureStress c;
  c.smallest_J += std::numeric_limits<double>::infinity();
  for (int q = 0; q < 3; ++q)
    for (int side = 0; side < 2; ++side) {
      const Double4 sign = side == 0 ? one : -one;
      Lanes9 point = F;
      add(point, sign, E[q]);
      const LanesResponse answer = response(law, point, history_of(2 * q + side));
      add(c.mean, sixth, answer.stress);
      add(c.moment[q], sixth * sign, answer.stress);
      c.energy += sixth * answer.energy;
      c.dissipated += sixth * answer.dissipated;
      c.smallest_J = c.smallest_J < answer.J ? c.smallest_J : answer.J;
      c.not_finite += answer.J - answer.J;
    }
  return c;
}

}  // namespace tessera
