#pragma once

#include "tessera/mechanics/curvature_nodes.hpp"

// A particle's fit in the sweeps (theory, section 12), the vectors of one particle in the lanes of a register.

namespace tessera {

/// Sums over a fit's branches of X_ab (x) u_b and of X X (x) u_b.
struct QuadraticMoments {
  Double4 first[3]{}, second[derivatives]{};

  void add(const Double4& X, const Double4& u) {
    const Double4 x = lane_of<0>(X), y = lane_of<1>(X), z = lane_of<2>(X);
    const Double4 xu = x * u, yu = y * u, zu = z * u;
    first[0] += xu, first[1] += yu, first[2] += zu;
    second[0] += x * xu, second[1] += x * yu, second[2] += x * zu;
    second[3] += y * yu, second[4] += y * zu, second[5] += z * zu;
  }
};

/// S times six vectors.
inline void apply(const QuadraticFit& fit, const Double4 (&v)[derivatives], Double4 (&product)[derivatives]) {
  unrolled<derivatives>([&](auto r) {
    constexpr Index row = r;
    constexpr Index diagonal = row * derivatives - row * (row - 1) / 2;
    product[row] += fit.S[diagonal] * v[row];
    unrolled<derivatives - 1 - row>([&](auto i) {
      constexpr Index column = row + 1 + i;
      const double S = fit.S[diagonal + 1 + i];
      product[row] += S * v[column];
      product[column] += S * v[row];
    });
  });
}

/// Twice xx, yy and zz.
inline void double_squares(Double4 (&h)[derivatives]) { h[0] += h[0], h[3] += h[3], h[5] += h[5]; }

/// The second derivatives that the moments say.
inline void fitted(const QuadraticFit& fit, QuadraticMoments m, Double4 (&h)[derivatives]) {
  unrolled<derivatives>(
      [&](auto r) { unrolled<3>([&](auto j) { m.second[r] -= fit.A[std::size_t{3 * r + j}] * m.first[j]; }); });
  unrolled<derivatives>([&](auto r) { h[r] = Double4{}; });
  apply(fit, m.second, h);
  double_squares(h);
}

/// The way back: from the derivatives of an energy with respect to the second derivatives to those with respect to the
/// moments, whose sum over a branch is the derivative with respect to u_b.
struct QuadraticReturn {
  Double4 first[3]{}, second[derivatives]{};

  QuadraticReturn(const QuadraticFit& fit, Double4 (&g)[derivatives]) {
    double_squares(g);
    apply(fit, g, second);
    unrolled<derivatives>(
        [&](auto r) { unrolled<3>([&](auto j) { first[j] -= fit.A[std::size_t{3 * r + j}] * second[r]; }); });
  }

  Double4 at(const Double4& x, const Double4& y, const Double4& z) const {
    return x * ((first[0] + x * second[0]) + (y * second[1] + z * second[2])) +
           (y * (first[1] + y * second[3] + z * second[4]) + z * (first[2] + z * second[5]));
  }
};

}  // namespace tessera
