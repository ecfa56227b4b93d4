// The whole method on one page: Delaunay strain [D] on given tetrahedra, plain arrays, double loops as in the paper.
// Everything else in Tessera is this, made general, exact at boundaries and fast. tests/unit/dynamics/one_page_test.cpp
// compiles this file and compares it with the library.
#include <array>
#include <map>
#include <vector>

#include "tessera/base/mat3.hpp"
#include "tessera/laws/bond_law.hpp"
#include "tessera/laws/neo_hookean.hpp"

namespace tessera::one_page {

struct Body {
  std::vector<Vec3> X, x, v;           // reference and current positions, velocities
  std::vector<double> V;               // particle volumes
  std::vector<std::map<int, Vec3>> B;  // gradient vectors B_ab, b = a included
};

// V_a = sum_t vol_t / 4, B_ab = sum_t vol_t / 4 grad N_b: the same as [D 27], a third of cluster faces' areas.
inline Body make_body(const std::vector<Vec3>& X, const std::vector<std::array<int, 4>>& tetrahedra) {
  const auto at = [](int a) { return static_cast<std::size_t>(a); };
  Body body{X, X, std::vector<Vec3>(X.size()), std::vector<double>(X.size()),
            std::vector<std::map<int, Vec3>>(X.size())};
  for (const auto& t : tetrahedra) {
    const Vec3 e1 = X[at(t[1])] - X[at(t[0])], e2 = X[at(t[2])] - X[at(t[0])], e3 = X[at(t[3])] - X[at(t[0])];
    const double volume = dot(e1, cross(e2, e3)) / 6.0;
    const Vec3 g1 = cross(e2, e3) / (6.0 * volume), g2 = cross(e3, e1) / (6.0 * volume),
               g3 = cross(e1, e2) / (6.0 * volume);
    const std::array<Vec3, 4> grad_N{-(g1 + g2 + g3), g1, g2, g3};
    for (int a : t) {
      body.V[at(a)] += volume / 4.0;
      for (std::size_t k = 0; k < 4; ++k) body.B[at(a)][t[k]] += (volume / 4.0) * grad_N[k];
    }
  }
  return body;
}

// f_a = - sum_b (P_b + Q_b) B_ba + sum_b dU_ab/dx_ab, Q_a = 1/(2 V_a) sum_b dU_ab/dy_ab (x) X_ab: [D 45] and [D 50].
inline std::vector<Vec3> forces(const Body& body, const NeoHookean& law, double E, double xi_n, double xi_t) {
  const std::size_t n = body.X.size();
  std::vector<Mat3> F(n), T(n);
  std::vector<Vec3> f(n);
  for (std::size_t a = 0; a < n; ++a)
    for (const auto& [b, B] : body.B[a])
      F[a] += (1.0 / body.V[a]) * outer(body.x[static_cast<std::size_t>(b)], B);  // [D 28]
  for (std::size_t a = 0; a < n; ++a) {
    T[a] += law.stress(F[a]);  // [D 53]
    for (const auto& [neighbour, B_ab] : body.B[a]) {
      const auto b = static_cast<std::size_t>(neighbour);
      if (a == b) continue;
      const Vec3 X_ab = body.X[b] - body.X[a], x_ab = body.x[b] - body.x[a];
      const double A = 2.0 * (norm(B_ab) + norm(body.B[b].at(static_cast<int>(a)))), L = norm(X_ab);  // [D 60]
      const BondResponse bond =
          bond_response(xi_n * E * A / L, xi_t * law.mu * A / L, x_ab, (0.5 * (F[a] + F[b])) * X_ab);  // [D 56-58]
      f[a] += bond.dU_dx;
      T[a] += (0.5 / body.V[a]) * outer(bond.dU_dy, X_ab);
    }
  }
  for (std::size_t b = 0; b < n; ++b)
    for (const auto& [a, B_ba] : body.B[b]) f[static_cast<std::size_t>(a)] -= T[b] * B_ba;
  return f;
}

// Leapfrog; the first kick is half a step.
inline void run(Body& body, const NeoHookean& law, double E, double density, double dt, int steps) {
  for (int step = 0; step < steps; ++step) {
    const std::vector<Vec3> f = forces(body, law, E, 1.0, 1.0);
    for (std::size_t a = 0; a < body.X.size(); ++a) {
      body.v[a] += ((step == 0 ? 0.5 : 1.0) * dt / (density * body.V[a])) * f[a];
      body.x[a] += dt * body.v[a];
    }
  }
}

}  // namespace tessera::one_page
