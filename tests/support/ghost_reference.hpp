#pragma once

#include <Eigen/Dense>

#include "support/reference_sums.hpp"
#include "support/small_bodies.hpp"

namespace tessera::test {

/// The formulation of [V] written from its sums. Every particle keeps its neighbours, real ones and ghosts, in one
/// list; tensors with three indices are evaluated where they are needed.
class GhostReference {
 public:
  struct Neighbour {
    bool ghost = false;
    std::size_t particle = 0;  // real neighbours
    std::size_t face = 0;      // ghosts: the boundary face
    Vec3 X, A, B, N;           // branch vector, area vector, gradient vector [V 7], normal
    Mat3 D;                    // [V 14]
  };

  explicit GhostReference(const VoronoiBody& body)
      : X(body.X), V(body.cells.volume), near(X.size()), K_prime(X.size()) {
    for (const InteriorFace& f : body.cells.interior) {
      add_real(f.a, f.b, f.area, f.centroid);
      add_real(f.b, f.a, -f.area, f.centroid);
    }
    for (std::size_t i = 0; i < body.cells.boundary.size(); ++i) {
      const BoundaryFace& f = body.cells.boundary[i];
      const auto a = static_cast<std::size_t>(f.owner);
      const Vec3 N = normalized(f.area), branch = 2.0 * dot(f.centroid - X[a], N) * N;
      near[a].push_back(
          {true, 0, i, branch, f.area, (norm(f.area) / norm(branch)) * (f.centroid - X[a]), N, body.D[i]});
    }
    for (std::size_t a = 0; a < X.size(); ++a) solve_ghosts(a);
  }

  /// H_acd = X_ac . B_ad / V_a, [V 16].
  double H(std::size_t a, const Neighbour& c, const Neighbour& d) const { return dot(c.X, d.B) / V[a]; }

  /// x_ab of all neighbours, [V 24]; `walls` are the current positions of the prescribed points of each boundary face.
  std::vector<Vec3> branches(std::size_t a, const std::vector<Vec3>& x, const std::vector<Vec3>& walls) const {
    const auto& list = near[a];
    std::vector<Vec3> known(list.size());
    for (std::size_t c = 0; c < list.size(); ++c)
      known[c] = list[c].ghost ? 2.0 * (walls[list[c].face] - x[a]) : x[list[c].particle] - x[a];
    std::vector<Vec3> result = known;
    for (std::size_t b = 0; b < list.size(); ++b) {
      if (is_known(list[b])) continue;
      Vec3 free;
      for (std::size_t c = 0; c < list.size(); ++c) free += K_prime[a](index(b), index(c)) * known[c];
      result[b] = list[b].D * known[b] + (identity() - list[b].D) * free;
    }
    return result;
  }

  /// [V 6]
  Mat3 deformation_gradient(std::size_t a, const std::vector<Vec3>& branch) const {
    Mat3 F;
    for (std::size_t b = 0; b < branch.size(); ++b) F += outer(branch[b], near[a][b].B);
    return (1.0 / V[a]) * F;
  }

  /// M'_abc = dx_ab / dx_c of a ghost b, [V 66-68]; c is a particle.
  Mat3 M_prime(std::size_t a, std::size_t b, std::size_t c) const {
    const Mat3& D = near[a][b].D;
    Mat3 M = (c == a ? -2.0 : 0.0) * D;
    if (is_known(near[a][b])) return M;
    double K_bar = coefficient(a, b, c);
    if (c == a)
      for (std::size_t d = 0; d < near[a].size(); ++d)
        if (near[a][d].ghost && is_known(near[a][d])) K_bar -= 2.0 * K_prime[a](index(b), index(d));
    return M + K_bar * (identity() - D);
  }

  /// M''_abc = d(F_a X_ab) / dx_c, [V 70].
  Mat3 M_double_prime(std::size_t a, std::size_t b, std::size_t c) const {
    Mat3 M = (dot(near[a][b].X, B_bar(a, c)) / V[a]) * identity();
    for (std::size_t d = 0; d < near[a].size(); ++d)
      if (near[a][d].ghost) M += H(a, near[a][b], near[a][d]) * M_prime(a, d, c);
    return M;
  }

  /// K'_abc of [V 23] towards a particle c, with K'_aba = - sum over the real neighbours.
  double coefficient(std::size_t a, std::size_t b, std::size_t c) const {
    double K = 0.0;
    for (std::size_t d = 0; d < near[a].size(); ++d) {
      if (near[a][d].ghost) continue;
      if (near[a][d].particle == c) K += K_prime[a](index(b), index(d));
      if (c == a) K -= K_prime[a](index(b), index(d));
    }
    return K;
  }

  /// B_bar of [V 25] for real b and for b = a.
  Vec3 B_bar(std::size_t a, std::size_t b) const {
    Vec3 B;
    for (const Neighbour& n : near[a]) {
      if (n.ghost) continue;
      if (n.particle == b) B += n.B;
      if (b == a) B -= n.B;
    }
    return B;
  }

  static bool is_known(const Neighbour& n) { return !n.ghost || is_identity(n.D); }
  static Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

  std::vector<Vec3> X;
  std::vector<double> V;
  std::vector<std::vector<Neighbour>> near;
  std::vector<Eigen::MatrixXd> K_prime;  // [V 22]; rows of free ghosts only, columns of known branches only

 private:
  void add_real(Index a, Index b, const Vec3& area, const Vec3& centroid) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    const Vec3 branch = X[j] - X[i];
    near[i].push_back(
        {false, j, 0, branch, area, (norm(area) / norm(branch)) * (centroid - X[i]), normalized(branch), identity()});
  }

  /// Minimises sum_c |x_ac - F_a X_ac|^2 of [V 15] over the ghosts that are not wholly prescribed, for a unit value
  /// of each known branch in turn; by orthogonalisation of the sum's terms, without normal equations.
  void solve_ghosts(std::size_t a) {
    const auto n = index(near[a].size());
    K_prime[a] = Eigen::MatrixXd::Zero(n, n);
    std::vector<Eigen::Index> free, known;
    for (std::size_t b = 0; b < near[a].size(); ++b) (is_known(near[a][b]) ? known : free).push_back(index(b));
    if (free.empty()) return;
    Eigen::MatrixXd terms = Eigen::MatrixXd::Identity(n, n);
    for (std::size_t c = 0; c < near[a].size(); ++c)
      for (std::size_t d = 0; d < near[a].size(); ++d) terms(index(c), index(d)) -= H(a, near[a][c], near[a][d]);
    Eigen::MatrixXd of_free(n, index(free.size())), of_known(n, index(known.size()));
    for (std::size_t i = 0; i < free.size(); ++i) of_free.col(index(i)) = terms.col(free[i]);
    for (std::size_t i = 0; i < known.size(); ++i) of_known.col(index(i)) = terms.col(known[i]);
    const Eigen::MatrixXd solution = of_free.colPivHouseholderQr().solve(-of_known);
    for (std::size_t i = 0; i < free.size(); ++i)
      for (std::size_t j = 0; j < known.size(); ++j) K_prime[a](free[i], known[j]) = solution(index(i), index(j));
  }
};

/// Forces of [V] at one configuration.
class GhostReferenceForces {
 public:
  GhostReferenceForces(const GhostReference& body, const Material& m, const std::vector<Vec3>& x,
                       const std::vector<Vec3>& walls)
      : r(body), m_(m) {
    for (std::size_t a = 0; a < r.X.size(); ++a) {
      branch.push_back(r.branches(a, x, walls));
      F.push_back(r.deformation_gradient(a, branch.back()));
      P.push_back(reference_stress(m, F.back()));
    }
  }

  /// [V 43] and the reactions of constrained faces.
  std::vector<Vec3> variational_internal_force() const {
    std::vector<Vec3> f = reactions();
    for (std::size_t a = 0; a < r.X.size(); ++a)
      for (std::size_t b : around(a)) {
        f[a] -= P[b] * r.B_bar(b, a);
        for (std::size_t c = 0; c < r.near[b].size(); ++c) {
          const auto& n = r.near[b][c];
          if (!GhostReference::is_known(n)) f[a] -= r.coefficient(b, c, a) * ((identity() - n.D) * (P[b] * n.B));
        }
      }
    return f;
  }

  /// [V 42] and the reactions of constrained faces.
  std::vector<Vec3> quasi_static_internal_force() const {
    std::vector<Vec3> f = reactions();
    for (std::size_t a = 0; a < r.X.size(); ++a)
      for (const auto& n : r.near[a])
        if (!n.ghost) f[a] += P[a] * n.B - P[n.particle] * gradient_vector(n.particle, a);
    return f;
  }

  /// [V 46] with E of [V 47].
  std::vector<Vec3> contact_force() const {
    std::vector<Vec3> f(r.X.size());
    for (std::size_t a = 0; a < r.X.size(); ++a) {
      for (std::size_t b = 0; b < r.near[a].size(); ++b) f[a] += E(r.near[a][b]) * bond(a, b).dU_dx;
      for (std::size_t b : around(a))
        for (std::size_t c = 0; c < r.near[b].size(); ++c)
          f[a] -= 0.5 * (r.M_double_prime(b, c, a) * (E(r.near[b][c]) * bond(b, c).dU_dy));
    }
    return f;
  }

  const GhostReference& r;
  std::vector<std::vector<Vec3>> branch;
  std::vector<Mat3> F, P;

 private:
  static Mat3 E(const GhostReference::Neighbour& n) { return n.ghost ? 2.0 * n.D : identity(); }

  std::vector<std::size_t> around(std::size_t a) const {
    std::vector<std::size_t> list{a};
    for (const auto& n : r.near[a])
      if (!n.ghost) list.push_back(n.particle);
    return list;
  }

  Vec3 gradient_vector(std::size_t a, std::size_t b) const {
    for (const auto& n : r.near[a])
      if (!n.ghost && n.particle == b) return n.B;
    return {};
  }

  /// D P_a A_ab, after [V 42].
  std::vector<Vec3> reactions() const {
    std::vector<Vec3> f(r.X.size());
    for (std::size_t a = 0; a < r.X.size(); ++a)
      for (const auto& n : r.near[a])
        if (n.ghost) f[a] += n.D * (P[a] * n.A);
    return f;
  }

  /// [V 29, 30, 49, 50]; bonds to ghosts take normal and tangential with respect to the face.
  ReferenceBond bond(std::size_t a, std::size_t b) const {
    const auto& n = r.near[a][b];
    const double Kn = m_.contact.normal * m_.young * norm(n.A) / norm(n.X);
    const double Kt = m_.contact.tangential * m_.shear_modulus() * norm(n.A) / norm(n.X);
    if (!n.ghost) return reference_bond(Kn, Kt, branch[a][b], 0.5 * ((F[a] + F[n.particle]) * n.X));
    const Vec3 u = n.D * (branch[a][b] - F[a] * n.X);
    const Vec3 u_n = dot(u, n.N) * n.N, elastic = Kn * u_n + Kt * (u - u_n);
    return {elastic, -elastic};
  }

  const Material& m_;
};

}  // namespace tessera::test
