#pragma once

#include <limits>

#include "tessera/laws/law_lanes.hpp"

namespace tessera {

/// Stress points of a cell: F_a + E_q and F_a - E_q for q = 1 to 3, each with a sixth of the cell. They integrate
/// exactly what is cubic in the position, for the distances behind the E_q are the columns of a root of three times the
/// cell's second moment.
constexpr int stress_points_of_a_cell = 6;

/// What they say about several cells, per volume.
template <class Lanes>
struct CubatureStress {
  Lanes9Of<Lanes> mean;       // (1/6) sum P [Pa]
  Lanes9Of<Lanes> moment[3];  // (1/6) (P(F + E_q) - P(F - E_q)), the derivative with respect to E_q [Pa]
  Lanes energy{};             // [J/m3]
  Lanes dissipated{};         // by plastic flow [J/m3]
  Lanes smallest_J{};         // of the points
  Lanes not_finite{};         // zero where all J are finite
};

template <class Lanes>
inline void add(Lanes9Of<Lanes>& sum, const Lanes& s, const Lanes9Of<Lanes>& t) {
  sum.xx += s * t.xx, sum.xy += s * t.xy, sum.xz += s * t.xz;
  sum.yx += s * t.yx, sum.yy += s * t.yy, sum.yz += s * t.yz;
  sum.zx += s * t.zx, sum.zy += s * t.zy, sum.zz += s * t.zz;
}

/// s a + t b
template <class Lanes>
inline Lanes9Of<Lanes> combined(const Lanes& s, const Lanes9Of<Lanes>& a, const Lanes& t, const Lanes9Of<Lanes>& b) {
  return {s * a.xx + t * b.xx, s * a.xy + t * b.xy, s * a.xz + t * b.xz, s * a.yx + t * b.yx, s * a.yy + t * b.yy,
          s * a.yz + t * b.yz, s * a.zx + t * b.zx, s * a.zy + t * b.zy, s * a.zz + t * b.zz};
}

/// `history_of(point)` gives the histories of a point, 0 to 5, of the cells.
template <class Law, class Lanes, class HistoryOf>
inline CubatureStress<Lanes> cubature_stress(const Law& law, const Lanes9Of<Lanes>& F, const Lanes9Of<Lanes> (&E)[3],
                                             HistoryOf&& history_of) {
  const Lanes one = Lanes{} + 1.0, sixth = Lanes{} + 1.0 / stress_points_of_a_cell;
  CubatureStress<Lanes> c;
  c.smallest_J += std::numeric_limits<double>::infinity();
  for (int q = 0; q < 3; ++q) {
    Lanes9Of<Lanes> first;
    for (int side = 0; side < 2; ++side) {
      const Lanes sign = side == 0 ? one : -one;
      const LanesResponseOf<Lanes> answer = response(law, combined(one, F, sign, E[q]), history_of(2 * q + side));
      if (side == 0) {
        first = answer.stress;
      } else {
        c.moment[q] = combined(sixth, first, -sixth, answer.stress);
        add(c.mean, sixth, combined(one, first, one, answer.stress));
      }
      c.energy += sixth * answer.energy;
      c.dissipated += sixth * answer.dissipated;
      c.smallest_J = c.smallest_J < answer.J ? c.smallest_J : answer.J;
      c.not_finite += answer.J - answer.J;
    }
  }
  return c;
}

}  // namespace tessera
